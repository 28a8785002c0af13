// Inverse spherical surfaces (Casciola and Morigi 2004): rational triangles that are single-valued over the
// sphere.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/api/registry.h"
#include "renderer/bezier/transform.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "renderer/inverse_spherical/closed.h"
#include "renderer/inverse_spherical/spherical_triangle.h"
#include "surfaces/families.h"
#include "surfaces/iss_arcs.h"
#include "surfaces/iss_patches.h"

namespace rondure {
namespace {

// The corners turn anticlockwise as seen from the origin's far side, so that the normal points away from it.
TriangleNet outward(const TriangleNet& net) {
  const double turn = orientation(dvec3(net.at(net.n, 0)), dvec3(net.at(0, net.n)), dvec3(net.at(0, 0)));
  return turn < 0.0 ? std::get<TriangleNet>(reversed(net)) : net;
}

void add_surface(const std::vector<TriangleNet>& nets, const std::string& form, std::vector<Net>& out) {
  for (const TriangleNet& net : nets) {
    if (form == "triangles") out.emplace_back(net);
    if (form == "degenerate") out.emplace_back(as_degenerate_tensor(net));
    if (form != "quadrilaterals") continue;
    for (TensorNet& part : as_three_tensors(net)) out.emplace_back(std::move(part));
  }
}

// The sides of the domain on the unit sphere.
void add_spherical_triangle(const TriangleNet& net, std::vector<Guide>& out) {
  const dvec3 corners[3] = {dvec3(net.at(net.n, 0)), dvec3(net.at(0, net.n)), dvec3(net.at(0, 0))};
  for (int k = 0; k < 3; ++k) {
    const dvec3 a = glm::normalize(corners[k]), b = glm::normalize(corners[(k + 1) % 3]);
    const double half_cosine = 0.5 * glm::length(a + b);
    out.push_back({{dvec4(a, 1.0), dvec4((a + b) / (2.0 * half_cosine), half_cosine), dvec4(b, 1.0)}});
  }
}

// The sides of the planar projection domain.
void add_domain(const TriangleNet& net, std::vector<Guide>& out) {
  const dvec3 corners[3] = {dvec3(net.at(net.n, 0)), dvec3(net.at(0, net.n)), dvec3(net.at(0, 0))};
  for (int k = 0; k < 3; ++k) out.push_back({{dvec4(corners[k], 1.0), dvec4(corners[(k + 1) % 3], 1.0)}});
}

Surface build_iss(Params& params) {
  std::vector<IssPatch> patches = read_iss_patches(params);
  modify_iss_patches(params, patches);
  const std::string form = params.choice("form", {"triangles", "degenerate", "quadrilaterals"}, "triangles");
  std::vector<TriangleNet> nets;
  for (const IssPatch& patch : patches) nets.push_back(outward(net_of(patch)));
  Surface surface;
  surface.closed = closes_up(nets);
  add_surface(nets, form, surface.patches);
  // There, though perhaps empty, so that they can be named.
  std::vector<Guide>&triangles = surface.guides["spherical_triangle"], &domains = surface.guides["domain"];
  for (const IssPatch& patch : patches) {
    add_spherical_triangle(net_of(patch), triangles);
    if (std::holds_alternative<PlanarIss>(patch)) add_domain(net_of(patch), domains);
  }
  surface.guides["arcs"] = read_iss_arcs(params, patches);
  return surface;
}

}  // namespace

void register_iss(Registry& registry) {
  registry.add(SurfaceFamily{
      "iss",
      "inverse spherical surfaces, single-valued over spherical triangles (Casciola and Morigi 2004)",
      {{"vertices", "array of [x, y, z]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
        "directions times moduli: corners of planar projection domains, shared by patches"},
       {"moduli", "array of numbers in [0.0001, 10000]", "the lengths of the vertices",
        "one for each vertex"},
       {"degree", "integer 1 to 24", "3", "of every patch but the sphere's"},
       {"patches",
        "array of {\"triangle\": [a, b, c]}, {\"u\": {\"ijk\": [x, y, z], ...}}, {\"sphere\": [a, b, c]} or "
        "{\"join\": {\"patch\", \"across\", \"vertex\", \"coplanar\"}}",
        "[{\"triangle\": [0, 1, 2]}]",
        "on the planar domain of three vertices; on any vectors u_ijk; the sphere itself, of degree 4; with "
        "one "
        "tangent plane along an earlier patch's side opposite corner \"across\", up to \"vertex\", moved "
        "into the "
        "domain's plane unless \"coplanar\" is false. All but the sphere take \"c\", \"radii\" (1 / c) or "
        "\"weights\" (c |u|): a number for all, or numbers keyed \"ijk\" and \"rest\""},
       {"octants", "{\"degree\", \"interior\"}", "none",
        "instead of vertices and patches: a closed surface of eight patches with one tangent plane "
        "everywhere, from "
        "its weights inside the octants, for all alike or an array of 8 (bits 0, 1, 2 make x, y, z "
        "negative)"},
       {"fan", "{\"sides\", \"degree\", \"centre\", \"a\", \"b\", \"weights\"}", "none",
        "instead of these: patches around a vertex, smooth, on the N-gon centre + cos a + sin b; weights for "
        "all "
        "alike or an array of N, the first corner being the centre"},
       {"modify",
        "array of {\"elevate\": degree}, {\"split\": {\"at\": [u, v, w] or \"direction\": [x, y, z], "
        "\"patch\"}}, "
        "{\"quarter\": {\"patch\"}}",
        "[]", "done in order, to all patches or to the one named; the surface stays as it is"},
       {"form", "\"triangles\", \"degenerate\" or \"quadrilaterals\"", "\"triangles\"",
        "as triangular patches, each as one tensor patch with a collapsed side, or each as three regular "
        "ones"},
       {"arcs", "array of {\"from\": [x, y, z], \"to\": [x, y, z]}", "none",
        "directions: over the shorter great-circle arc between them the surface is an inverse circular "
        "curve, which \"arcs\" in \"show\" draws"}},
      build_iss});
}

}  // namespace rondure
