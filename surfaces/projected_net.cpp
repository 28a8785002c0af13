// Patches of the unit sphere as images of Bezier nets in projective 3-space under the generalised
// stereographic projection (Dietz, Hoschek, Juettler 1993, section 2.2): every irreducible rational patch of
// the sphere is one.
#include "renderer/api/registry.h"
#include "surfaces/families.h"
#include "surfaces/preimage_reader.h"

namespace rondure {
namespace {

Surface build_projected_net(Params& params) {
  Surface surface;
  for (const Preimage& preimage : read_preimages(params, "patches", false))
    surface.patches.push_back(sphere_image(preimage));
  surface.closed = params.boolean("closed", false);
  return surface;
}

}  // namespace

void register_projected_net(Registry& registry) {
  registry.add(SurfaceFamily{
      "projected_net",
      "patches of the unit sphere from nets in projective 3-space, degree doubled (Dietz, Hoschek, Juettler "
      "1993, section 2.2)",
      {preimages_doc("patches"), {"closed", "boolean", "false", "the patches bound a solid"}},
      build_projected_net});
}

}  // namespace rondure
