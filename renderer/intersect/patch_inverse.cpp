#include "renderer/intersect/patch_inverse.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "renderer/bezier/rational.h"
#include "renderer/projective/preimage.h"
#include "renderer/projective/spinor.h"

namespace rondure {
namespace {

constexpr int largest_degree = 4;
constexpr int width = largest_degree + 1;

// A polynomial in (s, t) = (u, v) - middle: coefficient of s^i t^j at [i][j].
using Powers = std::array<std::array<long double, width>, width>;

Powers times(const Powers& p, long double c, long double s, long double t) {
  Powers out{};
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) {
      out[i][j] += c * p[i][j];
      if (i > 0) out[i][j] += s * p[i - 1][j];
      if (j > 0) out[i][j] += t * p[i][j - 1];
    }
  return out;
}

// Product of powers of linear factors c + s du + t dv, and a number.
struct Factor {
  long double c, s, t;
  int power;
};
Powers product_of(long double number, std::initializer_list<Factor> factors) {
  Powers p{};
  p[0][0] = number;
  for (const Factor& f : factors)
    for (int k = 0; k < f.power; ++k) p = times(p, f.c, f.s, f.t);
  return p;
}

// Adds the complex coefficient times a Bernstein polynomial to component `part` (0: a, 1: b).
void add_powers(const Powers& basis, Complex coefficient, int part, int degree, PatchInverse& out) {
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j) {
      double* at = &out.coefficients[static_cast<std::size_t>(4 * (i * (degree + 1) + j) + 2 * part)];
      at[0] += static_cast<double>(coefficient.real() * basis[i][j]);
      at[1] += static_cast<double>(coefficient.imag() * basis[i][j]);
    }
}

struct Quotient {
  Complex a, b;
};

template <class Quotients>
PatchInverse in_powers(const TensorPolynomial<lvec4>& p, dvec2 middle, int degree,
                       const Quotients& quotient) {
  PatchInverse out;
  out.degree = degree, out.middle = middle;
  const long double u = middle.x, v = middle.y;
  for (int i = 0; i <= p.m; ++i)
    for (int j = 0; j <= p.n; ++j) {
      const Powers basis =
          product_of(binomial(p.m, i) * binomial(p.n, j),
                     {{u, 1, 0, i}, {1 - u, -1, 0, p.m - i}, {v, 0, 1, j}, {1 - v, 0, -1, p.n - j}});
      const Quotient q = quotient(p.at(i, j));
      add_powers(basis, q.a, 0, degree, out);
      add_powers(basis, q.b, 1, degree, out);
    }
  return out;
}

template <class Quotients>
PatchInverse in_powers(const TrianglePolynomial<lvec4>& p, dvec2 middle, int degree,
                       const Quotients& quotient) {
  PatchInverse out;
  out.degree = degree, out.middle = middle;
  const long double u = middle.x, v = middle.y;
  for (int i = 0; i <= p.n; ++i)
    for (int j = 0; j <= p.n - i; ++j) {
      const Powers basis =
          product_of(trinomial(p.n, i, j), {{u, 1, 0, i}, {v, 0, 1, j}, {1 - u - v, -1, -1, p.n - i - j}});
      const Quotient q = quotient(p.at(i, j));
      add_powers(basis, q.a, 0, degree, out);
      add_powers(basis, q.b, 1, degree, out);
    }
  return out;
}

// Whether a / b is the projection of the net's own points, to so many roundoffs as rounding makes of 1.
bool fits(const PatchInverse& inverse, const Net& net, double rounding) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  constexpr int steps = 6;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= (triangle ? steps - i : steps); ++j) {
      const double u = double(i) / steps, v = double(j) / steps;
      const dvec3 n = net_point(net, u, v);
      Complex a = 0, b = 0;
      const int k = inverse.degree;
      for (int p = k; p >= 0; --p) {
        Complex row_a = 0, row_b = 0;
        for (int q = k; q >= 0; --q) {
          const double* c = &inverse.coefficients[static_cast<std::size_t>(4 * (p * (k + 1) + q))];
          row_a = row_a * Complex(v - inverse.middle.y) + Complex(c[0], c[1]);
          row_b = row_b * Complex(v - inverse.middle.y) + Complex(c[2], c[3]);
        }
        a = a * Complex(u - inverse.middle.x) + row_a;
        b = b * Complex(u - inverse.middle.x) + row_b;
      }
      const Complex defect = Complex(1.0L - n.z) * a - Complex(n.x, n.y) * b;
      if (!(std::abs(defect) <= 16.0L * rounding * unit_roundoff * (std::abs(a) + std::abs(b)))) return false;
    }
  return true;
}

