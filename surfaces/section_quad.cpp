#include "surfaces/section_quad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/projective/ruled_patch.h"
#include "surfaces/read_numbers.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

// Of coordinates of about 1: scenes give six digits or more.
constexpr long double on_quadric = 1e-5L;
// How much the two factors of the holonomy may differ where a patch of degree (2, 2) is made all the same.
constexpr long double same_factors = 1e-9L;

// The plane through three points, all homogeneous.
lvec4 plane_of(const lvec4& p, const lvec4& q, const lvec4& r) {
  const auto minor = [&](int i, int j, int k) {
    return p[i] * (q[j] * r[k] - q[k] * r[j]) - p[j] * (q[i] * r[k] - q[k] * r[i]) +
           p[k] * (q[i] * r[j] - q[j] * r[i]);
  };
  return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
}

class SectionReader {
 public:
  SectionReader(Params& params, const Quadric& quadric)
      : params_(params), back_(glm::inverse(map_to(quadric))), forth_(glm::transpose(map_to(quadric))) {
    const bool central = quadric.kind == QuadricKind::one_sheet;
    centre_ = back_ * (quadric.frame * (central ? lvec4(0, 0, 0, 1) : lvec4(0, 0, 1, 0)));
  }

  RuledQuad read() {
    const Value& corners = list("corners", "points [x, y, z]");
    RuledQuad quad;
    for (std::size_t k = 0; k < 4; ++k)
      quad.corner[k] = point(params_, corners.items[k], fmt::format("corners[{}]", k));
    const Value* sections = params_.has("sections") ? &list("sections", "plane sections") : nullptr;
    for (std::size_t k = 0; k < 4; ++k)
      quad.arc[k] =
          section(sections ? &sections->items[k] : nullptr, k, quad.corner[k], quad.corner[(k + 1) % 4]);
    const lvec2 h = holonomy(quad);
    if (!(h.x > 0) || !(h.y > 0))
      params_.fail("corners",
                   "these sides do not bound a region: one that passes through infinity or around the "
                   "quadric must be replaced by the other arc of its section");
    return quad;
  }

 private:
  Params& params_;
  lmat4 back_, forth_;
  lvec4 centre_;

  const Value& list(const char* key, const char* form) {
    const Value& value = *params_.raw(key);
    if (value.kind != Kind::array || value.items.size() != 4)
      params_.fail(value, fmt::format("\"{}\" must be an array of four {}", key, form));
    return value;
  }

  RuledPoint point(const Params& params, const Value& value, const std::string& subject) const {
    const auto p = read_numbers<3>(params, value, subject, "a point, an array of three numbers");
    const lvec4 x = back_ * lvec4(p[0], p[1], p[2], 1);
    const long double off = (x.x * x.x + x.y * x.y - x.z * x.z - x.w * x.w) / glm::dot(x, x);
    if (!(std::abs(off) < on_quadric)) params.fail(value, subject + " does not lie on the quadric");
    return ruled_preimage(x);
  }

  SectionArc section(const Value* value, std::size_t k, const RuledPoint& p, const RuledPoint& q) {
    const std::string name = fmt::format("sections[{}]", k);
    const lvec4 x = ruled_point(p.a, p.b), y = ruled_point(q.a, q.b);
    if (!value || value->kind == Kind::null) {
      const lvec4 h = plane_of(x, y, centre_);
      if (!(glm::length(h) > 1e-9L * glm::length(centre_)))
        params_.fail(
            value ? *value : params_.raw("corners")->items[k],
            fmt::format("many planes contain both ends of {} and the quadric's centre or axis: give one",
                        name));
      return in_plane(value ? *value : params_.raw("corners")->items[k], name, p, q, h);
    }
    if (value->kind != Kind::object)
      params_.fail(
          *value,
          fmt::format("{} must be null, {{ \"through\": [x, y, z] }} or {{ \"plane\": [a, b, c, d] }}",
                      name));
    Params arc(*value, params_.source(), name);
    const Value* through = arc.raw("through");
    const Value* plane = arc.raw("plane");
    arc.finish();
    if ((through == nullptr) == (plane == nullptr)) arc.fail("give either \"through\" or \"plane\"");
    if (plane) {
      const auto n =
          read_numbers<4>(arc, *plane, "\"plane\"", "[a, b, c, d] for the plane a x + b y + c z = d");
      const lvec4 h = forth_ * lvec4(n[0], n[1], n[2], -static_cast<long double>(n[3]));
      for (const lvec4& end : {x, y}) {
        if (!(std::abs(glm::dot(h, end)) <= on_quadric * glm::length(h) * glm::length(end)))
          arc.fail(*plane, fmt::format("the plane of {} must contain both corners", name));
      }
      return in_plane(*plane, name, p, q, h);
    }
    const RuledPoint r = point(arc, *through, "\"through\"");
    const SectionArc found = section_through(p, r, q);
    if (!std::isfinite(found.x) || !std::isfinite(found.y))
      arc.fail(*through,
               fmt::format("the point through which {} passes must not lie on a straight line of the quadric "
                           "with a corner",
                           name));
    return found;
  }

