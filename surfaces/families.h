// The patch families that are built in; each is a plugin whose source could be built as a shared object as
// well.
#pragma once

namespace rondure {

class Registry;

void register_bezier(Registry& registry);
void register_circular_quad(Registry& registry);
void register_circular_triangle(Registry& registry);
void register_composed_patch(Registry& registry);
void register_curve(Registry& registry);
void register_projected_net(Registry& registry);
void register_quadric_patch(Registry& registry);
void register_gc_complex(Registry& registry);
void register_gc_octahedron(Registry& registry);
void register_iss(Registry& registry);
void register_sphere(Registry& registry);
void register_sphere_cap(Registry& registry);
void register_sphere_octant(Registry& registry);
void register_sphere_tiling(Registry& registry);
void register_spherical_bspline(Registry& registry);
void register_spherical_quad(Registry& registry);
void register_stereographic_patch(Registry& registry);

}  // namespace rondure
