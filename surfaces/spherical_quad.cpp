// Four points of the unit sphere joined by circular arcs, as one biquartic patch (Cobb 1988, section 7).
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "renderer/api/registry.h"
#include "surfaces/families.h"
#include "surfaces/planar_weights.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

// Points closer than this are the same to an arc.
constexpr long double least_distance = 1e-6L;

// What is given in doubles, or to fewer digits: a plane counts as passing through a corner from this
// distance.
constexpr long double plane_tolerance = 1e-9L;

template <std::size_t N>
std::array<double, N> read_numbers(const Params& params, const Value& value, const std::string& subject,
                                   const char* form) {
  std::array<double, N> numbers{};
  bool good = value.kind == Kind::array && value.items.size() == N;
  for (std::size_t k = 0; good && k < N; ++k) {
    numbers[k] = value.items[k].number;
    good = value.items[k].kind == Kind::number && std::isfinite(numbers[k]);
  }
  if (!good) params.fail(value, fmt::format("{} must be {}", subject, form));
  return numbers;
}

// A point of the sphere, given as any vector that points to it.
lvec3 read_direction(const Params& params, const Value& value, const std::string& subject) {
  const auto d = read_numbers<3>(params, value, subject, "a direction, an array of three numbers");
  const lvec3 v(d[0], d[1], d[2]);
  const long double size = std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
  if (!(size > 0)) params.fail(value, subject + " is a direction and must not be zero");
  return glm::normalize(v / size);
}

const Value& required(Params& params, const char* key, std::size_t size, const char* form) {
  const Value* value = params.raw(key);
  if (!value) params.fail(fmt::format("\"{}\" is missing; it must be {}", key, form));
  if (value->kind != Kind::array || value->items.size() != size)
    params.fail(*value, fmt::format("\"{}\" must be {}", key, form));
  return *value;
}

std::array<lvec3, 4> read_corners(Params& params) {
  const Value& list = required(params, "corners", 4, "an array of four directions, [x, y, z] each");
  std::array<lvec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k)
    corners[k] = read_direction(params, list.items[k], fmt::format("corners[{}]", k));
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if (!(glm::length(corners[next] - corners[k]) > least_distance))
      params.fail(list.items[next], fmt::format("corners[{}] and corners[{}] are the same point", k, next));
  }
  return corners;
}

lvec3 middle_in_given_plane(Params& arc, const Value& value, const std::string& name, const lvec3& p,
                            const lvec3& q) {
  const auto n = read_numbers<4>(arc, value, "\"plane\"", "[a, b, c, d] for the plane a x + b y + c z = d");
  const lvec3 normal(n[0], n[1], n[2]);
  const long double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) arc.fail(value, "the plane's normal must not be zero");
  const lvec3 unit = normal / length;
  const long double distance = n[3] / length;
  for (const lvec3& corner : {p, q}) {
    const long double off = std::abs(glm::dot(unit, corner) - distance);
    if (!(off < plane_tolerance))
      arc.fail(value, fmt::format("the plane of {} must contain both corners; it misses one by {:.3g}", name,
                                  static_cast<double>(off)));
  }
  if (!(glm::length(p + q - 2 * distance * unit) > least_distance))
    arc.fail(value, fmt::format("the plane gives {} two halves of a circle to choose from: give a point "
                                "\"through\" which it passes instead",
                                name));
  return middle_in_plane(p, q, unit, distance);
}

