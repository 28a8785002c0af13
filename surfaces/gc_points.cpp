#include "surfaces/gc_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/bezier/bounds.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

BlendPoint read_point(const Params& params, const Value& value, bool& weighted) {
  bool good = value.kind == Kind::array && (value.items.size() == 3 || value.items.size() == 4);
  for (std::size_t k = 0; good && k < value.items.size(); ++k) {
    good = value.items[k].kind == Kind::number && std::isfinite(value.items[k].number);
  }
  if (!good) params.fail(value, "a control point is [x, y, z], or [w x, w y, w z, w] with a weight");
  BlendPoint p;
  if (value.items.size() == 4) {
    weighted = true;
    if (!(value.items[3].number > 0.0)) params.fail(value, "the weight of a control point must be positive");
    p.weight = exact_of(value.items[3].number);
  }
  for (std::size_t k = 0; k < 3; ++k) p.point[k] = exact_of(value.items[k].number) / p.weight;
  return p;
}

// Some of the names, for messages.
std::string some_of(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t k = 0; k < names.size() && k < 9; ++k) list += (k > 0 ? ", " : "") + names[k];
  return names.size() > 9 ? list + ", ..." : list;
}

}  // namespace

BlendPoints read_blend_points(Params& params, const std::vector<std::string>& names,
                              const std::vector<std::optional<BlendPoint>>& defaults) {
  BlendPoints out;
  std::vector<std::optional<BlendPoint>> found(names.size());
  const Value* value = params.raw("control_points");
  const Value* rest = nullptr;
  if (value) {
    if (value->kind != Kind::object)
      params.fail(*value,
                  fmt::format("\"control_points\" is an object with a point for each of {}", some_of(names)));
    for (const Value::Member& member : value->members) {
      if (member.key == "rest") {
        rest = &member.value;
        continue;
      }
      const auto at = std::find(names.begin(), names.end(), member.key);
      if (at == names.end()) {
        Value key;
        key.where = member.where;
        const std::string near = nearest_name(member.key, names);
        params.fail(key, fmt::format("\"{}\" names no function of this basis; {}", member.key,
                                     near.empty() ? "they are " + some_of(names)
                                                  : fmt::format("did you mean \"{}\"?", near)));
      }
      found[static_cast<std::size_t>(at - names.begin())] = read_point(params, member.value, out.weighted);
    }
  }
  std::optional<BlendPoint> other;
  if (rest) other = read_point(params, *rest, out.weighted);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!found[k]) found[k] = other ? other : defaults[k];
    if (!found[k]) {
      const std::string text =
          fmt::format("the control point of \"{}\" is missing; \"rest\" would stand for it", names[k]);
      if (value) params.fail(*value, text);
      params.fail("\"control_points\" is missing: " + text);
    }
    out.points.push_back(*found[k]);
  }
  return out;
}

Surface blended_surface(Params& params, const SurfaceComplex& complex, const GcBasis& basis,
                        const BlendPoints& points) {
  auto [nets, roundings] = nets_of(blend(basis, points.points, points.weighted));
  for (std::size_t k = 0; k < nets.size(); ++k) {
    if (bounds_of(nets[k])) continue;
    const std::vector<dvec4>& net = points_of(nets[k]);
    const bool finite = std::all_of(net.begin(), net.end(), [](const dvec4& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
    });
    const std::string text = finite ? fmt::format("the weight of patch {} vanishes somewhere", k)
                                    : fmt::format("the coordinates of patch {} are too large", k);
    if (params.has("control_points")) params.fail("control_points", text);
    params.fail(text);
  }
  Surface surface = oriented_surface(complex, std::move(nets));
  surface.notes.push_back({"rounded", static_cast<double>(roundings),
                           "coordinates of its nets that are rounded, before any transform"});
  return surface;
}

ParameterDoc control_points_doc(const std::string& default_value, const std::string& meaning) {
  return {"control_points", "object: names of functions to [x, y, z] or [w x, w y, w z, w], and \"rest\"",
          default_value, meaning};
}

}  // namespace rondure
