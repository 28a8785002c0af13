// How patches meet, on surfaces where it is known.
#include "renderer/continuity/continuity.h"

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

// Flat, with the corners 00, 10, 11, 01.
TensorNet bilinear(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  TensorNet net(1, 1);
  net.at(0, 0) = dvec4(a, 1), net.at(1, 0) = dvec4(b, 1), net.at(1, 1) = dvec4(c, 1),
            net.at(0, 1) = dvec4(d, 1);
  return net;
}

Surface of(std::vector<Net> nets) {
  Surface surface;
  surface.patches = std::move(nets);
  return surface;
}

}  // namespace

TEST_CASE("a roof's ridge has the angle between its planes", "[continuity]") {
  // 30 degrees down on either side.
  const double s = 0.5, c = std::sqrt(0.75);
  const TensorNet left = bilinear({0, 0, 0}, {0, 1, 0}, {-c, 1, -s}, {-c, 0, -s});
  const TensorNet right = bilinear({0, 1, 0}, {0, 0, 0}, {c, 0, -s}, {c, 1, -s});
  for (const bool turned : {false, true}) {
    const Net second = turned ? reversed(right) : Net(right);
    const Continuity roof = continuity_of(of({left, second}));
    CHECK(roof.seams == 1);
    CHECK(roof.open_sides == 6);
    CHECK(roof.vertices == 6);
    CHECK(roof.closed_vertices == 0);
    CHECK(roof.orientable);
    CHECK(roof.tangent.value == Approx(60.0).epsilon(1e-12));
    CHECK(roof.mean.value == 0.0);
    CHECK(roof.vertex.patch == -1);
  }
  // Folded onto itself.
  const TensorNet above = bilinear({0, 1, 0}, {0, 0, 0}, {-c, 0, -s}, {-c, 1, -s});
  TensorNet apart = above;
  apart.at(1, 1).z += 1e-3, apart.at(0, 1).z += 1e-3;
  CHECK(continuity_of(of({left, apart})).tangent.value == Approx(180.0).epsilon(1e-3));
}

TEST_CASE("a cube's corners lack 90 degrees of a full turn", "[continuity]") {
  std::vector<Net> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto corner = [&](double u, double v) {
        dvec3 p(0.0);
        p[axis] = side;
        p[(axis + 1) % 3] = side == 1 ? u : v;
        p[(axis + 2) % 3] = side == 1 ? v : u;
        return p;
      };
      faces.emplace_back(bilinear(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)));
    }
  }
  const Continuity c = continuity_of(of(faces));
  CHECK(c.seams == 12);
  CHECK(c.open_sides == 0);
  CHECK(c.closed_vertices == 8);
  CHECK(c.tangent.value == Approx(90.0));
  CHECK(c.vertex.value == Approx(90.0));
  CHECK(c.vertex_sum.value == Approx(90.0));
}

TEST_CASE("a cylinder's end in a half sphere: tangent planes agree, curvature jumps by 1/2", "[continuity]") {
  // Radius 1: mean curvature -1/2 on the cylinder, -1 on the sphere; Gaussian 0 and 1.
  const Surface cap = build_family(R"({"type": "sphere_octant", "octants": [0]})");
  const double h = std::sqrt(0.5);
  TensorNet wall(2, 1);
  for (int j = 0; j <= 1; ++j) {
    wall.at(0, j) = dvec4(1, 0, -j, 1);
    wall.at(1, j) = dvec4(h, h, -h * j, h);
    wall.at(2, j) = dvec4(0, 1, -j, 1);
  }
  Surface both = cap;
  both.patches.emplace_back(wall);
  const Continuity c = continuity_of(both);
  REQUIRE(c.seams == 1);
  CHECK(c.collapsed_sides == 1);
  // Their parameters on the arc differ.
  CHECK(c.gap.value < 1e-15);
  CHECK(c.tangent.value < 1e-12);
  CHECK(c.mean.value == Approx(0.5));
  CHECK(c.gaussian.value == Approx(1.0));
}

