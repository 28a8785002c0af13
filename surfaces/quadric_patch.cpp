// Rational patches on any ellipsoid, hyperboloid or paraboloid, as projective images of patches of the sphere
// or of its ruled counterpart (Dietz, Hoschek, Juettler 1993, section 2.3 and conclusion).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/api/registry.h"
#include "renderer/bezier/bounds.h"
#include "renderer/intersect/local_ray.h"
#include "surfaces/families.h"
#include "surfaces/preimage_reader.h"
#include "surfaces/quadric_reader.h"
#include "surfaces/section_quad.h"

namespace rondure {
namespace {

constexpr long double radians_per_degree = 0.017453292519943295769236907684886127L;

// The families that build patches of the unit sphere.
Registry sphere_families() {
  Registry registry;
  register_circular_quad(registry);
  register_circular_triangle(registry);
  register_projected_net(registry);
  register_sphere_cap(registry);
  register_sphere_octant(registry);
  register_sphere_tiling(registry);
  register_spherical_bspline(registry);
  register_spherical_quad(registry);
  register_stereographic_patch(registry);
  return registry;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return list;
}

Surface mapped_surface(Params& params, const Quadric& quadric) {
  if (is_ruled(quadric.kind))
    params.fail("surface",
                "this quadric carries straight lines and is no image of the sphere: give "
                "\"rulings\" or a \"preimage\" instead");
  Params inner = params.object("surface");
  const Registry registry = sphere_families();
  const std::string type = inner.text("type");
  const SurfaceFamily* family = registry.family(type);
  if (!family)
    inner.fail("type", fmt::format("\"surface\" must be of a type that makes patches of the sphere: {}",
                                   quoted_list(registry.family_names())));
  Surface surface = family->build(inner);
  inner.finish();
  const lmat4 map = map_to(quadric);
  for (Net& net : surface.patches) {
    for (dvec4& p : points_of(net)) p = dvec4(map * lvec4(p));
  }
  surface.closed = surface.closed && quadric.kind == QuadricKind::ellipsoid;
  return surface;
}

std::array<double, 2> read_interval(const Params& params, const Value& value) {
  std::array<double, 2> ends{};
  bool good = value.kind == Value::Kind::array && value.items.size() == 2;
  for (std::size_t k = 0; good && k < 2; ++k) {
    ends[k] = value.items[k].number;
    good = value.items[k].kind == Value::Kind::number && std::isfinite(ends[k]);
  }
  if (!good || !(ends[0] < ends[1]))
    params.fail(value, "an interval of rulings must be two numbers, the lower first");
  return ends;
}

// The points (p0, p1) or (p3, p2) of a ruling: its parameter as a number, or as an angle.
std::array<long double, 2> ruling(const Quadric& quadric, double parameter) {
  if (quadric.kind == QuadricKind::hyperbolic_paraboloid) return {1, parameter};
  return {std::cos(parameter * radians_per_degree), std::sin(parameter * radians_per_degree)};
}

Surface between_rulings(Params& params, const Quadric& quadric) {
  if (!is_ruled(quadric.kind)) params.fail("rulings", "this quadric carries no straight lines");
  const Value& value = *params.raw("rulings");
  if (value.kind != Value::Kind::array || value.items.size() != 2)
    params.fail(value, "\"rulings\" must be two intervals, one for each family of straight lines");
  const auto s = read_interval(params, value.items[0]), t = read_interval(params, value.items[1]);
  if (quadric.kind == QuadricKind::one_sheet) {
    if (s[1] - s[0] >= 180.0 || t[1] - t[0] >= 180.0)
      params.fail(value, "an interval of rulings must be shorter than 180 degrees");
    // Height is the tangent of the difference.
    if (s[1] - t[0] >= 90.0 || t[1] - s[0] >= 90.0)
      params.fail(value, "rulings whose angles differ by 90 degrees or more do not meet in a finite point");
  }
  const lmat4 map = map_to(quadric);
  TensorNet net(1, 1);
  for (int i = 0; i <= 1; ++i) {
    for (int j = 0; j <= 1; ++j) {
      const auto a = ruling(quadric, s[static_cast<std::size_t>(i)]);
      const auto b = ruling(quadric, t[static_cast<std::size_t>(j)]);
      const lvec4 p(a[0], a[1], b[1], b[0]);
      net.at(i, j) = dvec4(map * ruled_image(p, p));
    }
  }
  Surface surface;
  surface.patches.emplace_back(std::move(net));
  return surface;
}

Surface from_preimage(Params& params, const Quadric& quadric) {
  Surface surface;
  for (const Preimage& preimage : read_preimages(params, "preimage", is_ruled(quadric.kind)))
    surface.patches.push_back(quadric_image(preimage, quadric));
  return surface;
}

Surface between_sections(Params& params, const Quadric& quadric) {
  if (!is_ruled(quadric.kind))
    params.fail("corners",
                "this quadric is an image of the sphere: give a \"surface\" of type \"circular_quad\"");
  Surface surface;
  surface.patches.push_back(quadric_image(read_section_quad(params, quadric), quadric));
  return surface;
}

// Whether a weight vanishes but for rounding: on a paraboloid weights touch zero without changing sign.
bool comes_near_infinity(const Net& net) {
  constexpr double furthest = 1e12;
  const Box box = *bounds_of(net);
  const double reach = std::max(largest(box.low), largest(box.high));
  const dvec4& corner = points_of(net).front();
  return !(reach * std::abs(corner.w) <= furthest * std::max(std::abs(corner.w), largest(dvec3(corner))));
}

Surface build_quadric_patch(Params& params) {
  const Quadric quadric = read_quadric(params);
  const char* const sources[] = {"surface", "preimage", "rulings", "corners"};
  const char* source = nullptr;
  for (const char* name : sources) {
    if (!params.has(name)) continue;
    if (source) params.fail(name, fmt::format("give either \"{}\" or \"{}\", not both", source, name));
    source = name;
  }
  if (!source) params.fail("give the patch as \"surface\", \"preimage\", \"rulings\" or \"corners\"");
  for (const char* key : {"sections", "construction", "quartic"}) {
    if (params.has(key) && source != sources[3])
      params.fail(key, fmt::format("\"{}\" has no meaning without \"corners\"", key));
  }
  Surface surface = source == sources[0]   ? mapped_surface(params, quadric)
                    : source == sources[1] ? from_preimage(params, quadric)
                    : source == sources[2] ? between_rulings(params, quadric)
                                           : between_sections(params, quadric);
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    if (bounds_of(surface.patches[k]) && !comes_near_infinity(surface.patches[k])) continue;
    params.fail(source, fmt::format("patch {} reaches infinity{}", k,
                                    quadric.kind == QuadricKind::two_sheets
                                        ? ": on a hyperboloid of two sheets it must stay on one side of z = 0"
                                    : quadric.kind == QuadricKind::elliptic_paraboloid
                                        ? ": on an elliptic paraboloid it must not contain (0, 0, 1)"
                                        : ""));
  }
  return surface;
}

}  // namespace

