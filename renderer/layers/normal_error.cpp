// How far a normal is from the one that the surface has.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/bezier/angle.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

constexpr double no_value = -1.0;

// Degrees between unit vectors, good to rounding at every angle; 180 where one of them is missing: nothing
// that comes of such a normal is right.
double degrees_between(const NormalEstimate& a, const NormalEstimate& b) {
  if (!a || !b) return 180.0;
  const double angle = angle_between(*a, *b);
  return angle * (180.0 / std::numbers::pi);
}

LayerFunction create(Params& params) {
  std::optional<NormalEstimator> of;
  if (params.raw("of")) {
    const std::string name = params.choice(
        "of", {"limit", "cross", "cross_float", "taylor", "shift", "hodograph", "analytic"}, "limit");
    of = estimator_named(name);
  }
  return [of](const World& world, const Ray&, const Hit& hit, double* values) {
    if (!hit) return;
    const NormalField& field = world.normals(hit.surface);
    const NormalEstimate own = field.at(of.value_or(world.estimator(hit.surface)), hit);
    const bool known = !net_at(world, hit) || field.quadric(hit.patch);
    values[0] = known ? degrees_between(own, field.at(NormalEstimator::analytic, hit)) : no_value;
    values[1] = degrees_between(own, hit.normal);
  };
}

}  // namespace

void register_normal_error_layer(Registry& registry) {
  registry.add(LayerFactory{
      "normal_error",
      "Degrees between a normal and those of the quadric that the patch lies on (-1 where there is none) "
      "and of the limit; 180 where the estimator gives none.",
      "NormalError",
      {"analytic", "limit"},
      {{"of", "an estimator, as an object's \"normals\"", "what shades the object", "the normal at fault"}},
      create,
      {"degrees", "degrees"}});
}

}  // namespace rondure
