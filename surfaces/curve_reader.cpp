#include "surfaces/curve_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/projective/sphere_curve.h"
#include "surfaces/arc_reader.h"
#include "surfaces/quadric_reader.h"
#include "surfaces/read_numbers.h"
#include "surfaces/spline_reader.h"

namespace rondure {
namespace {

// Points of the sphere closer than this are the same.
constexpr long double least_distance = 1e-6L;
// Below this ratio of singular values rounding decides which curve it is.
constexpr long double least_condition = 1e-12L;

RationalCurve rounded(const std::vector<lvec4>& points) { return {points.begin(), points.end()}; }

const Value& read_list(Params& params, const char* key, std::size_t least, const char* form) {
  const Value& list = *params.raw(key);
  if (list.kind != Value::Kind::array || list.items.size() < least)
    params.fail(list, fmt::format("\"{}\" must be an array of at least {} {}", key, least, form));
  return list;
}

std::vector<lvec3> read_directions(Params& params, const char* key, std::size_t least) {
  const Value& list = read_list(params, key, least, "directions, [x, y, z] each");
  std::vector<lvec3> points;
  for (const Value& item : list.items)
    points.push_back(read_direction(params, item, fmt::format("{}[{}]", key, points.size())));
  return points;
}

void must_differ(const Params& params, const Value& at, const lvec3& p, const lvec3& q) {
  if (!(glm::length(p - q) > least_distance)) params.fail(at, "this is the same point as another beside it");
}

// Control points with "degree" and "knots": one polynomial unless either is given.
BSpline read_spline(Params& params, std::vector<lvec4> points, int highest) {
  BSpline spline;
  const std::size_t count = points.size();
  spline.points = std::move(points);
  const Value* given = params.raw("knots");
  if (given) spline.knots = read_knots(params, *given);
  const std::int64_t natural = static_cast<std::int64_t>(given ? spline.knots.size() - count : count) - 1;
  if (!params.has("degree") && (natural < 1 || natural > highest))
    params.fail(
        fmt::format("as {}, these control points would make a curve of degree {}; degrees are 1 to {}",
                    given ? "many knots say" : "one polynomial", natural, highest));
  spline.degree = static_cast<int>(params.integer("degree", natural, 1, highest));
  if (count <= static_cast<std::size_t>(spline.degree))
    params.fail("degree",
                fmt::format("degree {} needs {} control points at least", spline.degree, spline.degree + 1));
  if (!given) spline.knots = clamped_knots(spline.degree, count);
  const std::string defect = knot_defect(spline.degree, spline.knots, count);
  if (!defect.empty()) params.fail("knots", defect);
  return spline;
}

ReadCurve in_space(Params& params) {
  std::vector<lvec4> points;
  for (const Value& item : read_list(params, "net", 2, "control points").items) {
    const auto p =
        read_numbers<4>(params, item, "a control point", "an array of four numbers, [wx, wy, wz, w]");
    points.emplace_back(p[0], p[1], p[2], p[3]);
  }
  const BSpline spline = read_spline(params, std::move(points), max_degree);
  ReadCurve curve;
  for (const std::size_t span : spans_of(spline.degree, spline.knots, spline.points.size()))
    curve.pieces.push_back(rounded(bezier_piece(spline, span)));
  curve.polygon = rounded(spline.points);
  return curve;
}

// The image on a ruled quadric; piece by piece, the control polygon too.
ReadCurve ruled_curve(const BSpline& spline) {
  ReadCurve curve;
  for (const std::size_t span : spans_of(spline.degree, spline.knots, spline.points.size())) {
    const TensorPreimage piece(spline.degree, 0, bezier_piece(spline, span));
    const auto square =
        multiply(piece, piece, [](const lvec4& a, const lvec4& b) { return ruled_image(a, b); });
    curve.pieces.push_back(rounded(square.coefficients));
    const RationalCurve& points = curve.pieces.back();
    curve.polygon.insert(curve.polygon.end(), points.begin() + (curve.polygon.empty() ? 0 : 1), points.end());
  }
  return curve;
}

ReadCurve from_preimage(Params& params, bool ruled) {
  std::vector<lvec4> points;
  for (const Value& item : read_list(params, "preimage", 2, "control points").items)
    points.push_back(read_preimage_point(params, item));
  const long double factor = squaring_factor(points);
  for (lvec4& p : points) p *= factor;
  const BSpline spline = read_spline(params, std::move(points), max_degree / 2);
  if (ruled) return ruled_curve(spline);
  ReadCurve curve;
  for (const std::size_t span : spans_of(spline.degree, spline.knots, spline.points.size()))
    curve.pieces.push_back(rounded(curve_image(bezier_piece(spline, span))));
  curve.polygon = rounded(sphere_image(spline).points);
  return curve;
}

std::vector<long double> read_parameters(Params& params, std::size_t count) {
  std::vector<long double> parameters;
  for (std::size_t k = 0; k < count; ++k)
    parameters.push_back(static_cast<long double>(k) / static_cast<long double>(count - 1));
  if (!params.raw("parameters")) return parameters;
  const std::vector<double> given = params.numbers("parameters");
  parameters.assign(given.begin(), given.end());
  for (std::size_t k = 1; k < parameters.size(); ++k) {
    if (!(parameters[k] > parameters[k - 1])) params.fail("parameters", "\"parameters\" must increase");
  }
  if (given.size() != count || given.front() != 0.0 || given.back() != 1.0)
    params.fail("parameters",
                fmt::format("\"parameters\" must be {} numbers from 0 to 1, one for each point", count));
  return parameters;
}

ReadCurve interpolating(Params& params) {
  const std::vector<lvec3> points = read_directions(params, "interpolate", 3);
  constexpr std::size_t most = max_degree + 1;
  if (points.size() % 2 == 0 || points.size() > most)
    params.fail(
        "interpolate",
        fmt::format("a curve of degree 2n on the sphere passes through 2n + 1 points: give an odd number "
                    "of them, {} at most, not {}",
                    most, points.size()));
  const Interpolation found = interpolate(points, read_parameters(params, points.size()));
  if (!found.inaccessible.empty())
    params.fail("interpolate",
                fmt::format("the curve of degree {} that these points and parameters determine does not pass "
                            "through point {}: such points are inaccessible (Dietz, Hoschek, Juettler 1993, "
                            "section 3.6); change its parameter",
                            points.size() - 1, fmt::join(found.inaccessible, ", ")));
  if (!(found.condition > least_condition))
    params.fail("interpolate",
                fmt::format("these points and parameters do not determine one curve but for rounding: the "
                            "singular values of the linear problem have a ratio of {:.3g}",
                            static_cast<double>(found.condition)));
  ReadCurve curve;
  curve.polygon = rounded(curve_image(found.preimage));
  curve.pieces.push_back(curve.polygon);
  curve.notes.push_back({"condition", static_cast<double>(found.condition),
                         "of the interpolation, the least singular value of its linear equations over the "
                         "greatest: errors of the points grow by up to its inverse"});
  return curve;
}

ReadCurve arcs_of(const std::vector<lvec4>& preimage) {
  ReadCurve curve;
  for (std::size_t k = 0; k + 1 < preimage.size(); ++k) {
    curve.pieces.push_back(rounded(curve_image({preimage[k], preimage[k + 1]})));
    curve.polygon.insert(curve.polygon.end(), curve.pieces[k].begin() + (k > 0 ? 1 : 0),
                         curve.pieces[k].end());
  }
  return curve;
}

ReadCurve spline_of_arcs(Params& params) {
  const std::vector<lvec3> points = read_directions(params, "spline", 2);
  const Value& list = *params.raw("spline");
  for (std::size_t k = 1; k < points.size(); ++k)
    must_differ(params, list.items[k], points[k], points[k - 1]);
  if (const Value* through = params.raw("through")) {
    const lvec3 r = read_direction(params, *through, "\"through\"");
    for (std::size_t k = 0; k < 2; ++k) must_differ(params, *through, r, points[k]);
    return arcs_of(circular_spline(points, r).preimage);
  }
  const lvec3 middle = points[0] + points[1];
  if (!(glm::length(middle) > least_distance))
    params.fail(list.items[1],
                "the first two points are opposite: give a point \"through\" which the first arc passes");
  return arcs_of(circular_spline(points, glm::normalize(middle)).preimage);
}

ReadCurve on_circle(Params& params, const char* key) {
  const std::vector<lvec3> p = read_directions(params, key, 3);
  const Value& list = *params.raw(key);
  if (p.size() != 3) params.fail(list, fmt::format("\"{}\" must be three directions, [x, y, z] each", key));
  for (std::size_t k = 0; k < 3; ++k) must_differ(params, list.items[k], p[k], p[(k + 1) % 3]);
  if (key == std::string_view("arc")) return arcs_of(circle_through(p[0], p[1], p[2]));
  // Three equal arcs from the first point, so that all control points are finite.
  const lvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
  const lvec3 centre = glm::dot(normal, p[0]) * normal, ahead = p[0] - centre;
  const lvec3 aside = glm::cross(normal, ahead);
  const auto at = [&](int sixths) {
    const long double turn = sixths * std::numbers::pi_v<long double> / 3;
    return sixths % 6 == 0 ? p[0] : glm::normalize(centre + std::cos(turn) * ahead + std::sin(turn) * aside);
  };
  ReadCurve curve;
  for (int k = 0; k < 6; k += 2) {
    const ReadCurve arc = arcs_of(circle_through(at(k), at(k + 1), at(k + 2)));
    curve.pieces.push_back(arc.pieces[0]);
    curve.polygon.insert(curve.polygon.end(), arc.polygon.begin() + (k > 0 ? 1 : 0), arc.polygon.end());
  }
  return curve;
}

// The quadric that the curve is to lie on, instead of the unit sphere.
std::optional<Quadric> read_other_quadric(Params& params, std::string_view form) {
  std::optional<Quadric> quadric;
  for (const char* key : {"quadric", "semi_axes", "matrix"}) {
    if (!params.has(key) || quadric) continue;
    if (form == "net") params.fail(key, fmt::format("\"{}\" has no meaning for \"net\"", key));
    quadric = read_quadric(params);
    if (is_ruled(quadric->kind) && form != "preimage")
      params.fail(key,
                  "this quadric carries straight lines and is no image of the sphere: give a \"preimage\"");
  }
  return quadric;
}

void map_to_quadric(const Quadric& quadric, ReadCurve& curve) {
  const lmat4 map = map_to(quadric);
  for (RationalCurve& piece : curve.pieces) {
    for (dvec4& p : piece) p = dvec4(map * lvec4(p));
  }
  for (dvec4& p : curve.polygon) p = dvec4(map * lvec4(p));
}

}  // namespace

ReadCurve read_curve(Params& params) {
  static const std::vector<const char*> forms = {"net", "preimage", "interpolate", "spline", "arc", "circle"};
  const char* form = nullptr;
  for (const char* name : forms) {
    if (!params.has(name)) continue;
    if (form) params.fail(name, fmt::format("give either \"{}\" or \"{}\", not both", form, name));
    form = name;
  }
  if (!form) params.fail(fmt::format("give the curve as one of \"{}\"", fmt::join(forms, "\", \"")));
  const std::string_view is = form;
  const auto only_for = [&](const char* key, bool known) {
    if (params.has(key) && !known)
      params.fail(key, fmt::format("\"{}\" has no meaning for \"{}\"", key, form));
  };
  only_for("degree", is == "net" || is == "preimage");
  only_for("knots", is == "net" || is == "preimage");
  only_for("parameters", is == "interpolate");
  only_for("through", is == "spline");
  const std::optional<Quadric> quadric = read_other_quadric(params, is);
  ReadCurve curve = is == "net"           ? in_space(params)
                    : is == "preimage"    ? from_preimage(params, quadric && is_ruled(quadric->kind))
                    : is == "interpolate" ? interpolating(params)
                    : is == "spline"      ? spline_of_arcs(params)
                                          : on_circle(params, form);
  if (quadric) map_to_quadric(*quadric, curve);
  for (const RationalCurve& piece : curve.pieces) {
    if (!is_finite(piece))
      params.fail(form, is == "net" || quadric
                            ? "the curve reaches infinity, or has no point, where its weight is zero"
                            : "the four coordinates of the preimage vanish together somewhere on the "
                              "curve");
  }
  return curve;
}

std::vector<ParameterDoc> curve_docs() {
  return {
      {"net", "array of [wx, wy, wz, w]", "none", "control points of a rational curve in space"},
      {"preimage", "array of [p0, p1, p2, p3]", "none",
       "control points in projective space of a curve whose image on the sphere or another quadric has twice "
       "the "
       "degree"},
      {"degree", "integer from 1 to 24, of a preimage 12", "one less than the control points",
       "of \"net\" or \"preimage\"; with a lower one they are those of a B-spline curve"},
      {"knots", "array of numbers", "equidistant, the ends repeated",
       "of a B-spline curve, not decreasing; as many as control points and degree + 1"},
      {"interpolate", "array of 2n + 1 directions [x, y, z]", "none",
       "points of the unit sphere through which its one curve of degree 2n passes (theorem 3.13)"},
      {"parameters", "array of numbers", "equidistant", "for \"interpolate\": from 0 to 1, where it passes"},
      {"spline", "array of directions [x, y, z]", "none",
       "points of the unit sphere joined by circular arcs without corners (equation 36)"},
      {"through", "direction [x, y, z]", "the middle between the first two points",
       "for \"spline\": a point on the first arc"},
      {"arc", "array of three directions [x, y, z]", "none",
       "circular arc on the unit sphere: start, between, end"},
      {"circle", "array of three directions [x, y, z]", "none",
       "the whole circle through three points of it"},
      quadric_doc(),
      semi_axes_doc(),
      matrix_doc(),
  };
}

}  // namespace rondure
