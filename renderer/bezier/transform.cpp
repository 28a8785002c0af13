#include "renderer/bezier/transform.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace rondure {

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
  Net out = glm::determinant(matrix) < 0.0 ? reversed(net) : net;
  for (dvec4& p : points_of(out)) p = matrix * p;
  return out;
}

}  // namespace rondure
