// A quadrilateral of circular arcs on the unit sphere as one patch of degree (2, 2), where there is one, or
// of degree (2, 4), where there always is (Dietz, Hoschek, Juettler 1993, theorems 3.9 and 3.10).
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

std::string why_not_biquadratic(const SphericalQuad& quad) {
  // The holonomy's argument is half of what the angles exceed 360 degrees by, up to 720.
  const long double degrees = std::arg(holonomy(quad)) * 2 * degrees_per_radian;
  if (all_straight({quad.arc.begin(), quad.arc.end()}))
    return "a biquadratic patch exists only where the interior angles add up to 360 degrees (Dietz, Hoschek, "
           "Juettler 1993, corollary 3.12); here all four are 180 degrees: the sides run round one circle, "
           "or "
           "join smoothly. \"degree_2_4\" always exists";
  if (std::abs(degrees) > 360 - 1e-6L)
    return "these arcs have no biquadratic patch, but others of the same circles have: take the other arc of "
           "one circle (Dietz, Hoschek, Juettler 1993, theorem 3.9)";
  return fmt::format(
      "a biquadratic patch exists only where the interior angles add up to 360 degrees, and corners 0 and 2 "
      "lie on a circle with the points where the arcs of corners 1 and 3 meet again (Dietz, Hoschek, "
      "Juettler 1993, theorem 3.9, corollary 3.12); here they exceed that by {:.9g} degrees. \"degree_2_4\" "
      "always exists",
      static_cast<double>(degrees));
}

std::vector<PreimageFamily> candidates(Params& params, const SphericalQuad& quad,
                                       const std::optional<GivenShape>& given) {
  const std::string construction =
      params.choice("construction", {"auto", "biquadratic", "degree_2_4"}, "auto");
  const std::string along = params.choice("quartic", {"auto", "u", "v"}, "auto");
  std::vector<PreimageFamily> list;
  const bool many = given && given->count > 1;
  if (construction == "biquadratic" && many)
    params.fail("shape", "\"shape\" of a biquadratic patch must be one number");
  if (construction != "degree_2_4" && !many) {
    const bool exists = std::abs(std::arg(holonomy(quad))) <= closes;
    if (construction == "biquadratic" && !exists) params.fail("construction", why_not_biquadratic(quad));
    if (exists) list.push_back(bilinear_family(quad));
  }
  if (construction != "biquadratic") {
    for (const HolonomyRoot root : roots_of(holonomy(quad))) {
      if (along != "u") list.push_back(linear_quadratic_family(quad, root));
      if (along != "v") list.push_back(quadratic_linear_family(quad, root));
    }
  }
  return list;
}

Surface build_circular_quad(Params& params) {
  const std::vector<SphereArc> arcs = read_arcs(params, 4);
  const SphericalQuad quad{{arcs[0], arcs[1], arcs[2], arcs[3]}};
  const std::optional<GivenShape> given = read_shape(params, 3, 1);
  Surface surface = best_image(params, candidates(params, quad, given), given);
  surface.notes.push_back({"angle_excess", angle_excess(holonomy(quad)),
                           "degrees by which the interior angles exceed 360, up to 720; degree (2, 2) exists "
                           "where it is 0"});
  return surface;
}

}  // namespace

void register_circular_quad(Registry& registry) {
  registry.add(SurfaceFamily{
      "circular_quad",
      "a quadrilateral of circular arcs on the unit sphere, of degree (2, 2) where possible, or (2, 4) "
      "(Dietz, "
      "Hoschek, Juettler 1993, section 3.5)",
      {{"corners", "array of four directions [x, y, z]", "",
        "counter-clockwise, seen from outside; each is brought to length 1. (u, v) = (0, 0), (1, 0), (1, 1), "
        "(0, 1) there"},
       arcs_doc(4),
       {"construction", "\"auto\", \"biquadratic\" or \"degree_2_4\"", "\"auto\"",
        "biquadratic: degree (2, 2), which exists where the interior angles add up to 360 degrees; "
        "degree_2_4: exists for all arcs; auto: the first of them that is regular, if possible with positive "
        "weights"},
       {"quartic", "\"auto\", \"u\" or \"v\"", "\"auto\"",
        "of degree_2_4: the direction of degree 4; auto tries v, then u"},
       shape_doc("|b00| |b11| / (|b10| |b01|) of the preimage's corners; in an array, for degree_2_4 only, "
                 "then the "
                 "ratio of the factors of each conic side, u = 0 and 1 or v = 0 and 1, and a turn in degrees "
                 "of their "
                 "phases",
                 4)},
      build_circular_quad});
}

}  // namespace rondure