TEST_CASE("a Moebius strip is not orientable", "[continuity]") {
  // Three quadrilaterals in a ring with half a turn.
  const dvec3 inner[4] = {{1, 0, -0.3}, {-0.5, 0.8, -0.3}, {-0.5, -0.8, -0.3}, {1, 0, 0.3}};
  const dvec3 outer[4] = {{1, 0, 0.3}, {-0.5, 0.8, 0.3}, {-0.5, -0.8, 0.3}, {1, 0, -0.3}};
  std::vector<Net> nets;
  for (int k = 0; k < 3; ++k) nets.emplace_back(bilinear(inner[k], inner[k + 1], outer[k + 1], outer[k]));
  const Continuity c = continuity_of(of(nets));
  CHECK(c.seams == 3);
  CHECK_FALSE(c.orientable);
}

TEST_CASE("the tilings of the sphere are smooth; the crystal is not", "[continuity]") {
  for (const char* topology : {"cube", "octahedron_quads", "icosahedron_quads", "rhombicuboctahedron"}) {
    const Surface sphere =
        build_family(std::string(R"({"type": "sphere_tiling", "topology": ")") + topology + "\"}");
    const Continuity c = continuity_of(sphere);
    CAPTURE(topology);
    CHECK(c.open_sides == 0);
    CHECK(c.tangent.value < 1e-11);
    CHECK(c.mean.value < 1e-9);
    CHECK(c.vertex.value < 1e-11);
  }
  const Continuity crystal = continuity_of(build_family(
      R"({"type": "iss", "degree": 2, "vertices": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]],
          "patches": [{"triangle": [0,2,4]}, {"triangle": [1,2,4]}]})"));
  CHECK(crystal.seams == 1);
  CHECK(crystal.tangent.value > 1.0);
}

TEST_CASE("Figure 3 (a) is curvature continuous, (b) is not (Vidunas 2005, Peters and Kobbelt 1997)",
          "[continuity]") {
  const Continuity a = continuity_of(build_family(R"({"type": "gc_octahedron"})"));
  CHECK(a.seams == 12);
  CHECK(a.closed_vertices == 6);
  CHECK(a.tangent.value < 1e-12);
  CHECK(a.vertex_sum.value < 1e-12);
  // Of a surface of size 12, with curvatures of about 1/10.
  CHECK(a.mean.value < 1e-14);
  CHECK(a.gaussian.value < 1e-14);
  const Continuity b =
      continuity_of(build_family(R"({"type": "gc_octahedron", "control_points": {"h6": [-2, 1, 0]}})"));
  CHECK(b.tangent.value < 1e-12);
  CHECK(b.mean.value > 1e-3);
}

