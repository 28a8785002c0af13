// A triangle of circular arcs on the unit sphere as one patch of degree 2, where the circles have a common
// point (Dietz, Hoschek, Juettler 1993, section 3.5), or of degree 4.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "renderer/api/registry.h"
#include "surfaces/arc_reader.h"
#include "surfaces/circular_choice.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

std::string why_not_quadratic(const SphericalTriangle& triangle) {
  const long double degrees = std::arg(holonomy(triangle)) * 2 * degrees_per_radian;
  if (all_straight({triangle.arc.begin(), triangle.arc.end()}))
    return "a quadratic patch exists only where the interior angles add up to 180 degrees (Dietz, Hoschek, "
           "Juettler 1993, section 3.5); here all three are 180 degrees: the sides run round one circle, or "
           "join smoothly. \"degree_4\" always exists";
  if (std::abs(degrees) > 360 - 1e-6L)
    return "these arcs have no quadratic patch, but others of the same circles have: take the other arc of "
           "one circle";
  return fmt::format(
      "a quadratic patch exists only where the interior angles add up to 180 degrees and the three circles "
      "have a point in common (Dietz, Hoschek, Juettler 1993, section 3.5); here they exceed that by {:.9g} "
      "degrees. \"degree_4\" always exists",
      static_cast<double>(degrees));
}

std::vector<PreimageFamily> candidates(Params& params, const SphericalTriangle& triangle, bool shaped) {
  const std::string construction = params.choice("construction", {"auto", "quadratic", "degree_4"}, "auto");
  std::vector<PreimageFamily> list;
  if (construction == "quadratic" && shaped)
    params.fail("shape", "a quadratic patch has no \"shape\": all are the same");
  if (construction != "degree_4" && !shaped) {
    const bool exists = std::abs(std::arg(holonomy(triangle))) <= closes;
    if (construction == "quadratic" && !exists) params.fail("construction", why_not_quadratic(triangle));
    if (exists) list.push_back(linear_family(triangle));
  }
  if (construction != "quadratic") {
    for (const HolonomyRoot root : roots_of(holonomy(triangle)))
      list.push_back(quadratic_family(triangle, root));
  }
  return list;
}

Surface build_circular_triangle(Params& params) {
  const std::vector<SphereArc> arcs = read_arcs(params, 3);
  const SphericalTriangle triangle{{arcs[0], arcs[1], arcs[2]}};
  const std::optional<GivenShape> given = read_shape(params, 3, 2);
  Surface surface = best_image(params, candidates(params, triangle, given.has_value()), given);
  surface.notes.push_back(
      {"angle_excess", angle_excess(holonomy(triangle)),
       "degrees by which the interior angles exceed 180, up to 720; degree 2 exists where it is 0"});
  return surface;
}

}  // namespace

void register_circular_triangle(Registry& registry) {
  registry.add(SurfaceFamily{
      "circular_triangle",
      "a triangle of circular arcs on the unit sphere, of degree 2 where possible, or 4 (Dietz, Hoschek, "
      "Juettler 1993, section 3.5)",
      {{"corners", "array of three directions [x, y, z]", "",
        "counter-clockwise, seen from outside; each is brought to length 1. u, v, w = 1 there"},
       arcs_doc(3),
       {"construction", "\"auto\", \"quadratic\" or \"degree_4\"", "\"auto\"",
        "quadratic: exists where the interior angles add up to 180 degrees; degree_4: exists for all arcs; "
        "auto: the first of them that is regular, if possible with positive weights"},
       shape_doc("of degree_4: the ratio of the factors of each side, from corner to corner, then turns in "
                 "degrees of "
                 "the phases of the first two",
                 5)},
      build_circular_triangle});
}

}  // namespace rondure
