// The analytic unit sphere: what every exact tiling is compared with.
#include "renderer/api/registry.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

Surface build_sphere(Params&) {
  Surface surface;
  surface.ellipsoid = dmat3(1.0);
  surface.closed = true;
  return surface;
}

}  // namespace

void register_sphere(Registry& registry) {
  registry.add(SurfaceFamily{"sphere", "the unit sphere itself, met analytically", {}, build_sphere});
}

}  // namespace rondure
