#include "surfaces/arc_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "surfaces/read_numbers.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

// Points closer than this are the same to an arc.
constexpr long double least_arc = 1e-6L;

// What is given in doubles, or to fewer digits: a plane counts as passing through a corner from this
// distance.
constexpr long double plane_tolerance = 1e-9L;

const char* number_word(std::size_t count) { return count == 3 ? "three" : "four"; }

const Value& required(Params& params, const char* key, std::size_t size, const std::string& form) {
  const Value* value = params.raw(key);
  if (!value) params.fail(fmt::format("\"{}\" is missing; it must be {}", key, form));
  if (value->kind != Kind::array || value->items.size() != size)
    params.fail(*value, fmt::format("\"{}\" must be {}", key, form));
  return *value;
}

std::vector<lvec3> read_corners(Params& params, std::size_t count) {
  const std::string form = fmt::format("an array of {} directions, [x, y, z] each", number_word(count));
  const Value& list = required(params, "corners", count, form);
  std::vector<lvec3> corners;
  for (std::size_t k = 0; k < count; ++k)
    corners.push_back(read_direction(params, list.items[k], fmt::format("corners[{}]", k)));
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    if (!(glm::length(corners[next] - corners[k]) > least_arc))
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
  if (!(glm::length(p + q - 2 * distance * unit) > least_arc))
    arc.fail(value, fmt::format("the plane gives {} two halves of a circle to choose from: give a point "
                                "\"through\" which it passes instead",
                                name));
  return middle_in_plane(p, q, unit, distance);
}

SphereArc read_arc(const Params& params, const Value* value, std::size_t k,
                   const std::vector<lvec3>& corners) {
  const std::size_t next = (k + 1) % corners.size();
  const lvec3 &p = corners[k], &q = corners[next];
  const std::string name = fmt::format("arcs[{}]", k);
  if (!value || value->kind == Kind::null) {
    if (!(glm::length(p + q) > least_arc))
      params.fail("corners",
                  fmt::format("corners[{}] and corners[{}] are opposite, so that many great circles "
                              "pass through both: give {} a point \"through\" which it passes",
                              k, next, name));
    return great_arc(p, q);
  }
  if (value->kind != Kind::object)
    params.fail(*value, fmt::format("{} must be null for a great circle, {{ \"through\": [x, y, z] }} or {{ "
                                    "\"plane\": [a, b, c, d] }}",
                                    name));
  Params arc(*value, params.source(), name);
  const Value* point = arc.raw("through");
  const Value* plane = arc.raw("plane");
  arc.finish();
  if ((point == nullptr) == (plane == nullptr)) arc.fail("give either \"through\" or \"plane\"");
  if (plane) return arc_through(p, middle_in_given_plane(arc, *plane, name, p, q), q);
  const lvec3 r = read_direction(params, *point, "\"through\"");
  for (const lvec3& corner : {p, q}) {
    if (!(glm::length(r - corner) > least_arc))
      params.fail(*point,
                  fmt::format("the point through which {} passes must not be one of its corners", name));
  }
  return arc_through(p, r, q);
}

}  // namespace

lvec3 read_direction(const Params& params, const Value& value, const std::string& subject) {
  const auto d = read_numbers<3>(params, value, subject, "a direction, an array of three numbers");
  const lvec3 v(d[0], d[1], d[2]);
  const long double size = std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
  if (!(size > 0)) params.fail(value, subject + " is a direction and must not be zero");
  return glm::normalize(v / size);
}

std::vector<SphereArc> read_arcs(Params& params, std::size_t count) {
  const std::vector<lvec3> corners = read_corners(params, count);
  const std::string form = fmt::format("an array of {} arcs", number_word(count));
  const Value* list = params.has("arcs") ? &required(params, "arcs", count, form) : nullptr;
  std::vector<SphereArc> arcs;
  for (std::size_t k = 0; k < count; ++k)
    arcs.push_back(read_arc(params, list ? &list->items[k] : nullptr, k, corners));
  return arcs;
}

ParameterDoc arcs_doc(std::size_t count) {
  return {"arcs",
          fmt::format("array of {}: null, {{\"through\": [x, y, z]}} or {{\"plane\": [a, b, c, d]}}",
                      number_word(count)),
          fmt::format("{} great circles", number_word(count)),
          "from each corner to the next: null for the shorter arc of the great circle, the circle through a "
          "third direction, or the shorter arc in the plane a x + b y + c z = d, which must contain both "
          "corners"};
}

}  // namespace rondure