TEST_CASE("seams are found whatever the parameters of their sides and the order of their patches",
          "[continuity]") {
  const TensorNet flat = bilinear({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  for (const double ratio : {1.0, 5.0, 30.0, 1000.0}) {
    // Along x = 1 with weights 1 and `ratio`, up to the right.
    TensorNet other = bilinear({1, 0, 0}, {2, 0, 1}, {2, 1, 1}, {1, 1, 0});
    for (const int i : {0, 1}) other.at(i, 1) = ratio * other.at(i, 1);
    for (const bool swapped : {false, true}) {
      CAPTURE(ratio, swapped);
      const Continuity c = continuity_of(swapped ? of({other, flat}) : of({flat, other}));
      CHECK(c.seams == 1);
      CHECK(c.open_sides == 6);
      // A unit of the last place of the parameter moves the point by `ratio` of them at its fast end.
      CHECK(c.gap.value < 4 * 0x1p-52 * ratio);
      CHECK(c.tangent.value == Approx(45.0));
    }
  }
  // t^2 along the edge.
  TensorNet slow(1, 2);
  for (int j = 0; j <= 2; ++j) {
    slow.at(0, j) = dvec4(1, j == 2 ? 1 : 0, 0, 1);
    slow.at(1, j) = dvec4(2, 0.5 * j, 1, 1);
  }
  for (const bool swapped : {false, true})
    CHECK(continuity_of(swapped ? of({slow, flat}) : of({flat, slow})).seams == 1);
}

TEST_CASE("vertices are measured on surfaces that have no two sides", "[continuity]") {
  // Four triangles: the tetrahedron with antipodes glued is no surface in space; a square seen as two patches
  // whose four sides meet crosswise is: a projective plane with its four corners in two points.
  const TensorNet front = bilinear({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  TensorNet back = front;
  std::swap(back.at(0, 0), back.at(1, 0));
  std::swap(back.at(0, 1), back.at(1, 1));
  const Continuity c = continuity_of(of({front, back}));
  CHECK(c.closed_vertices == 4);
  CHECK(c.vertex.patch >= 0);
}

TEST_CASE("vertices of a complex stay apart where they coincide in space", "[continuity]") {
  // Three rhombi around a torus: 6 edges and, by Euler's formula, 3 vertices, two of which the shape of
  // degree 3 brings together. As patches without joins they have one point there with twice the full turn
  // around it.
  Surface torus = build_family(R"({"type": "gc_complex", "complex": {"torus": [1, 1]}, "degree": 3})");
  const Continuity joined = continuity_of(torus);
  CHECK(joined.seams == 6);
  CHECK(joined.open_sides == 0);
  CHECK(joined.closed_vertices == 3);
  CHECK(joined.vertex_sum.value < 1e-9);
  CHECK(joined.vertex.value < 1e-9);
  torus.joins.clear();
  const Continuity loose = continuity_of(torus);
  CHECK(loose.closed_vertices == 2);
  CHECK(loose.vertex_sum.value > 100.0);
  // The joins are those that are found from the curves, where nothing coincides; mirrored patches too.
  for (const char* text : {R"({"type": "gc_octahedron"})", R"({"type": "gc_complex"})",
                           R"({"type": "gc_complex", "complex": "torus"})",
                           R"({"type": "gc_complex", "complex": {"polygons": [[0, 1, 2], [2, 1, 3, 4]]},
            "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 1, 1], [1, 2, 1]], "degree": 4})"}) {
    CAPTURE(text);
    Surface surface = build_family(text);
    const Continuity given = continuity_of(surface);
    surface.joins.clear();
    const Continuity found = continuity_of(surface);
    CHECK(given.seams == found.seams);
    CHECK(given.open_sides == found.open_sides);
    CHECK(given.vertices == found.vertices);
    CHECK(given.closed_vertices == found.closed_vertices);
    CHECK(given.gap.value < 1e-14 * 12);
    CHECK(given.tangent.value < 1e-11);
  }
}

TEST_CASE("the largest jump of curvature is found between the places that are looked at", "[continuity]") {
  const Surface b = build_family(R"({"type": "gc_octahedron", "control_points": {"h6": [-2, 1, 0]}})");
  const Continuity c = continuity_of(b);
  // All seams at 2001 places; both patches have the same parameter on a side or run opposite.
  double mean = 0.0, gaussian = 0.0;
  for (const SideJoin& join : b.joins) {
    const Net &p = b.patches[static_cast<std::size_t>(join.patch)],
              &q = b.patches[static_cast<std::size_t>(join.other)];
    for (int k = 1; k < 2000; ++k) {
      const double s = k / 2000.0;
      const dvec2 at = side_point(p, join.side, s),
                  there = side_point(q, join.other_side, join.reversed ? 1.0 - s : s);
      const Curvature a = curvature(p, at.x, at.y), d = curvature(q, there.x, there.y);
      mean = std::fmax(mean, std::abs(a.mean - (join.reversed ? d.mean : -d.mean)));
      gaussian = std::fmax(gaussian, std::abs(a.gaussian - d.gaussian));
    }
  }
  CHECK(c.mean.value >= mean);
  CHECK(c.gaussian.value >= gaussian);
  // Near a peak a place 1/4000 away is lower by the second derivative's share.
  CHECK(c.mean.value < mean * (1 + 1e-4));
  CHECK(c.gaussian.value < gaussian * (1 + 1e-4));
}

TEST_CASE("many sides between the same two points are given up in time", "[continuity]") {
  std::vector<Net> nets;
  for (int k = 0; k < 600; ++k) {
    const double a = k * 0.01;
    TensorNet net(2, 1);
    for (int j = 0; j <= 1; ++j) {
      net.at(0, j) = dvec4(0, 0, j, 1);
      net.at(1, j) = dvec4(0.5, std::cos(a), std::sin(a) + j, 1);
      net.at(2, j) = dvec4(1, 0, j, 1);
    }
    nets.emplace_back(net);
  }
  const Continuity c = continuity_of(of(nets));
  CHECK_FALSE(c.complete);
  CHECK(continuity_of(of({nets[0], nets[1]})).complete);
}

}  // namespace rondure
