// The image of a rectangle of the plane under inverse stereographic projection, biquadratic (Cobb 1988,
// section 4).
#include <fmt/format.h>

#include <cmath>

#include "renderer/api/registry.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

// Rectangles that reach further, in units of the distance from the pole to the plane, come so close to the
// pole that nothing is gained, while the weights, which grow with the square, cancel ever more digits.
constexpr double furthest = 1000.0;

struct Interval {
  long double low, high;
  // Bernstein coefficients of t and of t^2 over the interval.
  long double linear(int k) const { return ((2 - k) * low + k * high) / 2; }
  long double square(int k) const { return k == 1 ? low * high : k == 0 ? low * low : high * high; }
};

Interval read_interval(Params& params, const char* key, double distance) {
  const dvec2 range = params.vec2(key, dvec2(-1.0, 1.0));
  if (!(range.x < range.y)) params.fail(key, fmt::format("\"{}\" must be an interval, [low, high]", key));
  const double reach = furthest * std::abs(distance);
  if (!(std::abs(range.x) <= reach && std::abs(range.y) <= reach))
    params.fail(key,
                fmt::format("\"{}\" must lie in [{:g}, {:g}]: {:g} times the distance from the pole to the "
                            "plane, either way",
                            key, -reach, reach, furthest));
  return {range.x, range.y};
}

// s(x, y) = (2 d x, 2 d y, x^2 + y^2 - d^2, x^2 + y^2 + d^2) with d = 1 - plane_z, divided by d^2.
Surface build_stereographic_patch(Params& params) {
  const double plane = params.number("plane_z", -1.0, {-1e6, 1e6, false, false});
  if (plane == 1.0)
    params.fail("plane_z",
                "\"plane_z\" must not be 1: one projects from the pole, (0, 0, 1), which lies there");
  const long double d = 1 - static_cast<long double>(plane);
  const Interval x = read_interval(params, "x", static_cast<double>(d)),
                 y = read_interval(params, "y", static_cast<double>(d));
  TensorNet net(2, 2);
  // The projection turns the plane over, seen from outside: u along y and v along x make up for that.
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j) {
      const long double square = (x.square(j) + y.square(i)) / (d * d);
      net.at(i, j) = {static_cast<double>(2 * x.linear(j) / d), static_cast<double>(2 * y.linear(i) / d),
                      static_cast<double>(square - 1), static_cast<double>(square + 1)};
    }
  }
  Surface surface;
  surface.patches.emplace_back(std::move(net));
  return surface;
}

}  // namespace

void register_stereographic_patch(Registry& registry) {
  registry.add(SurfaceFamily{
      "stereographic_patch",
      "a planar rectangle projected to the unit sphere from (0, 0, 1), biquadratic (Cobb 1988, section 4)",
      {{"x", "interval [low, high]", "[-1, 1]",
        "extent of the rectangle along x, and along v; at most 1000 |1 - plane_z| from 0. Reaching to r |1 - "
        "plane_z|, the patch is off the sphere by up to some 0.2 r^2 ulps: the weights grow and cancel"},
       {"y", "interval [low, high]", "[-1, 1]", "extent along y, and along u"},
       {"plane_z", "number in [-10^6, 10^6] other than 1", "-1",
        "height of the rectangle's plane; moves parameters as a scale"}},
      build_stereographic_patch});
}

}  // namespace rondure