  SectionArc in_plane(const Value& at, const std::string& name, const RuledPoint& p, const RuledPoint& q,
                      const lvec4& h) const {
    const auto found = section_in_plane(p, q, h, forth_ * lvec4(0, 0, 0, 1));
    if (!found)
      params_.fail(
          at, fmt::format("{} has no arc between its corners that stays finite, or its plane touches the "
                          "quadric there",
                          name));
    return *found;
  }
};

bool weights_of_one_sign(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  const bool all = std::all_of(points.begin(), points.end(), [](const dvec4& p) { return p.w > 0.0; });
  return all || std::all_of(points.begin(), points.end(), [](const dvec4& p) { return p.w < 0.0; });
}

}  // namespace

Preimage read_section_quad(Params& params, const Quadric& quadric) {
  const RuledQuad quad = SectionReader(params, quadric).read();
  const std::string construction =
      params.choice("construction", {"auto", "biquadratic", "degree_2_4"}, "auto");
  const std::string along = params.choice("quartic", {"auto", "u", "v"}, "auto");
  const lvec2 h = holonomy(quad);
  const long double defect = std::log(h.x / h.y);
  const bool exists = std::abs(defect) <= same_factors;
  if (construction == "biquadratic" && !exists)
    params.fail(
        "construction",
        fmt::format(
            "a biquadratic patch exists only where corners 0 and 2 lie in a plane with the points "
            "where the sections of corners 1 and 3 meet again (Dietz, Hoschek, Juettler 1993, theorem "
            "3.9); here the logarithm of the cross-ratio that says so is {:.9g}, not 0. "
            "\"degree_2_4\" always exists",
            static_cast<double>(defect)));
  std::vector<TensorPreimage> list;
  if (construction != "degree_2_4" && exists) list.push_back(bilinear_preimage(quad));
  if (construction != "biquadratic") {
    if (along != "u") list.push_back(linear_quadratic_preimage(quad));
    if (along != "v") list.push_back(quadratic_linear_preimage(quad));
  }
  const TensorPreimage* best = nullptr;
  for (const TensorPreimage& candidate : list) {
    if (!is_regular_ruled(candidate)) continue;
    const bool positive = weights_of_one_sign(quadric_image(candidate, quadric));
    if (!best || positive) best = &candidate;
    if (positive) break;
  }
  if (!best) params.fail("corners", "the patch between these sections folds: sides must not cross");
  TensorPreimage found = *best;
  // The same points with the other sign, which is that of all weights.
  if (points_of(quadric_image(found, quadric)).front().w < 0) {
    for (lvec4& c : found.coefficients) c = {-c[0], -c[1], c[2], c[3]};
  }
  return found;
}

std::vector<ParameterDoc> section_quad_docs() {
  return {
      {"corners", "four points [x, y, z]", "none",
       "of a ruled quadric: a patch between plane sections, (u, v) = (0, 0), (1, 0), (1, 1), (0, 1) there. "
       "On the "
       "others, \"surface\" may be a circular_quad"},
      {"sections", "array of four: null, {\"through\": [x, y, z]} or {\"plane\": [a, b, c, d]}", "four nulls",
       "from each corner to the next: the section through a third point of the quadric, or in the plane a x "
       "+ b y "
       "+ c z = d; null for the plane that contains the centre of one_sheet, or the axis of "
       "hyperbolic_paraboloid. A plane's arc is the finite one, the shorter of two"},
      {"construction", "\"auto\", \"biquadratic\" or \"degree_2_4\"", "auto",
       "for \"corners\": degree (2, 2) where it exists, or (2, 4)"},
      {"quartic", "\"auto\", \"u\" or \"v\"", "auto",
       "for \"corners\": of degree_2_4, the direction of degree 4; auto tries v, then u"}};
}

}  // namespace rondure
