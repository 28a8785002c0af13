#include "surfaces/iss_arcs.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/inverse_spherical/modelling.h"

namespace rondure {
namespace {

void check_ends(const Params& arc, const dvec3& from, const dvec3& to) {
  const double length = glm::length(from) * glm::length(to);
  // Directions closer to parallel than this leave the great circle through them to rounding.
  if (!(length > 0.0) || !(glm::length(glm::cross(from, to)) > 1e-12 * length)) {
    arc.fail("\"from\" and \"to\" must be directions that are neither parallel nor opposite");
  }
}

}  // namespace

std::vector<Guide> read_iss_arcs(Params& params, const std::vector<IssPatch>& patches) {
  std::vector<Guide> guides;
  if (!params.has("arcs")) return guides;
  for (Params& arc : params.objects("arcs")) {
    const dvec3 from = arc.vec3("from"), to = arc.vec3("to");
    arc.finish();
    check_ends(arc, from, to);
    const std::size_t before = guides.size();
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const auto* planar = std::get_if<PlanarIss>(&patches[k]);
      if (!planar) {
        arc.fail(
            fmt::format("patch {} has no planar projection domain, so that over a great-circle arc it is no "
                        "inverse circular curve (Casciola and Morigi 2004, Remark 7.1)",
                        k));
      }
      if (const auto curve = along_arc(*planar, from, to)) guides.push_back({curve->control_points()});
    }
    if (guides.size() == before) arc.fail("the arc passes by every patch");
  }
  return guides;
}

}  // namespace rondure
