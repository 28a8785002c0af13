// How far the parametrisation is from an isometry at the hit.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

void jacobian(const World& world, const Ray&, const Hit& hit, double* values) {
  const Net* net = net_at(world, hit);
  if (!net) return;
  const SurfaceJet s = surface_jet(*net, hit.u, hit.v);
  const double e = glm::dot(s.du, s.du), f = glm::dot(s.du, s.dv), g = glm::dot(s.dv, s.dv);
  const double area = glm::length(glm::cross(s.du, s.dv));
  // The singular values of (Su Sv): their squares have the sum e + g, they themselves the product `area`.
  const double largest = std::sqrt(0.5 * (e + g + std::hypot(e - g, 2.0 * f)));
  if (!(largest > 0.0)) return;
  const double smallest = area / largest;
  values[0] = e > 0.0 && g > 0.0 ? std::min(1.0, area / (std::sqrt(e) * std::sqrt(g))) : 0.0;
  values[1] = largest / smallest;
  values[2] = smallest;
}

}  // namespace

void register_jacobian_layer(Registry& registry) {
  registry.add(LayerFactory{"jacobian",
                            "The tangents of a patch: |Su x Sv| / (|Su| |Sv|), condition number and smallest "
                            "singular value of (Su Sv); zeros where there is no patch.",
                            "Jacobian",
                            {"sine", "condition", "smallest"},
                            {},
                            [](Params&) { return LayerFunction(jacobian); }});
}

}  // namespace rondure
