// Inverse spherical surfaces (Casciola and Morigi 2004): rational triangles that are single-valued over the
// sphere.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "renderer/api/registry.h"
#include "renderer/bezier/transform.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "renderer/inverse_spherical/closed.h"
#include "renderer/inverse_spherical/spherical_triangle.h"
#include "surfaces/families.h"
#include "surfaces/iss_arcs.h"
#include "surfaces/iss_patches.h"
#include "surfaces/iss_show.h"

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

std::vector<std::string> read_show(Params& params) {
  static const std::vector<std::string> known = {"surface", "control_surface", "control_net",
                                                 "spherical_triangle", "domain"};
  const Value* list = params.raw("show");
  if (!list && params.has("arcs")) return {};
  if (!list) return {"surface"};
  if (list->kind != Value::Kind::array || list->items.empty()) {
    params.fail(*list, "\"show\" is an array of names, at least one");
  }
  std::vector<std::string> names;
  for (const Value& item : list->items) {
    const bool text = item.kind == Value::Kind::string;
    if (!text || std::find(known.begin(), known.end(), item.string) == known.end()) {
      const std::string near = text ? nearest_name(item.string, known) : "";
      params.fail(item, fmt::format("\"show\" names {}{}", fmt::join(known, ", "),
                                    near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
    if (std::find(names.begin(), names.end(), item.string) != names.end()) {
      params.fail(item, fmt::format("\"{}\" is listed twice", item.string));
    }
    names.push_back(item.string);
  }
  return names;
}

IssPart part_named(const std::string& name) {
  return name == "control_surface"      ? IssPart::control_surface
         : name == "control_net"        ? IssPart::control_net
         : name == "spherical_triangle" ? IssPart::spherical_triangle
                                        : IssPart::domain;
}

Surface build(Params& params) {
  std::vector<IssPatch> patches = read_iss_patches(params);
  modify_iss_patches(params, patches);
  const std::string form = params.choice("form", {"triangles", "degenerate", "quadrilaterals"}, "triangles");
  const std::vector<std::string> show = read_show(params);
  const double wire = params.number("wire", 0.01, Range::positive());
  std::vector<TriangleNet> nets;
  for (const IssPatch& patch : patches) nets.push_back(outward(net_of(patch)));
  Surface surface;
  surface.closed = show.size() == 1 && show[0] == "surface" && !params.has("arcs") && closes_up(nets);
  for (const std::string& name : show) {
    if (name == "surface") {
      add_surface(nets, form, surface.patches);
      continue;
    }
    for (const IssPatch& patch : patches) add_iss_part(part_named(name), patch, wire, surface.patches);
  }
  add_iss_arcs(params, patches, wire, surface.patches);
  if (surface.patches.empty()) {
    params.fail(params.has("show") ? "show" : "arcs",
                params.has("show") ? "there is nothing to show: no patch has a planar domain"
                                   : "there is nothing to show: the list is empty");
  }
  return surface;
}

}  // namespace

void register_iss(Registry& registry) {
  registry.add(SurfaceFamily{
      "iss",
      "inverse spherical surfaces, single-valued over spherical triangles (Casciola and Morigi 2004)",
      {{"vertices", "array of [x, y, z]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
        "directions times moduli: corners of planar projection domains, shared by patches"},
       {"moduli", "array of numbers > 0", "the lengths of the vertices", "one for each vertex"},
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
       {"show",
        "array of \"surface\", \"control_surface\", \"control_net\", \"spherical_triangle\", \"domain\"",
        "[\"surface\"]",
        "the patches, the flat triangles between control points, these triangles' edges, the domain's sides "
        "on "
        "the unit sphere, those of the planar projection domain"},
       {"arcs", "array of {\"from\": [x, y, z], \"to\": [x, y, z]}", "none",
        "directions: over the shorter great-circle arc between them the surface is an inverse circular "
        "curve, "
        "drawn as a wire; alone, unless \"show\" is given too"},
       {"wire", "number > 0", "0.01", "radius of what is drawn as wires"}},
      build});
}

}  // namespace rondure
