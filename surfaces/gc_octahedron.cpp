// Closed smooth surfaces of eight triangles from functions on an octahedron (Vidunas 2005).
#include "renderer/api/registry.h"
#include "renderer/complex/octahedron_bases.h"
#include "renderer/complex/octahedron_sphere.h"
#include "renderer/complex/shipped.h"
#include "surfaces/families.h"
#include "surfaces/gc_points.h"

namespace rondure {
namespace {

using Defaults = std::vector<std::optional<BlendPoint>>;

BlendPoint at(int x, int y, int z) { return {{Exact(x), Exact(y), Exact(z)}, 1}; }

// Equation 3.2: the corners of a cube, for the eight functions of degree 3.
Defaults cube_points(const GcBasis& basis, int degree) {
  Defaults points(basis.functions.size());
  if (degree != 3) return points;
  for (int k = 0; k < 8; ++k) {
    points[static_cast<std::size_t>(k)] =
        at((k & 4) != 0 ? -1 : 1, (k & 2) != 0 ? -1 : 1, (k & 1) != 0 ? -1 : 1);
  }
  return points;
}

Defaults hierarchy_points() {
  Defaults points(8, at(0, 0, 0));
  points[1] = at(1, 0, 0), points[2] = at(0, 1, 0), points[3] = at(0, 0, 1);
  return points;
}

// All eight patches are regular, which the paper thought impossible: renderer/continuity/exact_regularity.h
// proves it.
Defaults rational_points() {
  return {at(0, -2, 1), at(1, 0, -2), at(-2, 1, 0), at(7, 0, -4), at(0, -4, 7),
          at(-4, 7, 0), at(2, 0, 0),  at(0, 2, 0),  at(0, 0, 2)};
}

Surface build_gc_octahedron(Params& params) {
  const SurfaceComplex complex = octahedron_complex();
  const std::string name =
      params.choice("basis", {"splines", "hierarchical", "rational", "sphere"}, "splines");
  const bool has_degree = params.has("degree"), has_points = params.has("control_points");
  if (name != "splines" && has_degree) params.fail("degree", "\"degree\" is for the basis \"splines\" only");
  if (name == "sphere") {
    if (has_points) params.fail("control_points", "the sphere has no control points");
    std::vector<Net> nets;
    for (const TriangleNet& net : octahedron_sphere()) nets.emplace_back(net);
    return oriented_surface(complex, std::move(nets));
  }
  const int degree = name == "splines" ? static_cast<int>(params.integer("degree", 3, 3, 12)) : 3;
  const GcBasis basis = name == "splines"        ? octahedron_splines(degree)
                        : name == "hierarchical" ? octahedron_hierarchy()
                                                 : octahedron_rationals();
  const Defaults defaults = name == "splines"        ? cube_points(basis, degree)
                            : name == "hierarchical" ? hierarchy_points()
                                                     : rational_points();
  Surface surface = blended_surface(params, complex, basis, read_blend_points(params, basis.names, defaults));
  surface.notes.push_back({"dimension", static_cast<double>(basis.functions.size()),
                           "of the space of geometrically continuous functions"});
  return surface;
}

}  // namespace

void register_gc_octahedron(Registry& registry) {
  registry.add(SurfaceFamily{
      "gc_octahedron",
      "closed smooth surfaces of eight triangles, from functions on an octahedron (Vidunas 2005)",
      {{"basis", "\"splines\", \"hierarchical\", \"rational\" or \"sphere\"", "\"splines\"",
        "polynomials, one for each coefficient inside a triangle; those of degree 3 as combinations of low "
        "and high frequency (equation 3.3); quotients of degree 2 by u^2 + v^2 + w^2 (equations 2.7, 2.8); "
        "the "
        "exact unit sphere, of degree 6"},
       {"degree", "integer 3 to 12", "3", "of the splines: 4 (n - 1)(n - 2) functions"},
       control_points_doc("those of equation 3.2 (a surface with vertices at distance 12), of H0 to H34, of "
                          "a regular surface",
                          "h1 to h8 in degree 3, otherwise \"t:ijk\" for coefficient ijk in triangle t from "
                          "0 on; H0, Hx, Hy, "
                          "Hz, H12, H34, HC, HD; A to F, vw, uw, uv. With weights in some: the quotient sum "
                          "w P f / sum w f")},
      build_gc_octahedron});
}

}  // namespace rondure
