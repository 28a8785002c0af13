// Rational Bezier and B-spline curves, and curves on the unit sphere (Dietz, Hoschek, Juettler 1993, sections
// 3.4, 3.6 and 4), drawn as round tubes.
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/api/registry.h"
#include "renderer/bezier/tube.h"
#include "renderer/projective/ball.h"
#include "surfaces/curve_reader.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

void add(const std::vector<TensorNet>& nets, Surface& surface) {
  for (const TensorNet& net : nets) surface.patches.emplace_back(net);
}

// Tangents that differ by less than this leave no gap between tubes that could be seen.
bool is_smooth(const dvec3& before, const dvec3& after) {
  return glm::dot(before, after) > 0.0 && glm::length(glm::cross(before, after)) < tube_accuracy;
}

CurveTube tube_of(const Params& params, const RationalCurve& piece, double radius) {
  try {
    return curve_tube(piece, radius);
  } catch (const std::invalid_argument& error) {
    params.fail("tube", error.what());
  }
}

// The control polygon; of the tube's own patches there is nothing to see.
void add_guides(const std::vector<dvec4>& polygon, Surface& surface) {
  for (const char* part : {"boundary", "control_surface", "isolines"}) surface.guides[part];
  std::vector<Guide>& legs = surface.guides["net"];
  constexpr double point_balls = 2.0;
  // A control point at infinity, such as that of half a circle, may have been rounded.
  const auto finite = [](const dvec4& p) { return std::abs(p.w) > 1e-9 * glm::length(dvec3(p)); };
  for (std::size_t k = 0; k + 1 < polygon.size(); ++k) {
    const dvec4 &from = polygon[k], &to = polygon[k + 1];
    if (finite(from) && finite(to)) legs.push_back({{from / from.w, to / to.w}, point_balls});
  }
}

Surface build_curve(Params& params) {
  const ReadCurve curve = read_curve(params);
  const double radius = params.number("tube", 0.02, Range::positive());
  Surface surface;
  surface.notes = curve.notes;
  std::vector<CurveTube> tubes;
  std::vector<RationalCurve> pieces;
  for (const RationalCurve& piece : curve.pieces) {
    CurveTube tube = tube_of(params, piece, radius);
    if (tube.nets.empty() && tube.cusps.empty()) continue;
    add(tube.nets, surface);
    for (const dvec3& cusp : tube.cusps) add(ball(cusp, radius), surface);
    tubes.push_back(std::move(tube));
    pieces.push_back(piece);
  }
  if (tubes.empty()) params.fail("the curve is a single point, beside the radius of its tube at least");
  add_guides(curve.polygon, surface);
  for (std::size_t k = 0; k < tubes.size(); ++k) {
    const std::size_t next = (k + 1) % tubes.size();
    const dvec3 end = curve_point(pieces[k], 1.0), start = curve_point(pieces[next], 0.0);
    const bool joined = glm::distance(end, start) < tube_accuracy * radius;
    if (joined && is_smooth(tubes[k].end, tubes[next].start)) continue;
    add(ball(end, radius), surface);
    if (!joined) add(ball(start, radius), surface);
  }
  return surface;
}

}  // namespace

void register_curve(Registry& registry) {
  std::vector<ParameterDoc> docs = curve_docs();
  docs.push_back(
      {"tube", "number > 0", "0.02",
       "radius of the tube that is drawn, with balls at its ends and corners; exact along lines and "
       "circles, else within a thousandth of itself"});
  registry.add(SurfaceFamily{
      "curve",
      "a rational Bezier or B-spline curve in space or on the unit sphere, as a round tube (Dietz, Hoschek, "
      "Juettler 1993, sections 3.4, 3.6 and 4)",
      docs, build_curve});
}

}  // namespace rondure
