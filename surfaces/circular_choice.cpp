#include "surfaces/circular_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/projective/orientation.h"
#include "renderer/projective/positive_shape.h"

namespace rondure {
namespace {

constexpr double most_extreme_ratio = 1e6;

// With d/du x d/dv turned round.
Preimage mirrored(const Preimage& preimage) {
  if (const auto* t = std::get_if<TensorPreimage>(&preimage)) {
    TensorPreimage out(t->m, t->n);
    for (int i = 0; i <= t->m; ++i) {
      for (int j = 0; j <= t->n; ++j) out.at(i, j) = t->at(t->m - i, j);
    }
    return out;
  }
  const auto& t = std::get<TrianglePreimage>(preimage);
  TrianglePreimage out(t.n);
  for (int i = 0; i <= t.n; ++i) {
    for (int j = 0; j <= t.n - i; ++j) out.at(i, j) = t.at(j, i);
  }
  return out;
}

bool weights_positive(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  return std::all_of(points.begin(), points.end(), [](const dvec4& p) { return p.w > 0.0; });
}

// Whether J is negative at a corner: it is there whatever the shape, as its sign is that of the angle's sine.
bool folds_at_corner(const Preimage& preimage) {
  const auto folds = [](const auto& j, std::initializer_list<long double> corners) {
    long double largest = 0;
    for (const long double c : j.coefficients) largest = std::max(largest, std::abs(c));
    return std::min(corners) < -1e-12L * largest;
  };
  if (const auto* t = std::get_if<TensorPreimage>(&preimage)) {
    const auto j = orientation(*t);
    return folds(j, {j.at(0, 0), j.at(j.m, 0), j.at(0, j.n), j.at(j.m, j.n)});
  }
  const auto j = orientation(std::get<TrianglePreimage>(preimage));
  return folds(j, {j.at(j.n, 0), j.at(0, j.n), j.at(0, 0)});
}

// The image at the first shape of positive weights in any of the families, and notes on it, or on why there
// is none.
std::optional<Net> sought(const std::vector<const PreimageFamily*>& families, std::vector<Note>& notes) {
  using Outcome = PositiveShape::Outcome;
  bool proved = true;
  for (const PreimageFamily* family : families) {
    const PositiveShape found = positive_shape(*family);
    proved = proved && found.outcome == Outcome::none;
    if (found.outcome != Outcome::found) continue;
    Net net = sphere_image(preimage_at(*family, found.shape));
    if (!weights_positive(net)) continue;
    notes.push_back(
        {"positive_weights", 1, "found at the shape that follows, not where ratios are 1 and turns 0"});
    for (std::size_t k = 0; k < family->ratios + family->turns; ++k) {
      const bool ratio = k < family->ratios;
      notes.push_back(
          {fmt::format("shape_{}", k),
           static_cast<double>(ratio ? found.shape.ratio[k]
                                     : found.shape.turn[k - family->ratios] * degrees_per_radian),
           fmt::format("number {} of \"shape\", {}", k, ratio ? "a ratio" : "a turn in degrees")});
    }
    return net;
  }
  notes.push_back(
      {"positive_weights", 0,
       proved
           ? fmt::format(
                 "weights of both signs: no shape has positive ones, proved for ratios from 1/{0:g} to {0:g}",
                 widest_ratio)
           : "weights of both signs: no shape of positive ones was found, nor proved not to exist"});
  return std::nullopt;
}

}  // namespace

std::vector<HolonomyRoot> roots_of(const Complex& holonomy) {
  const bool either = std::abs(holonomy + 1.0L) <= closes;
  return either ? std::vector<HolonomyRoot>{HolonomyRoot::least, HolonomyRoot::other}
                : std::vector<HolonomyRoot>{HolonomyRoot::least};
}

double angle_excess(const Complex& holonomy) {
  const long double argument = std::arg(holonomy) * 2 * degrees_per_radian;
  return static_cast<double>(std::abs(holonomy + 1.0L) <= closes ? std::abs(argument) : argument);
}

bool all_straight(const std::vector<SphereArc>& arcs) {
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const lvec3 in = arcs[k].end_tangent(), out = arcs[(k + 1) % arcs.size()].start_tangent();
    // Corners are good to ten digits, tangents to the share that arcs have of the circle.
    if (glm::length(in - out) > 1e-6L) return false;
  }
  return true;
}

