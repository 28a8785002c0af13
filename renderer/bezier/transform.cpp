#include "renderer/bezier/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace rondure {
// Columns and rows are brought near 1 by powers of two first, so that no scale, uniform or not, makes the
// determinant underflow or overflow.
bool mirrors(const dmat4& matrix) {
  dmat4 m = matrix;
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < 4; ++k) {
      const double size =
          std::max({std::fabs(m[k].x), std::fabs(m[k].y), std::fabs(m[k].z), std::fabs(m[k].w)});
      if (!(size > 0.0) || !std::isfinite(size)) return false;
      for (int i = 0; i < 4; ++i) m[k][i] = std::ldexp(m[k][i], -std::ilogb(size));
    }
    m = glm::transpose(m);
  }
  return glm::determinant(m) < 0.0;
}

Net reversed(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) {
    TensorNet out(t->m, t->n);
    for (int i = 0; i <= t->m; ++i) {
      for (int j = 0; j <= t->n; ++j) out.at(i, j) = t->at(t->m - i, j);
    }
    return out;
  }
  const auto& t = std::get<TriangleNet>(net);
  TriangleNet out(t.n);
  for (int i = 0; i <= t.n; ++i) {
    for (int j = 0; j <= t.n - i; ++j) out.at(i, j) = t.at(j, i);
  }
  return out;
}

Net transformed(const Net& net, const dmat4& matrix) {
  Net out = mirrors(matrix) ? reversed(net) : net;
  for (dvec4& p : points_of(out)) p = matrix * p;
  return out;
}

}  // namespace rondure
