// The family gc_octahedron against nets, points, normals and first hits computed at 50 digits, and its
// errors.
#include <fmt/format.h>

#include <bit>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle_keys.h"
#include "renderer/complex/gc_function.h"
#include "renderer/complex/octahedron_sphere.h"
#include "renderer/complex/shipped.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

constexpr double eps = 0x1p-52;

const Json& data() {
  static const Json read = reference_data("octahedron.json");
  return read;
}

Surface surface_of(const Json& entry) { return build_family(entry["object"].dump()); }

// Octants with an odd number of mirrored axes are turned round, u and v swapped. Those with an even number
// are instead where the control points make a surface that the octahedron's own orientation turns inside out.
bool swapped(const Json& entry, int octant) {
  const bool inside_out = entry["name"].get<std::string>().find("stilde") != std::string::npos;
  return (std::popcount(static_cast<unsigned>(octant)) % 2 == 1) != inside_out;
}

dvec2 parameters_of(const Json& entry, const Json& s) {
  const double u = number(s["uvw"][0]), v = number(s["uvw"][1]);
  return swapped(entry, s["octant"].get<int>()) ? dvec2(v, u) : dvec2(u, v);
}

}  // namespace

TEST_CASE("gc_octahedron nets are the reference's", "[complex]") {
  WorstCase worst;
  for (const Json& entry : data()) {
    const Surface surface = surface_of(entry);
    CHECK(surface.closed);
    REQUIRE(surface.patches.size() == 8);
    for (const Json& patch : entry["patches"]) {
      const int octant = patch["octant"].get<int>();
      const auto& net = std::get<TriangleNet>(surface.patches[static_cast<std::size_t>(octant)]);
      if (entry["degree"] == 2) {
        // Raised until all weights are positive.
        CHECK(net.n == 4);
        continue;
      }
      REQUIRE(net.n == entry["degree"].get<int>());
      // Quotients of integers are multiplied by a whole number so that nothing is rounded.
      const bool quotient = entry["name"].get<std::string>().find("stilde") != std::string::npos;
      const double multiple = quotient ? 3.0 : 1.0;
      for (const auto& [key, value] : patch["net"].items()) {
        const int i = key[0] - '0', j = key[1] - '0';
        const dvec4 p = swapped(entry, octant) ? net.at(j, i) : net.at(i, j);
        const dvec4 q = multiple * dvec4(vector(value), number(value[3]));
        // Both are rounded once; those of the sphere are products of two rounded numbers.
        worst.add(glm::length(p - q), 4.0 * eps * glm::length(q),
                  [&] { return fmt::format("{} octant {} {}", entry["name"].dump(), octant, key); });
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() > 500);
  CHECK(worst.failures() == 0);
}

TEST_CASE("gc_octahedron points and normals are the reference's", "[complex]") {
  WorstCase points, normals;
  for (const Json& entry : data()) {
    const Surface surface = surface_of(entry);
    for (const Json& s : entry["samples"]) {
      const int octant = s["octant"].get<int>();
      const Net& net = surface.patches[static_cast<std::size_t>(octant)];
      const dvec2 uv = parameters_of(entry, s);
      const dvec3 p = vector(s["point"]);
      const dvec3 n = (swapped(entry, octant) ? -1.0 : 1.0) * vector(s["normal"]);
      const auto say = [&] { return entry["name"].dump() + " " + s.dump(); };
      // Parameters and net are rounded; surfaces of size 30 move by 100 at most for a unit of a parameter.
      points.add(glm::distance(net_point(net, uv.x, uv.y), p), 16.0 * eps * std::fmax(10.0, glm::length(p)),
                 say);
      normals.add(glm::distance(unit_normal(net, uv.x, uv.y), n), 1e-13, say);
    }
  }
  INFO("points: " << points.text());
  INFO("normals: " << normals.text());
  CHECK(points.count() > 50);
  CHECK(points.failures() == 0);
  CHECK(normals.failures() == 0);
}

TEST_CASE("gc_octahedron first hits are the reference's", "[complex][hits]") {
  WorstCase t, parameter;
  int rays = 0, hits = 0, wrong = 0;
  std::string what;
  for (const Json& entry : data()) {
    const Tracer tracer({{surface_of(entry), Solver::newton}});
    for (const Json& ray : entry["rays"]) {
      ++rays;
      const dvec3 direction = vector(ray["direction"]);
      const Hit hit = tracer.closest({vector(ray["origin"]), direction});
      const auto say = [&] { return entry["name"].dump() + " " + ray.dump(); };
      if (static_cast<bool>(hit) != ray["hit"].get<bool>()) ++wrong, what = say();
      if (!hit || !ray["hit"].get<bool>()) continue;
      ++hits;
      // 16 ulps of a surface of size 10, stretched along the ray by 1 / cos.
      const double off = 160.0 * eps / number(ray["cosine"]);
      const double expected = number(ray["t"]);
      t.add(std::fabs(hit.t - expected), off / glm::length(direction) + 4.0 * eps * expected, say);
      const int octant = ray["octant"].get<int>();
      if (ray.contains("octants")) {
        const auto allowed = ray["octants"].get<std::vector<int>>();
        if (std::find(allowed.begin(), allowed.end(), hit.patch) == allowed.end()) ++wrong, what = say();
      } else if (hit.patch != octant) {
        ++wrong, what = say();
      }
      if (hit.patch == octant)
        parameter.add(glm::distance(dvec2(hit.u, hit.v), parameters_of(entry, ray)), 10.0 * off + 16.0 * eps,
                      say);
    }
  }
  INFO(rays << " rays, " << hits << " hits, " << wrong << " wrong: " << what);
  INFO("t: " << t.text());
  INFO("parameters: " << parameter.text());
  CHECK(hits > 60);
  CHECK(wrong == 0);
  CHECK(t.failures() == 0);
  CHECK(parameter.failures() == 0);
}

TEST_CASE("the sphere of degree 6 is on the sphere and geometrically continuous", "[complex]") {
  const std::vector<TriangleNet> nets = octahedron_sphere();
  double radius = 0.0;
  for (const TriangleNet& net : nets) {
    for (int i = 0; i <= 12; ++i) {
      for (int j = 0; j <= 12 - i; ++j) {
        radius = std::fmax(radius, std::abs(glm::length(net_point(net, i / 12.0, j / 12.0)) - 1.0));
      }
    }
    for (const dvec4& p : net.points) CHECK(p.w > 0.69);
  }
  CHECK(radius < 8.0 * eps);
  const SurfaceComplex h = octahedron_complex();
  for (int axis = 0; axis < 3; ++axis) {
    GcFunction f;
    for (const TriangleNet& net : nets) {
      PolygonPolynomial x{3, 6, {}}, w{3, 6, {}};
      for (const dvec4& p : net.points) {
        x.coefficients.emplace_back(p[axis]);
        w.coefficients.emplace_back(p.w);
      }
      f.numerators.push_back(x);
      f.denominators.push_back(w);
    }
    const GcDefect d = gc1_defect(h, f);
    CHECK(d.value == 0.0);
    // Coefficients are rounded by eps / 2 and differences are multiplied by 6; theta's entries are 2 at most.
    CHECK(d.derivative < 40.0 * eps);
  }
}

TEST_CASE("gc_octahedron: weights make quotients, and a constant basis moves nothing", "[complex]") {
  const auto at = [](const Surface& s, int octant, double u, double v) {
    return net_point(s.patches[static_cast<std::size_t>(octant)], u, v);
  };
  // The same point with any weight for all functions.
  const Surface one = build_family(
      R"({"type": "gc_octahedron", "control_points": {"h1": [2, 4, 6, 2], "rest": [0.5, 1, 1.5, 0.5]}})");
  CHECK(glm::distance(at(one, 5, 0.25, 0.5), dvec3(1, 2, 3)) < 8.0 * eps);
  // H0 is 1: it moves the surface as a whole.
  const Surface from = build_family(R"({"type": "gc_octahedron", "basis": "hierarchical"})");
  const Surface to = build_family(
      R"({"type": "gc_octahedron", "basis": "hierarchical", "control_points": {"H0": [1, 2, 3]}})");
  CHECK(glm::distance(at(to, 2, 0.3, 0.3), at(from, 2, 0.3, 0.3) + dvec3(1, 2, 3)) < 64.0 * eps);
  // Equation 3.2 is H_x, H_y, H_z.
  const Surface cube = build_family(R"({"type": "gc_octahedron"})");
  CHECK(glm::distance(at(cube, 2, 0.3, 0.3), at(from, 2, 0.3, 0.3)) < 64.0 * eps);
  const Surface fine =
      build_family(R"({"type": "gc_octahedron", "degree": 5, "control_points": {"rest": [1, 2, 3]}})");
  CHECK(glm::distance(at(fine, 7, 0.1, 0.2), dvec3(1, 2, 3)) < 16.0 * eps);
}

TEST_CASE("gc_octahedron says what is wrong", "[complex]") {
  const auto says = [](const std::string& rest) {
    return complaint(R"({"type": "gc_octahedron", )" + rest + "}");
  };
  CHECK(says(R"("control_points": {"h9": [0, 0, 0]})") ==
        "\"h9\" names no function of this basis; did you mean \"h1\"?");
  CHECK(says(R"("basis": "rational", "control_points": {"planar": [0, 0, 0]})") ==
        "\"planar\" names no function of this basis; they are A, B, C, D, E, F, vw, uw, uv");
  CHECK(says(R"("control_points": {"h1": [0, 0]})") ==
        "a control point is [x, y, z], or [w x, w y, w z, w] with a weight");
  CHECK(says(R"("control_points": {"h1": [0, 0, 0, 0]})") ==
        "the weight of a control point must be positive");
  CHECK(says(R"("control_points": [1])") ==
        "\"control_points\" is an object with a point for each of h1, h2, h3, h4, h5, h6, h7, h8");
  CHECK(
      says(R"("degree": 4)").find("the control point of \"0:112\" is missing; \"rest\" would stand for it") !=
      std::string::npos);
  CHECK(says(R"("degree": 4, "control_points": {"0:211": [1, 2, 3]})") ==
        "the control point of \"0:112\" is missing; \"rest\" would stand for it");
  CHECK(says(R"("basis": "sphere", "degree": 6)") == "\"degree\" is for the basis \"splines\" only");
  CHECK(says(R"("basis": "sphere", "control_points": {})") == "the sphere has no control points");
  CHECK(says(R"("basis": "spline")").find("did you mean \"splines\"?") != std::string::npos);
  // The functions vw, uw, uv change sign: with weights this large their sum vanishes somewhere.
  CHECK(says(R"("basis": "rational", "control_points": {"uv": [0, 0, 0, 9]})") ==
        "the weight of patch 2 vanishes somewhere");
}

}  // namespace rondure
