// Which patches turn back as seen from the origin.
#include "renderer/bezier/star_shaped.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/transform.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

Net moved(const Net& net, const dvec3& by) {
  dmat4 map(1.0);
  map[3] = dvec4(by, 1.0);
  return transformed(net, map);
}

int folded(const std::string& object, const dvec3& by) {
  int count = 0;
  for (const Net& net : build_family(object).patches)
    count += fold_seen_from_origin(moved(net, by)).has_value();
  return count;
}

}  // namespace

TEST_CASE("a sphere turns back as seen from outside, and from nowhere inside", "[star]") {
  // Singular corners and collapsed sides among them.
  for (const char* object :
       {R"({"type": "sphere_tiling", "topology": "cube"})",
        R"({"type": "sphere_tiling", "topology": "hemispheres"})", R"({"type": "sphere_octant"})",
        R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})"}) {
    INFO(object);
    CHECK(folded(object, dvec3(0.0)) == 0);
    CHECK(folded(object, dvec3(0.5, -0.3, 0.6)) == 0);
    // The cone that touches the sphere does so along a circle, which has to cross some patch.
    CHECK(folded(object, dvec3(2.0, 0.3, 0.1)) > 0);
  }
}

TEST_CASE("inverse spherical patches never turn back, whatever their form", "[star][iss]") {
  NetMaker make(61);
  int faults = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const TriangleNet net = net_of(random_planar_iss(make, 1 + trial % 8));
    faults += fold_seen_from_origin(net).has_value();
    faults += fold_seen_from_origin(as_degenerate_tensor(net)).has_value();
    for (const TensorNet& part : as_three_tensors(net)) faults += fold_seen_from_origin(part).has_value();
  }
  CHECK(faults == 0);
}

TEST_CASE("where a patch turns back is told", "[star]") {
  // The parabola x = u, z = 1 + a (u - c)^2 along u, swept along y. A line from the origin in the plane y = 0
  // touches it where z = x z', that is 1 + a c^2 = a u^2.
  const double a = 8.0, c = 0.25, touch = std::sqrt((1.0 + a * c * c) / a);
  TensorNet net(2, 1);
  const double z[3] = {1.0 + a * c * c, 1.0 + a * c * (c - 1.0), 1.0 + a * (1.0 - c) * (1.0 - c)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) net.at(i, j) = dvec4(0.5 * i, j - 0.5, z[i], 1.0);
  const std::optional<Fold> fold = fold_seen_from_origin(net);
  REQUIRE(fold.has_value());
  CHECK(fold->certain);
  CHECK(touch == Approx(0.4330).margin(1e-4));
  // A point of the lesser part, u > touch or u < touch, by the sign at u = 0.
  const auto turn = [&](double u) { return 1.0 + a * (u - c) * (u - c) - u * 2.0 * a * (u - c); };
  CHECK(turn(fold->at.x) * turn(fold->at.x > touch ? 0.0 : 1.0) < 0.0);
  // The part before the tangent alone does not.
  TensorNet before(2, 1);
  const double e = 0.43;
  const double values[3] = {z[0], z[0] + e * (z[1] - z[0]), 1.0 + a * (e - c) * (e - c)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) before.at(i, j) = dvec4(0.5 * e * i, j - 0.5, values[i], 1.0);
  CHECK_FALSE(fold_seen_from_origin(before).has_value());
  // A plane through the origin is seen edge on.
  TensorNet plane(1, 1);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) plane.at(i, j) = dvec4(1.0 + i, j, 0.0, 1.0);
  CHECK(fold_seen_from_origin(plane).has_value());
}

}  // namespace rondure
