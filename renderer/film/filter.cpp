#include "renderer/film/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rondure {
namespace {

using std::numbers::pi;

constexpr int knots = 1024;

double default_radius(FilterKind kind) {
  switch (kind) {
    case FilterKind::box:
      return 0.5;
    case FilterKind::tent:
      return 1.0;
    case FilterKind::gaussian:
      return 1.5;
    case FilterKind::blackman_harris:
      return 2.0;
  }
  return 1.0;
}

// Integral from 0 to x of the filter, unnormalised, x in [0, radius].
double primitive(FilterKind kind, double radius, double x) {
  switch (kind) {
    case FilterKind::box:
      return x;
    case FilterKind::tent:
      return x - x * x / (2.0 * radius);
    case FilterKind::gaussian:
      return std::erf(3.0 * x / (radius * std::numbers::sqrt2));
    case FilterKind::blackman_harris: {
      // Four cosine terms (Harris 1978, table 1, "minimum 4-sample Blackman-Harris"), centred.
      const double a = pi * x / radius;
      return 0.35875 * a + 0.48829 * std::sin(a) + 0.14128 / 2.0 * std::sin(2.0 * a) +
             0.01168 / 3.0 * std::sin(3.0 * a);
    }
  }
  return x;
}

}  // namespace

Filter::Filter(FilterKind kind, double radius)
    : kind_(kind), radius_(radius > 0.0 ? radius : default_radius(kind)) {
  if (kind == FilterKind::box || kind == FilterKind::tent) return;
  const double whole = primitive(kind, radius_, radius_);
  cumulative_.resize(knots + 1);
  for (int i = 0; i <= knots; ++i) {
    cumulative_[static_cast<std::size_t>(i)] = primitive(kind, radius_, radius_ * i / knots) / whole;
  }
}

double Filter::cumulative(double x) const {
  const double half =
      0.5 * primitive(kind_, radius_, std::min(std::abs(x), radius_)) / primitive(kind_, radius_, radius_);
  return x < 0.0 ? 0.5 - half : 0.5 + half;
}

double Filter::sample_axis(double u) const {
  const double sign = u < 0.5 ? -1.0 : 1.0;
  const double v = std::abs(2.0 * u - 1.0);  // uniform in [0, 1), to be inverted on one side
  if (kind_ == FilterKind::box) return sign * radius_ * v;
  if (kind_ == FilterKind::tent)
    return sign * radius_ * v / (1.0 + std::sqrt(1.0 - v));  // r (1 - sqrt(1 - v))
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, v);
  const double high = *above, low = *(above - 1);
  const double inside = high > low ? std::min(1.0, (v - low) / (high - low)) : 0.5;
  return sign * radius_ * (static_cast<double>(above - 1 - cumulative_.begin()) + inside) / knots;
}

dvec2 Filter::sample(dvec2 uv) const { return {sample_axis(uv.x), sample_axis(uv.y)}; }

const char* Filter::name() const {
  switch (kind_) {
    case FilterKind::box:
      return "box";
    case FilterKind::tent:
      return "tent";
    case FilterKind::gaussian:
      return "gaussian";
    case FilterKind::blackman_harris:
      return "blackman_harris";
  }
  return "";
}

}  // namespace rondure
