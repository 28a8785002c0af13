// Four points of the unit sphere joined by circular arcs, as one biquartic patch (Cobb 1988, section 7).
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "renderer/api/registry.h"
#include "surfaces/arc_reader.h"
#include "surfaces/families.h"
#include "surfaces/planar_weights.h"

namespace rondure {
namespace {

// At the corner or arc in question, as far as the scene names it.
[[noreturn]] void refuse(Params& params, const QuadDefect& defect) {
  const Value* list =
      params.raw(defect.part == QuadDefect::Part::arc && params.has("arcs") ? "arcs" : "corners");
  const std::string about = params.has("projection_center") && defect.part != QuadDefect::Part::corner
                                ? " (about this projection_center)"
                                : "";
  const bool whole = defect.part == QuadDefect::Part::whole;
  params.fail(whole ? *list : list->items[defect.index], defect.text + about);
}

Surface build_spherical_quad(Params& params) {
  const std::vector<SphereArc> arcs = read_arcs(params, 4);
  const SphericalQuad quad{{arcs[0], arcs[1], arcs[2], arcs[3]}};
  QuadPatchOptions options;
  const Value* centre = params.raw("projection_center");
  options.centre = centre ? read_direction(params, *centre, "\"projection_center\"") : best_centre(quad);
  if (const auto defect = defect_of(shape_of(quad, options.centre), false)) refuse(params, *defect);
  options.corner_weights = read_corner_weights(params);
  options.may_double = !params.has("middle_weight");
  options.middle_weight = read_middle_weight(params);
  QuadPatch patch = quad_patch(quad, options);
  if (!patch.regular) params.fail("middle_weight", "the patch may fold with this middle weight");
  Surface surface;
  surface.patches.emplace_back(std::move(patch.net));
  return surface;
}

}  // namespace

void register_spherical_quad(Registry& registry) {
  registry.add(SurfaceFamily{
      "spherical_quad",
      "a quadrilateral of circular arcs on the unit sphere as one biquartic patch (Cobb 1988, section 7)",
      {{"corners", "array of four directions [x, y, z]", "",
        "counter-clockwise, seen from outside; each is brought to length 1. (u, v) = (0, 0), (1, 0), (1, 1), "
        "(0, 1) there. Interior angles must be less than 180 degrees. The nearer the region to the whole "
        "sphere, the further its points are off: 85 ulps where it leaves 6 degrees about a point, 2,400 for "
        "one"},
       arcs_doc(4),
       {"projection_center", "direction [x, y, z]",
        "chosen well inside, far from where arcs would bend inward",
        "middle of the stereographic image, which must be convex; one projects from the point opposite"},
       middle_weight_doc("1, doubled until the patch is regular"),
       corner_weights_doc()},
      build_spherical_quad});
}

}  // namespace rondure
