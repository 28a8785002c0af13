#include "renderer/bezier/edge_factor.h"

namespace rondure {
namespace {

bool row_is_zero(const TensorNormal& p, int i) {
  for (int j = 0; j <= p.n; ++j) {
    if (p.at(i, j) != dvec3(0.0)) return false;
  }
  return true;
}

template <class T>
TensorPolynomial<T> transposed(const TensorPolynomial<T>& p) {
  TensorPolynomial<T> out(p.n, p.m);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) out.at(j, i) = p.at(i, j);
  }
  return out;
}

// Division by 1 - u (the last row is zero) or u (the first is).
bool divide_by_u_edge(TensorNormal& p, TensorPolynomial<double>& factor) {
  if (p.m == 0) return false;
  const bool last = row_is_zero(p, p.m);
  if (!last && !row_is_zero(p, 0)) return false;
  TensorNormal q(p.m - 1, p.n);
  for (int i = 0; i < p.m; ++i) {
    const double scale = static_cast<double>(p.m) / (last ? p.m - i : i + 1);
    for (int j = 0; j <= p.n; ++j) q.at(i, j) = scale * p.at(last ? i : i + 1, j);
  }
  TensorPolynomial<double> edge(1, 0);
  edge.at(last ? 0 : 1, 0) = 1.0;
  factor = multiply(factor, edge);
  p = std::move(q);
  return true;
}

// Division by the barycentric coordinate c: 0, 1, 2 for u, v, w.
bool divide_by_coordinate(int c, TriangleNormal& p, TrianglePolynomial<double>& factor) {
  if (p.n == 0) return false;
  for (int i = 0; i <= p.n; ++i) {
    for (int j = 0; j <= p.n - i; ++j) {
      const int power[3] = {i, j, p.n - i - j};
      if (power[c] == 0 && p.at(i, j) != dvec3(0.0)) return false;
    }
  }
  TriangleNormal q(p.n - 1);
  for (int i = 0; i < p.n; ++i) {
    for (int j = 0; j < p.n - i; ++j) {
      const int power[3] = {i, j, p.n - 1 - i - j};
      const double scale = static_cast<double>(p.n) / (power[c] + 1);
      q.at(i, j) = scale * p.at(i + (c == 0 ? 1 : 0), j + (c == 1 ? 1 : 0));
    }
  }
  TrianglePolynomial<double> edge(1);
  edge.at(c == 0 ? 1 : 0, c == 1 ? 1 : 0) = 1.0;
  factor = multiply(factor, edge);
  p = std::move(q);
  return true;
}

}  // namespace

TensorNormal without_edges(TensorNormal p, TensorPolynomial<double>& factor) {
  while (divide_by_u_edge(p, factor)) {
  }
  p = transposed(p);
  factor = transposed(factor);
  while (divide_by_u_edge(p, factor)) {
  }
  factor = transposed(factor);
  return transposed(p);
}

TriangleNormal without_edges(TriangleNormal p, TrianglePolynomial<double>& factor) {
  for (int c = 0; c < 3; ++c) {
    while (divide_by_coordinate(c, p, factor)) {
    }
  }
  return p;
}

}  // namespace rondure
