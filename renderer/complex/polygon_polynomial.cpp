#include "renderer/complex/polygon_polynomial.h"

#include <algorithm>
#include <utility>

#include "renderer/api/patch.h"
#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// The factor of a basis polynomial: n! / (i! j! k!), or C(n, i) C(n, j).
Integer factor_of(int sides, int n, const std::array<int, 3>& e) {
  return sides == 3 ? Integer(exact_binomial(n, e[0]) * exact_binomial(n - e[0], e[1]))
                    : Integer(exact_binomial(n, e[0]) * exact_binomial(n, e[1]));
}

int place_of(int sides, int n, int i, int j) {
  return sides == 3 ? triangle_index(n, i, j) : i * (n + 1) + j;
}

}  // namespace

std::array<int, 3> exponents_of(int sides, int n, int coefficient) {
  if (sides == 4) return {coefficient / (n + 1), coefficient % (n + 1), 0};
  int i = 0;
  while (i < n && triangle_index(n, i + 1, 0) <= coefficient) ++i;
  const int j = coefficient - triangle_index(n, i, 0);
  return {i, j, n - i - j};
}

int steps_from_boundary(int sides, int n, int coefficient) {
  const auto e = exponents_of(sides, n, coefficient);
  if (sides == 3) return std::min({e[0], e[1], e[2]});
  return std::min({e[0], n - e[0], e[1], n - e[1]});
}

PolygonPolynomial constant_polynomial(int sides, const Exact& value) { return {sides, 0, {value}}; }

PolygonPolynomial operator*(const PolygonPolynomial& a, const PolygonPolynomial& b) {
  const int n = a.degree + b.degree;
  PolygonPolynomial out{a.sides, n, std::vector<Exact>(index(coefficient_count(a.sides, n)))};
  for (int p = 0; p < static_cast<int>(a.coefficients.size()); ++p) {
    if (a.coefficients[index(p)] == 0) continue;
    const auto ea = exponents_of(a.sides, a.degree, p);
    const Exact ca = a.coefficients[index(p)] * factor_of(a.sides, a.degree, ea);
    for (int q = 0; q < static_cast<int>(b.coefficients.size()); ++q) {
      if (b.coefficients[index(q)] == 0) continue;
      const auto eb = exponents_of(b.sides, b.degree, q);
      const Exact cb = b.coefficients[index(q)] * factor_of(b.sides, b.degree, eb);
      out.coefficients[index(place_of(a.sides, n, ea[0] + eb[0], ea[1] + eb[1]))] += ca * cb;
    }
  }
  for (int k = 0; k < static_cast<int>(out.coefficients.size()); ++k) {
    Exact& c = out.coefficients[index(k)];
    if (c != 0) c /= factor_of(out.sides, n, exponents_of(out.sides, n, k));
  }
  return out;
}

// The constant 1 of that degree has all coefficients 1.
PolygonPolynomial elevated(const PolygonPolynomial& p, int degree) {
  if (degree == p.degree) return p;
  const int by = degree - p.degree;
  const PolygonPolynomial one{p.sides, by,
                              std::vector<Exact>(index(coefficient_count(p.sides, by)), Exact(1))};
  return p * one;
}

PolygonPolynomial add(const PolygonPolynomial& a, const PolygonPolynomial& b, const Exact& factor) {
  const int n = std::max(a.degree, b.degree);
  PolygonPolynomial out = elevated(a, n);
  const PolygonPolynomial other = elevated(b, n);
  for (std::size_t k = 0; k < out.coefficients.size(); ++k) {
    if (other.coefficients[k] != 0) out.coefficients[k] += factor * other.coefficients[k];
  }
  return out;
}

namespace {

// Triangle: at the point with coordinates 1 - s - e, s, e from the edge's first corner on.
std::vector<EdgeTrace> triangle_traces(int n, int edge) {
  std::vector<EdgeTrace> traces;
  for (int k = 0; k < triangle_size(n); ++k) {
    const auto e = exponents_of(3, n, k);
    const int first = e[index(edge)], second = e[index((edge + 1) % 3)], third = e[index((edge + 2) % 3)];
    if (third > 1) continue;
    EdgeTrace trace{k, {}, {}};
    if (third == 0) {
      trace.value = bernstein_polynomial(n, second);
      if (first > 0) trace.inward = bernstein_polynomial(n - 1, second) * EdgePolynomial(-n);
    } else {
      trace.inward = bernstein_polynomial(first + second, second) * EdgePolynomial(n);
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

std::vector<EdgeTrace> square_traces(int n, int edge) {
  std::vector<EdgeTrace> traces;
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const auto [i, j, none] = exponents_of(4, n, k);
    // Along the edge, and away from it.
    const std::pair<int, int> places[4] = {{i, j}, {j, n - i}, {n - i, n - j}, {n - j, i}};
    const auto [along, away] = places[edge];
    if (away > 1) continue;
    EdgeTrace trace{k, {}, {}};
    if (away == 0) trace.value = bernstein_polynomial(n, along);
    if (n > 0) trace.inward = bernstein_polynomial(n, along) * EdgePolynomial(away == 0 ? -n : n);
    traces.push_back(std::move(trace));
  }
  return traces;
}

}  // namespace

std::vector<EdgeTrace> edge_traces(int sides, int n, int edge) {
  return sides == 3 ? triangle_traces(n, edge) : square_traces(n, edge);
}

EdgeTrace edge_trace(const PolygonPolynomial& p, int edge) {
  EdgeTrace sum{0, {}, {}};
  for (const EdgeTrace& trace : edge_traces(p.sides, p.degree, edge)) {
    const EdgePolynomial c = p.coefficients[index(trace.coefficient)];
    sum.value = sum.value + c * trace.value;
    sum.inward = sum.inward + c * trace.inward;
  }
  return sum;
}

}  // namespace rondure
