// The family gc_complex: built-in complexes, meshes, joins in full, and what it refuses.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/continuity/continuity.h"
#include "renderer/continuity/regularity.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

Surface complex_surface(const std::string& rest) {
  return build_family(R"({"type": "gc_complex", )" + rest + "}");
}

void check_smooth(const Surface& surface, std::size_t seams, std::size_t vertices) {
  const Continuity c = continuity_of(surface);
  CHECK(surface.closed);
  CHECK(c.seams == seams);
  CHECK(c.open_sides == 0);
  CHECK(c.closed_vertices == vertices);
  // Normals of patches of size 1 with |Su x Sv| above 0.1: some eps / 0.1, in degrees.
  CHECK(c.tangent.value < 1e-11);
  CHECK(c.vertex.value < 1e-11);
  CHECK(c.vertex_sum.value < 1e-10);
  CHECK(regularity_of(surface).verdict == Regularity::Verdict::regular);
}

// Five triangles above, five below, as polygons.
const char* const pentagonal = R"("complex": {"polygons": [
    [0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 0, 5], [1, 0, 6], [2, 1, 6], [3, 2, 6], [4, 3, 6], [0, 4, 6]]},
    "vertices": [[1, 0, 0], [0.31, 0.95, 0], [-0.81, 0.59, 0], [-0.81, -0.59, 0], [0.31, -0.95, 0],
                 [0, 0, 1], [0, 0, -1]])";

// The octahedron of the paper, all of its data written out.
std::string octahedron_by_joins(const std::string& of_first) {
  std::string joins;
  constexpr int bit[3] = {1, 4, 2};
  for (int p = 0; p < 8; ++p) {
    for (int e = 0; e < 3; ++e) {
      const int q = p ^ bit[e];
      if (q < p) continue;
      const std::string data = joins.empty() && !of_first.empty()
                                   ? of_first
                                   : R"("reversed": false, "fields": [{"along": [0, -1], "inward": 1},
                                        {"along": ["0", "-1"], "inward": "1"}])";
      joins += fmt::format("{}{{\"edges\": [[{}, {}], [{}, {}]], {}}}", joins.empty() ? "" : ", ", p, e, q, e,
                           data);
    }
  }
  return R"("complex": {"sides": [3, 3, 3, 3, 3, 3, 3, 3], "joins": [)" + joins + "]}";
}

std::string says(const std::string& rest) { return complaint(R"({"type": "gc_complex", )" + rest + "}"); }

}  // namespace

TEST_CASE("gc_complex makes smooth closed surfaces of every genus that is shipped", "[complex]") {
  check_smooth(complex_surface(R"("degree": 2)"), 12, 8);
  check_smooth(complex_surface(R"("degree": 3)"), 12, 8);
  check_smooth(complex_surface(R"("complex": "octahedron", "degree": 4)"), 12, 6);
  check_smooth(complex_surface(R"("complex": "torus")"), 72, 36);
  // The torus comes near the one of radii 1 and 1/2.
  double worst = 0.0;
  for (const Net& net : complex_surface(R"("complex": {"torus": [6, 4]})").patches) {
    const dvec3 p = net_point(net, 0.3, 0.6);
    worst = std::fmax(worst, std::abs(std::hypot(std::hypot(p.x, p.y) - 1.0, p.z) - 0.5));
  }
  CHECK(worst < 0.1);
}

TEST_CASE("gc_complex takes meshes, also with vertices of five triangles", "[complex]") {
  const Surface surface = complex_surface(std::string(pentagonal) + R"(, "degree": 4)");
  CHECK(surface.patches.size() == 10);
  check_smooth(surface, 15, 7);
  // A house: a cube whose top is a pyramid. At its eaves triangles meet quadrilaterals.
  check_smooth(
      complex_surface(R"("complex": {"polygons": [[3, 2, 1, 0], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6],
      [3, 0, 4, 7], [4, 5, 8], [5, 6, 8], [6, 7, 8], [7, 4, 8]]}, "degree": 4,
      "vertices": [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
                   [0, 0, 2]])"),
      16, 9);
  // Open: two quadrilaterals and a triangle around a vertex.
  const Surface open = complex_surface(R"("complex": {"polygons": [[0, 1, 2, 3], [0, 3, 4, 5], [0, 5, 6]]},
      "degree": 3, "vertices": [[0, 0, 0.5], [1, 0, 0], [1, 1, 0], [0, 1, 0], [-1, 1, 0], [-1, 0, 0], [0, -1, 0]])");
  CHECK_FALSE(open.closed);
  const Continuity c = continuity_of(open);
  CHECK(c.seams == 2);
  CHECK(c.open_sides == 7);
  CHECK(c.tangent.value < 1e-11);
}

TEST_CASE("gc_complex with the paper's data is gc_octahedron", "[complex]") {
  const std::string points = R"(, "control_points": {"0:111": [12, 24, 36], "rest": [0, 12, 0]})";
  const Surface a = complex_surface(octahedron_by_joins("") + points);
  const Surface b =
      build_family(R"({"type": "gc_octahedron", "control_points": {"h1": [1, 2, 3], "rest": [0, 1, 0]}})");
  REQUIRE(a.patches.size() == b.patches.size());
  for (std::size_t k = 0; k < a.patches.size(); ++k) {
    CHECK(points_of(a.patches[k]) == points_of(b.patches[k]));
  }
}

TEST_CASE("gc_complex takes parameters that are not linear", "[complex]") {
  // s meets s (1 + s) / 2, so that the common curve has a lower degree on the second square.
  const Surface surface = complex_surface(R"("complex": {"sides": [4, 4], "joins": [
      {"edges": [[0, 0], [1, 0]], "parameter": [0, 0.25, 1], "theta": {"along": 0, "inward": -1}}]}, "degree": 4,
      "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0], [1, -1, 0], [0, -1, 0.3]])");
  const Continuity c = continuity_of(surface);
  CHECK(c.seams == 1);
  CHECK(c.gap.value < 1e-13);
  CHECK(c.tangent.value < 1e-11);
}

