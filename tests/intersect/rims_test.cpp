// Shadows at the rims of open patches on spheres: what stops a ray there is what the closest hit says.

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

TEST_CASE("A rim casts the shadow of what is inside it, and no wider one", "[hits]") {
  const std::string parameters = GENERATE(
      R"({"type": "sphere_cap", "z_max": -0.3})", R"({"type": "sphere_octant", "octants": [0, 3, 5]})",
      R"({"type": "spherical_quad", "corners": [[3, 0, -0.5], [0.2, 2, -0.4], [-1, 0.5, 1], [0.3, -1, 0.2]]})",
      R"({"type": "circular_triangle", "corners": [[3, 0.4, -0.5], [0.2, 2, -0.4], [-1, 0.5, 1]]})");
  const Surface surface = build_family(parameters);
  const Tracer tracer({{surface, Solver::quadric}}), newton({{surface, Solver::newton}});
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  long shadows = 0, wrong = 0, lit = 0;
  for (int k = 0; k < 60'000; ++k) {
    const Net& net = surface.patches[static_cast<std::size_t>(k) % surface.patches.size()];
    // A point of the boundary (or of a seam), moved along the sphere by 10^-5 to 10^-1 radii.
    const double along = part(random);
    const int side = static_cast<int>(random() % 4);
    dvec2 p = side < 2 ? dvec2(along, side) : dvec2(side - 2, along);
    if (std::holds_alternative<TriangleNet>(net))
      p = side < 2 ? dvec2(along * (1 - side), along * side) : dvec2(along, 1.0 - along);
    const dvec3 rim = net_point(net, p.x, p.y);
    const dvec3 target = glm::normalize(rim + std::pow(10.0, -1.0 - 4.0 * part(random)) * glm::length(rim) *
                                                  random_direction(random));
    // From the middle, where the ray meets the sphere once, and steeply.
    const Ray ray{surface.origin, target};
    const bool shadow = tracer.occluded(ray), hit = static_cast<bool>(tracer.closest(ray));
    ++(shadow ? shadows : lit);
    wrong += shadow != hit || shadow != static_cast<bool>(newton.closest(ray));
  }
  INFO(parameters << ": " << shadows << " shadows, " << lit << " lit");
  CHECK(wrong == 0);
  CHECK(shadows > 10'000);
  CHECK(lit > 5'000);
}