void spread_out(PatchInverse& inverse) {
  const auto size = static_cast<std::size_t>(inverse.degree + 1), lanes = inverse.spread_lanes();
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) {
      const double* c = &inverse.coefficients[4 * (i * size + j)];
      const double factors[3][2] = {{c[0], c[1]}, {c[2], c[3]}, {c[3], -c[2]}};
      for (std::size_t which = 0; which < 3; ++which)
        for (std::size_t part = 0; part < 2; ++part)
          inverse.spread[(which * size + j) * lanes + 2 * i + part] = factors[which][part];
    }
}

// Brings the coefficients to size 1, and tells what is usual in the patch: the inverse derivatives in its
// middle. False when the coefficients are zero or no numbers, or the middle is singular.
bool normalise(PatchInverse& inverse) {
  double most = 0.0, sum = 0.0;
  for (const double c : inverse.coefficients) most = std::max(most, std::fabs(c)), sum += std::fabs(c);
  if (!(most > 0.0) || !std::isfinite(sum)) return false;
  const double scale = std::exp2(-std::ilogb(most));
  for (double& c : inverse.coefficients) c *= scale;
  // Of 2 a at the point (0, 0, -1), which is the middle's to rounding or near.
  const auto at = [&](int i, int j) {
    const double* c = &inverse.coefficients[static_cast<std::size_t>(4 * (i * (inverse.degree + 1) + j))];
    return 2.0 * dvec2(c[0], c[1]);
  };
  const dvec2 fu = at(1, 0), fv = at(0, 1);
  const double det = fu.x * fv.y - fu.y * fv.x;
  if (det == 0.0) return false;
  const double r = 1.0 / det;
  constexpr double steeper = 16.0;
  inverse.steepest2 = steeper * steeper * r * r * (glm::dot(fu, fu) + glm::dot(fv, fv));
  spread_out(inverse);
  return true;
}

int degree_of(const TensorPolynomial<lvec4>& p) { return std::max(p.m, p.n); }
int degree_of(const TrianglePolynomial<lvec4>& p) { return p.n; }

}  // namespace

std::optional<PatchInverse> patch_inverse(const Net& net, double rounding) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  const dvec2 middle(triangle ? 1.0 / 3.0 : 0.5);
  if (const auto preimage = sphere_preimage(net)) {
    auto inverse = std::visit(
        [&](const auto& p) -> std::optional<PatchInverse> {
          if (degree_of(p) > largest_degree) return std::nullopt;
          return in_powers(p, middle, degree_of(p) <= 2 ? 2 : largest_degree, [](const lvec4& x) {
            const Spinor s = to_spinor(x);
            return Quotient{s.a, s.b};
          });
        },
        *preimage);
    if (inverse && normalise(*inverse) && fits(*inverse, net, rounding)) return inverse;
  }
  // The projection itself: (x + i y) / (w - z).
  const auto itself = [](const lvec4& x) { return Quotient{Complex(x.x, x.y), Complex(x.w - x.z)}; };
  const std::vector<lvec4> points(points_of(net).begin(), points_of(net).end());
  std::optional<PatchInverse> inverse;
  if (const auto* tensor = std::get_if<TensorNet>(&net)) {
    const TensorPolynomial<lvec4> p(tensor->m, tensor->n, points);
    if (degree_of(p) <= largest_degree)
      inverse = in_powers(p, middle, degree_of(p) <= 2 ? 2 : largest_degree, itself);
  } else {
    const TrianglePolynomial<lvec4> p(std::get<TriangleNet>(net).n, points);
    if (degree_of(p) <= largest_degree)
      inverse = in_powers(p, middle, degree_of(p) <= 2 ? 2 : largest_degree, itself);
  }
  if (!inverse || !normalise(*inverse) || !fits(*inverse, net, rounding)) return std::nullopt;
  return inverse;
}

}  // namespace rondure
