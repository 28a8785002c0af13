#include "renderer/plugin/builtin.h"

#include "integrators/integrators.h"
#include "renderer/layers/layers.h"
#include "surfaces/families.h"

namespace rondure {

void register_builtins(Registry& registry) {
  constexpr void (*table[])(Registry&) = {
      register_bezier,
      register_circular_quad,
      register_circular_triangle,
      register_composed_patch,
      register_curve,
      register_gc_complex,
      register_gc_octahedron,
      register_iss,
      register_projected_net,
      register_quadric_patch,
      register_sphere,
      register_sphere_cap,
      register_sphere_octant,
      register_sphere_tiling,
      register_spherical_bspline,
      register_spherical_quad,
      register_stereographic_patch,
      register_direct,
      register_normals,
      register_path,
      register_study,
      register_certificate_layer,
      register_curvature_layer,
      register_jacobian_layer,
      register_line_layers,
      register_normal_error_layer,
      register_residual_layer,
      register_work_layer,
  };
  for (const auto register_one : table) register_one(registry);
}

}  // namespace rondure