TEST_CASE("gc_complex says what is wrong", "[complex]") {
  const std::string rest = R"(, "control_points": {"rest": [1, 2, 3]})";
  CHECK(
      says(octahedron_by_joins(R"("reversed": false, "theta": {"along": 0, "inward": 1})") + rest) ==
      "this is no geometrically continuous complex: (4c) at corner 0 of polygon 0 (edge 0 of polygon 0, "
      "glued "
      "to edge 0 of polygon 1): the two corners meet in more than a half-line: inward is taken to 1 inward, "
      "where it must be negative (and 1 more)");
  CHECK(says(octahedron_by_joins(R"("reversed": false, "theta": {"along": [0.1, 2], "inward": -1})") + rest)
            .find("(5b) at the vertex at corner 0 of polygon 0, where 4 corners meet: once round is not the "
                  "identity: an entry is off by 0.1") != std::string::npos);
  CHECK(
      says(
          R"("complex": {"sides": [3, 3], "joins": [{"edges": [[0, 0], [1, 0]]}, {"edges": [[0, 0], [1, 1]]}]})" +
          rest) == "(2) edge 0 of polygon 0 is glued more than once");
  CHECK(says(R"("complex": {"sides": [3], "joins": [{"edges": [[0, 0], [1, 0]]}]})" + rest) ==
        "an edge is [polygon, edge], both counted from 0");
  CHECK(says(R"("complex": {"polygons": [[0, 1, 2], [0, 1, 3], [0, 1, 4]]})" + rest) ==
        "the edge between vertices 0 and 1 belongs to more than two polygons");
  CHECK(says(R"("complex": {"polygons": [[0, 1, 2], [0, 3, 4]]})" + rest) ==
        "the polygons at vertex 0 do not form one fan around it");
  CHECK(says(R"("complex": {"polygons": [[0, 1, 2]]})").find("\"control_points\" is missing") !=
        std::string::npos);
  CHECK(says(R"("complex": {"torus": [11, 10]})") ==
        "\"torus\" is [k, l], numbers of cells with a product of 41 at most: 3 k l squares have 2000 "
        "coefficients at "
        "most");
  CHECK(says(R"("complex": {"torus": [6, 6]}, "degree": 8)").find("more than 2000") != std::string::npos);
  CHECK(says(R"("vertices": [[0, 0, 0]])") ==
        "\"vertices\" is an array of 8 points [x, y, z], one for every vertex");
  CHECK(
      says(
          R"("complex": {"sides": [3, 3], "joins": [{"edges": [[0, 0], [1, 0]], "theta": {"along": "1/0", "inward": -1}}]})") ==
      "expected a number or a fraction \"p/q\" of integers with 15 digits at most");
}

TEST_CASE("every part of a complex faces outward", "[complex]") {
  // Two cubes, the faces of the second listed the other way round.
  const std::string two =
      R"("complex": {"polygons": [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5],
      [9,11,10,8],[14,15,13,12],[12,13,9,8],[11,15,14,10],[10,14,12,8],[13,15,11,9]]}, "vertices": [
      [-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1],
      [4,-1,-1],[6,-1,-1],[4,1,-1],[6,1,-1],[4,-1,1],[6,-1,1],[4,1,1],[6,1,1]])";
  const Surface surface = complex_surface(two);
  CHECK(surface.closed);
  int inward = 0;
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const SurfaceJet jet = surface_jet(surface.patches[k], 0.5, 0.5);
    const dvec3 centre(k < 6 ? 0 : 5, 0, 0);
    inward += glm::dot(jet.point - centre, glm::cross(jet.du, jet.dv)) < 0.0;
  }
  CHECK(inward == 0);
}

TEST_CASE("boundary vertices may have any number of polygons", "[complex]") {
  for (int n = 4; n <= 9; ++n) {
    std::string polygons, vertices = "[0, 0, 0]";
    for (int k = 0; k <= n; ++k) {
      const double a = 3.14159265358979 * k / n;
      if (k < n) polygons += fmt::format("{}[0, {}, {}]", k > 0 ? ", " : "", k + 1, k + 2);
      vertices += fmt::format(", [{}, {}, {}]", std::cos(a), std::sin(a), 0.8 * std::sin(a));
    }
    const Surface fan = complex_surface(
        fmt::format(R"("complex": {{"polygons": [{}]}}, "vertices": [{}], "degree": 4)", polygons, vertices));
    const Continuity c = continuity_of(fan);
    CAPTURE(n);
    CHECK(c.seams == static_cast<std::size_t>(n - 1));
    CHECK(c.tangent.value < 1e-9);
    CHECK(regularity_of(fan).verdict == Regularity::Verdict::regular);
  }
}

TEST_CASE("spaces too small for a surface are refused, and numbers too large", "[complex]") {
  CHECK(says(R"("complex": "octahedron", "degree": 2)") ==
        "there is but 1 function of degree 2 on this complex, which make no surface: take a higher degree");
  CHECK(
      complaint(R"({"type": "gc_octahedron", "control_points": {"h1": [1e308, 0, 0]}})").find("too large") !=
      std::string::npos);
  CHECK(
      says(
          R"("complex": {"sides": [3], "joins": [{"edges": [[0, 0], [0, 0]]}]}, "control_points": {"rest": [1, 2, 3]})") ==
      "(2) edge 0 of polygon 0 is glued to itself");
}

}  // namespace rondure
