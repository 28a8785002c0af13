#include "renderer/bezier/common_factor.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "renderer/bezier/edge_factor.h"
#include "renderer/bezier/least_squares.h"

namespace rondure {
namespace {

constexpr double accepted_residual = 0x1p-40;
// Of a singular value that stands for zero, relative to the largest column.
constexpr double zero_singular_value = 1e-11;
// Multiplications of one least-squares problem, some seconds.
constexpr double most_work = 2e9;

template <class Polynomial>
double largest(const Polynomial& p) {
  double size = 0.0;
  for (const dvec3& c : p.coefficients) {
    size = std::max({size, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  }
  return size;
}

// The Bernstein basis at a point, by the recurrence in the degree.
std::vector<double> basis(int n, double t) {
  std::vector<double> b(static_cast<std::size_t>(n) + 1, 0.0);
  b[0] = 1.0;
  for (int d = 1; d <= n; ++d) {
    for (int k = d; k >= 0; --k) {
      const auto at = static_cast<std::size_t>(k);
      b[at] = (k < d ? (1.0 - t) * b[at] : 0.0) + (k > 0 ? t * b[at - 1] : 0.0);
    }
  }
  return b;
}

std::vector<double> basis(const TensorNormal& p, dvec2 at) {
  std::vector<double> out;
  const std::vector<double> in_v = basis(p.n, at.y);
  for (const double a : basis(p.m, at.x)) {
    for (const double b : in_v) out.push_back(a * b);
  }
  return out;
}

// With v / (1 - u) as the second parameter; `at` is inside the triangle.
std::vector<double> basis(const TriangleNormal& p, dvec2 at) {
  std::vector<double> out;
  const std::vector<double> in_u = basis(p.n, at.x);
  for (int i = 0; i <= p.n; ++i) {
    for (const double b : basis(p.n - i, at.y / (1.0 - at.x))) {
      out.push_back(in_u[static_cast<std::size_t>(i)] * b);
    }
  }
  return out;
}

struct Samples {
  std::vector<dvec2> at;
  std::vector<dvec3> normal;  // relative to the largest
};

template <class Polynomial>
void take(Samples& samples, const Polynomial& p, dvec2 at) {
  const std::vector<double> b = basis(p, at);
  dvec3 sum(0.0);
  for (std::size_t k = 0; k < b.size(); ++k) sum += b[k] * p.coefficients[k];
  samples.at.push_back(at);
  samples.normal.push_back(sum);
}

double chebyshev(int k, int count) { return 0.5 - 0.5 * std::cos((k + 0.5) * std::numbers::pi / count); }

// Enough points that a polynomial of the degree (a, b), or a + b, that vanishes at all of them is zero.
Samples grid(const TensorNormal& p, int a, int b) {
  Samples samples;
  for (int i = 0; i <= a; ++i) {
    for (int j = 0; j <= b; ++j) take(samples, p, {chebyshev(i, a + 1), chebyshev(j, b + 1)});
  }
  return samples;
}

Samples grid(const TriangleNormal& p, int degree) {
  Samples samples;
  for (int i = 0; i <= degree; ++i) {
    const double u = chebyshev(i, degree + 1);
    for (int j = 0; j <= degree; ++j) take(samples, p, {u, (1.0 - u) * chebyshev(j, degree + 1)});
  }
  return samples;
}

// The rows of normal x Q = 0 for the coefficients of Q, three a basis function.
NullDirection parallel_to(const Samples& samples, const std::vector<std::vector<double>>& bases) {
  const std::size_t size = bases[0].size();
  Matrix a(3 * samples.at.size(), 3 * size);
  for (std::size_t s = 0; s < samples.at.size(); ++s) {
    const dvec3& n = samples.normal[s];
    for (std::size_t k = 0; k < size; ++k) {
      const double b = bases[s][k];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
        a.at(3 * s + c, 3 * k + e) = n[static_cast<int>(d)] * b;
        a.at(3 * s + c, 3 * k + d) = -n[static_cast<int>(e)] * b;
      }
    }
  }
  return null_direction(std::move(a));
}

// The least degree of a polynomial vector parallel to the normal along a line of the domain, on which the
// normal has the degree given; point(t) runs along it. A line in general position meets no common root.
template <class Polynomial, class Point>
int least_degree(const Polynomial& p, int degree, Point point) {
  Samples samples;
  const int count = 2 * degree + 1;
  for (int k = 0; k < count; ++k) take(samples, p, point(chebyshev(k, count)));
  const auto exists = [&](int d) {
    std::vector<std::vector<double>> bases;
    for (int k = 0; k < count; ++k) bases.push_back(basis(d, chebyshev(k, count)));
    return parallel_to(samples, bases).size < zero_singular_value;
  };
  int low = 0, high = degree;  // at `high` there is one: the normal itself
  while (low < high) {
    const int middle = (low + high) / 2;
    if (exists(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return high;
}

struct Degrees {
  TensorNormal direction;
  TensorPolynomial<double> factor;
};

std::optional<Degrees> reduced_degrees(const TensorNormal& p) {
  // Irrational, so that no symmetry line of a family is met.
  constexpr double here = 0.38196601125010515, there = 0.61312031463187;
  const int m = least_degree(p, p.m, [](double t) { return dvec2(t, here); });
  const int n = least_degree(p, p.n, [](double t) { return dvec2(there, t); });
  if (m == p.m && n == p.n) return std::nullopt;
  return Degrees{TensorNormal(m, n), TensorPolynomial<double>(p.m - m, p.n - n)};
}

struct TriangleDegrees {
  TriangleNormal direction;
  TrianglePolynomial<double> factor;
};

std::optional<TriangleDegrees> reduced_degrees(const TriangleNormal& p) {
  const dvec2 from(0.0, 0.38196601125010515), step(0.61312031463187, -0.2113248654);
  const int n = least_degree(p, p.n, [&](double t) { return from + t * step; });
  if (n == p.n) return std::nullopt;
  return TriangleDegrees{TriangleNormal(n), TrianglePolynomial<double>(p.n - n)};
}

double sample_count(const TensorNormal& p, const TensorNormal& q) {
  return static_cast<double>(p.m + q.m + 1) * (p.n + q.n + 1);
}
double sample_count(const TriangleNormal& p, const TriangleNormal& q) {
  return static_cast<double>(p.n + q.n + 1) * (p.n + q.n + 1);
}

// Whether the least-squares problems for this direction and factor stay within most_work.
template <class Normal, class Factor>
bool affordable(const Normal& p, const Normal& direction, const Factor& factor) {
  const double unknowns =
      static_cast<double>(std::max(3 * direction.coefficients.size(), factor.coefficients.size()));
  return 3.0 * sample_count(p, direction) * unknowns * unknowns <= most_work;
}

Samples enough(const TensorNormal& p, const TensorNormal& q) { return grid(p, p.m + q.m, p.n + q.n); }
Samples enough(const TriangleNormal& p, const TriangleNormal& q) { return grid(p, p.n + q.n); }

TensorNormal shaped(const TensorPolynomial<double>& p) { return TensorNormal(p.m, p.n); }
TriangleNormal shaped(const TrianglePolynomial<double>& p) { return TriangleNormal(p.n); }

// normal = factor * direction for the factor, then for the direction: what rounding left of the one is spread
// over both.
template <class Normal, class Factor>
void fit(const Samples& samples, Normal& direction, Factor& factor) {
  const std::size_t count = samples.at.size();
  const Normal factor_shape = shaped(factor);
  Matrix a(3 * count, factor.coefficients.size());
  std::vector<std::vector<double>> right(1, std::vector<double>(3 * count));
  for (std::size_t s = 0; s < count; ++s) {
    const std::vector<double> b = basis(direction, samples.at[s]), f = basis(factor_shape, samples.at[s]);
    dvec3 q(0.0);
    for (std::size_t k = 0; k < b.size(); ++k) q += b[k] * direction.coefficients[k];
    for (std::size_t c = 0; c < 3; ++c) {
      right[0][3 * s + c] = samples.normal[s][static_cast<int>(c)];
      for (std::size_t k = 0; k < f.size(); ++k) a.at(3 * s + c, k) = f[k] * q[static_cast<int>(c)];
    }
  }
  factor.coefficients = least_squares(std::move(a), std::move(right))[0];
  Matrix d(count, direction.coefficients.size());
  std::vector<std::vector<double>> sides(3, std::vector<double>(count));
  for (std::size_t s = 0; s < count; ++s) {
    const std::vector<double> b = basis(direction, samples.at[s]), f = basis(factor_shape, samples.at[s]);
    double j = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k) j += f[k] * factor.coefficients[k];
    for (std::size_t k = 0; k < b.size(); ++k) d.at(s, k) = j * b[k];
    for (std::size_t c = 0; c < 3; ++c) sides[c][s] = samples.normal[s][static_cast<int>(c)];
  }
  const auto x = least_squares(std::move(d), std::move(sides));
  for (std::size_t k = 0; k < direction.coefficients.size(); ++k) {
    direction.coefficients[k] = dvec3(x[0][k], x[1][k], x[2][k]);
  }
}

template <class Normal, class Factor>
double residual_of(const Normal& normal, const Factor& factor, const Normal& direction) {
  const auto product = multiply(factor, direction);
  return largest(add_scaled(product, normal, -1.0)) / largest(normal);
}

template <class Normal, class Factor>
void normalise(Normal& direction, Factor& factor) {
  double scale = largest(direction), sum = 0.0;
  for (const double c : factor.coefficients) sum += c;
  if (sum < 0.0) scale = -scale;
  for (dvec3& c : direction.coefficients) c /= scale;
  for (double& c : factor.coefficients) c *= scale;
}

template <class Normal>
ReducedNormal reduce(const Normal& normal) {
  using Factor = decltype(multiply(normal, normal, [](const dvec3& a, const dvec3&) { return a.x; }));
  Factor factor;
  factor.coefficients[0] = 1.0;
  const double size = largest(normal);
  if (!(size > 0.0) || !std::isfinite(size)) return {normal, factor, 0.0};
  Normal direction = without_edges(normal, factor);
  Normal unit = direction;
  const double unit_size = largest(direction);
  for (dvec3& c : unit.coefficients) c /= unit_size;
  auto found = reduced_degrees(unit);
  if (found && affordable(unit, found->direction, found->factor)) {
    const Samples samples = enough(unit, found->direction);
    std::vector<std::vector<double>> bases;
    for (const dvec2& at : samples.at) bases.push_back(basis(found->direction, at));
    const NullDirection null = parallel_to(samples, bases);
    Normal& q = found->direction;
    for (std::size_t k = 0; k < q.coefficients.size(); ++k) {
      q.coefficients[k] = dvec3(null.x[3 * k], null.x[3 * k + 1], null.x[3 * k + 2]);
    }
    fit(samples, q, found->factor);
    for (double& c : found->factor.coefficients) c *= unit_size;
    Factor whole = multiply(factor, found->factor);
    if (residual_of(normal, whole, q) <= accepted_residual) {
      direction = q;
      factor = whole;
    }
  }
  normalise(direction, factor);
  return {direction, factor, residual_of(normal, factor, direction)};
}

}  // namespace

ReducedNormal reduced_normal(const NormalPolynomial& normal) {
  return std::visit([](const auto& n) { return reduce(n); }, normal);
}

}  // namespace rondure