void register_quadric_patch(Registry& registry) {
  SurfaceFamily family{
      "quadric_patch",
      "patches of any ellipsoid, hyperboloid or paraboloid, by projective maps (Dietz, Hoschek, Juettler "
      "1993, section 2.3): given as one of surface, preimage, rulings and corners",
      {quadric_doc(),
       semi_axes_doc(),
       matrix_doc(),
       {"surface", "object", "none",
        "patches of the sphere to be mapped there, with \"type\" and the parameters of circular_quad, "
        "sphere_tiling and so on. two_sheets shows the southern hemisphere as its upper sheet; on "
        "elliptic_paraboloid the north pole goes to infinity. Not for ruled quadrics"},
       preimages_doc("preimage", "none"),
       {"rulings", "two intervals [low, high]", "none",
        "of a ruled quadric: a bilinear patch between straight lines. one_sheet: angles s, t in degrees, "
        "with "
        "longitude s + t and z/c = tan(s - t); hyperbolic_paraboloid: numbers, with x/a = (s + t)/2, y/b = "
        "(s - t)/2, z/c = s t"}},
      build_quadric_patch};
  for (ParameterDoc& doc : section_quad_docs()) family.parameters.push_back(std::move(doc));
  registry.add(std::move(family));
}

}  // namespace rondure