std::optional<GivenShape> read_shape(Params& params, std::size_t ratios, std::size_t turns) {
  const Value* value = params.raw("shape");
  if (!value) return std::nullopt;
  const std::size_t most = ratios + turns;
  std::vector<Value> items = value->items;
  if (value->kind == Value::Kind::number) items = {*value};
  const std::string form = fmt::format("a positive number{}, ratios from {:g} to {:g}{}",
                                       most > 1 ? fmt::format(", or an array of {}", most) : "",
                                       1 / most_extreme_ratio, most_extreme_ratio,
                                       turns == 0   ? ""
                                       : turns == 1 ? " and then a turn in degrees"
                                                    : " and then two turns in degrees");
  if (items.size() != 1 && items.size() != most)
    params.fail(*value, fmt::format("\"shape\" must be {}", form));
  GivenShape given{items.size(), {}};
  for (std::size_t k = 0; k < items.size(); ++k) {
    const double number = items[k].number;
    const bool ratio = k < ratios;
    if (items[k].kind != Value::Kind::number || !std::isfinite(number) ||
        (ratio ? !(number >= 1 / most_extreme_ratio && number <= most_extreme_ratio)
               : !(std::abs(number) < 360)))
      params.fail(items[k], fmt::format("\"shape\" must be {}", form));
    if (ratio)
      given.shape.ratio[k] = number;
    else
      given.shape.turn[k - ratios] = number / degrees_per_radian;
  }
  return given;
}

ParameterDoc shape_doc(const std::string& meaning, std::size_t count) {
  return {
      "shape", fmt::format("number > 0, or array of {} numbers", count), "as found",
      meaning +
          ". These move parameters, not the surface. Without it all ratios are 1 and turns 0 if weights are "
          "positive then, and are sought if not; rondure info tells what was found"};
}

Surface best_image(const Params& params, const std::vector<PreimageFamily>& families,
                   const std::optional<GivenShape>& given) {
  Surface surface;
  std::vector<Preimage> first;
  std::vector<const PreimageFamily*> regular;
  for (const PreimageFamily& family : families) {
    const Shape shape = given ? given->shape : Shape{};
    if (!within_half_turns(family, shape)) continue;
    first.push_back(preimage_at(family, shape));
    if (!regularity(first.back()).regular) continue;
    regular.push_back(&family);
    Net net = sphere_image(first.back());
    const bool positive = weights_positive(net);
    if (surface.patches.empty() || positive) surface.patches = {std::move(net)};
    if (positive) return surface;
  }
  if (first.empty())
    params.fail("shape",
                "these turns take the phase of a side past 180 degrees, where the patch has a base point");
  if (!given) {
    if (regular.empty() && !folds_at_corner(first.front())) {
      for (const PreimageFamily& family : families) regular.push_back(&family);
    }
    if (auto found = sought(regular, surface.notes)) surface.patches = {std::move(*found)};
  }
  if (!surface.patches.empty()) return surface;
  const PreimageRegularity why = regularity(first.front());
  if (why.flat) params.fail("corners", "these arcs enclose no area: they run along each other");
  if (regularity(mirrored(first.front())).regular)
    params.fail(
        "corners",
        "the corners must run counter-clockwise, seen from outside, around the region on the left of the "
        "arcs; these run clockwise around the region that has a patch");
  params.fail("corners",
              fmt::format("the patch between these arcs folds, near (u, v) = ({:.4g}, {:.4g}): "
                          "interior angles should be less than 180 degrees and arcs must not cross",
                          why.worst.x, why.worst.y));
}

}  // namespace rondure
