// Bezier clipping's own step: to which range of a parameter the convex hull of a control polygon confines the
// roots. Source: Nishita, Sederberg, Kakimoto 1990, section 4.
#pragma once

#include <algorithm>
#include <glm/mat2x2.hpp>

#include "renderer/intersect/cell.h"

namespace rondure {

// Range of the parameter k (0: a, 1: b) over which the hull of component k of inverse . f meets [-band,
// band]. With the inverse of the Jacobian that component is nearly the parameter itself, less the root's.
// False: nowhere.
inline bool clip_parameter(const TensorShape& shape, const dvec2* f, const glm::dmat2& inverse, int k,
                           double band, double& from, double& to) {
  const int m = shape.m, n = shape.n, degree = k == 0 ? m : n;
  double low[max_degree + 1], high[max_degree + 1];
  for (int i = 0; i <= degree; ++i) low[i] = 1e300, high[i] = -1e300;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) {
      const double g = (inverse * f[i * (n + 1) + j])[k];
      const int at = k == 0 ? i : j;
      low[at] = std::min(low[at], g), high[at] = std::max(high[at], g);
    }
  from = 1.0, to = 0.0;
  const auto include = [&](double x) { from = std::min(from, x), to = std::max(to, x); };
  // Where the segments between any two of the points cross an edge of the band: the hull's own crossings are
  // among them.
  for (int i = 0; i <= degree; ++i) {
    if (low[i] <= band && high[i] >= -band) include(static_cast<double>(i) / degree);
    for (int j = i + 1; j <= degree; ++j)
      for (const double level : {-band, band})
        for (const double p : {low[i], high[i]})
          for (const double q : {low[j], high[j]})
            if ((p - level) * (q - level) < 0.0) include((i + (j - i) * (level - p) / (q - p)) / degree);
  }
  return from <= to;
}

}  // namespace rondure