SphereArc read_arc(const Params& params, const Value* value, std::size_t k, const lvec3& p, const lvec3& q) {
  const std::string name = fmt::format("arcs[{}]", k);
  if (!value || value->kind == Kind::null) {
    if (!(glm::length(p + q) > least_distance))
      params.fail("corners",
                  fmt::format("corners[{}] and corners[{}] are opposite, so that many great circles "
                              "pass through both: give {} a point \"through\" which it passes",
                              k, (k + 1) % 4, name));
    return great_arc(p, q);
  }
  if (value->kind != Kind::object)
    params.fail(*value, fmt::format("{} must be null for a great circle, {{ \"through\": [x, y, z] }} or {{ "
                                    "\"plane\": [a, b, c, d] }}",
                                    name));
  Params arc(*value, params.source(), name);
  const Value* point = arc.raw("through");
  const Value* plane = arc.raw("plane");
  if ((point == nullptr) == (plane == nullptr)) arc.fail("give either \"through\" or \"plane\"");
  arc.finish();
  if (plane) return arc_through(p, middle_in_given_plane(arc, *plane, name, p, q), q);
  const lvec3 r = read_direction(params, *point, "\"through\"");
  for (const lvec3& corner : {p, q}) {
    if (!(glm::length(r - corner) > least_distance))
      params.fail(*point,
                  fmt::format("the point through which {} passes must not be one of its corners", name));
  }
  return arc_through(p, r, q);
}

SphericalQuad read_quad(Params& params) {
  const std::array<lvec3, 4> corners = read_corners(params);
  const Value* list = params.has("arcs") ? &required(params, "arcs", 4, "an array of four arcs") : nullptr;
  const auto arc = [&](std::size_t k) {
    return read_arc(params, list ? &list->items[k] : nullptr, k, corners[k], corners[(k + 1) % 4]);
  };
  return {{arc(0), arc(1), arc(2), arc(3)}};
}

// At the corner or arc in question, as far as the scene names it.
[[noreturn]] void refuse(Params& params, const QuadDefect& defect) {
  const Value* list =
      params.raw(defect.part == QuadDefect::Part::arc && params.has("arcs") ? "arcs" : "corners");
  const std::string about = params.has("projection_center") && defect.part != QuadDefect::Part::corner
                                ? " (about this projection_center)"
                                : "";
  const bool whole = defect.part == QuadDefect::Part::whole;
  params.fail(whole ? *list : list->items[defect.index], defect.text + about);
}

Surface build(Params& params) {
  const SphericalQuad quad = read_quad(params);
  QuadPatchOptions options;
  const Value* centre = params.raw("projection_center");
  options.centre = centre ? read_direction(params, *centre, "\"projection_center\"") : best_centre(quad);
  if (const auto defect = defect_of(shape_of(quad, options.centre), false)) refuse(params, *defect);
  options.corner_weights = read_corner_weights(params);
  options.may_double = !params.has("middle_weight");
  options.middle_weight = read_middle_weight(params);
  QuadPatch patch = quad_patch(quad, options);
  if (!patch.regular) params.fail("middle_weight", "the patch may fold with this middle weight");
  Surface surface;
  surface.patches.emplace_back(std::move(patch.net));
  return surface;
}

}  // namespace

void register_spherical_quad(Registry& registry) {
  registry.add(SurfaceFamily{
      "spherical_quad",
      "a quadrilateral of circular arcs on the unit sphere as one biquartic patch (Cobb 1988, section 7)",
      {{"corners", "array of four directions [x, y, z]", "",
        "counter-clockwise, seen from outside; each is brought to length 1. (u, v) = (0, 0), (1, 0), (1, 1), "
        "(0, 1) there. Interior angles must be less than 180 degrees"},
       {"arcs", "array of four: null, {\"through\": [x, y, z]} or {\"plane\": [a, b, c, d]}",
        "four great circles",
        "from each corner to the next: null for the shorter arc of the great circle, the circle through a "
        "third "
        "direction, or the shorter arc in the plane a x + b y + c z = d, which must contain both corners"},
       {"projection_center", "direction [x, y, z]",
        "chosen well inside, far from where arcs would bend inward",
        "middle of the stereographic image, which must be convex; one projects from the point opposite"},
       middle_weight_doc("1, doubled until the patch is regular"),
       corner_weights_doc()},
      build});
}

}  // namespace rondure
