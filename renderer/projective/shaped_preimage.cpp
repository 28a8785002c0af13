#include "renderer/projective/shaped_preimage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rondure {
namespace {

lvec4 point_at(const ShapedPoint& point, const Shape& shape) {
  Spinor sum{0, 0};
  for (const ShapedTerm& term : point.terms) {
    long double size = 1, angle = 0;
    for (std::size_t k = 0; k < most_ratios; ++k)
      size *= std::pow(shape.ratio[k], static_cast<long double>(term.power[k]));
    for (std::size_t k = 0; k < most_turns; ++k) angle += term.turns[k] * shape.turn[k];
    sum = sum + std::polar(size, angle) * term.coefficient;
  }
  return to_point(sum);
}

}  // namespace

Preimage preimage_at(const PreimageFamily& family, const Shape& shape) {
  if (const auto* net = std::get_if<TensorPolynomial<ShapedPoint>>(&family.net)) {
    TensorPreimage out(net->m, net->n);
    for (std::size_t k = 0; k < out.coefficients.size(); ++k)
      out.coefficients[k] = point_at(net->coefficients[k], shape);
    return out;
  }
  const auto& net = std::get<TrianglePolynomial<ShapedPoint>>(family.net);
  TrianglePreimage out(net.n);
  for (std::size_t k = 0; k < out.coefficients.size(); ++k)
    out.coefficients[k] = point_at(net.coefficients[k], shape);
  return out;
}

bool within_half_turns(const PreimageFamily& family, const Shape& shape) {
  return std::all_of(family.sides.begin(), family.sides.end(), [&](const SidePhase& side) {
    long double phase = side.even;
    for (std::size_t k = 0; k < most_turns; ++k) phase += side.turns[k] * shape.turn[k];
    return std::abs(phase) < std::numbers::pi_v<long double>;
  });
}

}  // namespace rondure
