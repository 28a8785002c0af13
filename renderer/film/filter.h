// Pixel filters, applied by drawing sample positions in proportion to them: no sample ever reaches a
// neighbour's pixel, and crops need no margin.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

enum class FilterKind { box, tent, gaussian, blackman_harris };

// Separable, symmetric, non-negative, zero beyond `radius` (in pixels) on each axis.
class Filter {
 public:
  // A radius of 0 means the kind's own: box 0.5, tent 1, gaussian 1.5 (standard deviation radius / 3),
  // blackman_harris 2.
  explicit Filter(FilterKind kind = FilterKind::blackman_harris, double radius = 0.0);

  // Offset from the pixel's centre, in pixels.
  dvec2 sample(dvec2 uv) const;
  // Distribution function of one axis, exact; `sample` inverts a table of it, linear between 1024 knots a
  // side.
  double cumulative(double x) const;

  FilterKind kind() const { return kind_; }
  double radius() const { return radius_; }
  const char* name() const;

 private:
  FilterKind kind_;
  double radius_;
  std::vector<double> cumulative_;  // of gaussian and blackman_harris over [0, radius], uniform knots

  double sample_axis(double u) const;
};

}  // namespace rondure
