// Degree elevation and subdivision of an `iss` object's patches, as its "modify" list says.
#include <fmt/format.h>

#include <cmath>

#include "renderer/bezier/bernstein.h"
#include "renderer/inverse_spherical/modelling.h"
#include "renderer/inverse_spherical/spherical_triangle.h"
#include "surfaces/iss_patches.h"

namespace rondure {
namespace {

constexpr std::size_t most_patches = 100000;

void elevate(Params& step, std::vector<IssPatch>& patches) {
  const int degree = static_cast<int>(step.integer("elevate", 1, max_degree));
  for (IssPatch& patch : patches) {
    const int n = net_of(patch).n;
    if (n > degree) step.fail("elevate", fmt::format("a patch has degree {} already", n));
    std::visit([&](auto& form) { form = elevated(form, degree - n); }, patch);
  }
}

// Replaces each patch (or the one that "patch" names) by the parts that `cut` makes of it.
template <class Cut>
void replace(Params& step, std::vector<IssPatch>& patches, Cut cut) {
  const auto last = static_cast<std::int64_t>(patches.size()) - 1;
  const std::int64_t only = step.has("patch") ? step.integer("patch", 0, last) : -1;
  std::vector<IssPatch> out;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (only >= 0 && k != static_cast<std::size_t>(only)) {
      out.push_back(patches[k]);
      continue;
    }
    const auto* planar = std::get_if<PlanarIss>(&patches[k]);
    if (!planar) {
      step.fail(
          fmt::format("patch {} has no planar projection domain, so that its parts would have sides off the "
                      "great circles (Casciola and Morigi 2004, Remark 7.1)",
                      k));
    }
    for (const PlanarIss& part : cut(*planar)) out.emplace_back(part);
    if (out.size() > most_patches) step.fail(fmt::format("this makes more than {} patches", most_patches));
  }
  patches = std::move(out);
}

void split(Params& step, std::vector<IssPatch>& patches) {
  Params where = step.object("split");
  const bool by_direction = where.has("direction");
  if (by_direction == where.has("at")) where.fail("give one of \"at\" (barycentric) and \"direction\"");
  const dvec3 given = by_direction ? where.vec3("direction") : where.vec3("at", Range::positive());
  replace(where, patches, [&](const PlanarIss& s) {
    dvec3 tau = by_direction ? domain_coordinates(s.corners, given) : given / (given.x + given.y + given.z);
    const dvec3 u = tau.x * s.corners[0] + tau.y * s.corners[1] + tau.z * s.corners[2];
    const bool ahead = u.x * given.x + u.y * given.y + u.z * given.z > 0.0;
    if (!(tau.x > 0.0 && tau.y > 0.0 && tau.z > 0.0) || (by_direction && !ahead)) {
      where.fail("direction", "it must point into the inside of the spherical triangle to split");
    }
    return split_at(s, tau.x, tau.y);
  });
  where.finish();
}

void quarter(Params& step, std::vector<IssPatch>& patches) {
  Params where = step.object("quarter");
  replace(where, patches, quartered);
  where.finish();
}

void apply(Params& step, std::vector<IssPatch>& patches) {
  const bool does_elevate = step.has("elevate"), does_split = step.has("split"),
             does_quarter = step.has("quarter");
  if (does_elevate + does_split + does_quarter != 1) {
    step.fail("a step is one of {\"elevate\": degree}, {\"split\": {...}} and {\"quarter\": {}}");
  }
  if (does_elevate) elevate(step, patches);
  if (does_split) split(step, patches);
  if (does_quarter) quarter(step, patches);
  step.finish();
}

}  // namespace

void modify_iss_patches(Params& params, std::vector<IssPatch>& patches) {
  if (!params.has("modify")) return;
  for (Params& step : params.objects("modify")) apply(step, patches);
}

}  // namespace rondure
