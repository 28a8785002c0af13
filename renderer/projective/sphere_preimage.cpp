#include <algorithm>
#include <cmath>

#include "renderer/projective/null_vector.h"
#include "renderer/projective/preimage.h"

namespace rondure {
namespace {

TensorPolynomial<lvec4> polynomial_of(const TensorNet& net) {
  return {net.m, net.n, std::vector<lvec4>(net.points.begin(), net.points.end())};
}
TrianglePolynomial<lvec4> polynomial_of(const TriangleNet& net) {
  return {net.n, std::vector<lvec4>(net.points.begin(), net.points.end())};
}

bool halves(int degree) { return degree > 0 && degree <= max_degree && degree % 2 == 0; }
bool halves(const TensorNet& net) { return halves(net.m) && halves(net.n); }
bool halves(const TriangleNet& net) { return halves(net.n); }

std::size_t half_size(const TensorNet& net) {
  return static_cast<std::size_t>((net.m / 2 + 1) * (net.n / 2 + 1));
}
std::size_t half_size(const TriangleNet& net) { return static_cast<std::size_t>(triangle_size(net.n / 2)); }

TensorPreimage preimage_like(const TensorNet& net) { return {net.m / 2, net.n / 2}; }
TrianglePreimage preimage_like(const TriangleNet& net) { return TrianglePreimage(net.n / 2); }

// a / b = (x + i y) / (w - z) is linear in the coefficients of a and b: a (w - z) = b (x + i y).
template <class N>
std::optional<Preimage> factor(const N& net) {
  if (!halves(net)) return std::nullopt;
  const auto x = polynomial_of(net);
  const std::size_t size = half_size(net);
  std::vector<std::vector<Complex>> rows;
  for (std::size_t k = 0; k < 2 * size; ++k) {
    const bool in_a = k < size;
    auto unit = preimage_like(net);
    unit.coefficients[in_a ? k : k - size] = lvec4(1);
    const auto column = multiply(unit, x, [&](const lvec4& one, const lvec4& p) {
      return one.x * (in_a ? Complex(p.w - p.z) : -Complex(p.x, p.y));
    });
    rows.resize(column.coefficients.size(), std::vector<Complex>(2 * size));
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i][k] = column.coefficients[i];
  }
  const NullVector solution = null_vector(rows);
  if (solution.nullity != 1) return std::nullopt;
  auto preimage = preimage_like(net);
  for (std::size_t k = 0; k < size; ++k)
    preimage.coefficients[k] = to_point(Spinor{solution.vector[k], solution.vector[size + k]});
  // Only the scale is left, and to see whether the net is on the sphere at all. A net with w < 0 throughout
  // is the negative of an image.
  const auto image = multiply(preimage, preimage, [](const lvec4& p, const lvec4& q) { return delta(p, q); });
  long double along = 0, size2 = 0, off2 = 0, all2 = 0;
  for (std::size_t k = 0; k < image.coefficients.size(); ++k) {
    along += glm::dot(x.coefficients[k], image.coefficients[k]);
    size2 += glm::dot(image.coefficients[k], image.coefficients[k]);
  }
  const long double ratio = along / size2;
  for (std::size_t k = 0; k < image.coefficients.size(); ++k) {
    const lvec4 off = x.coefficients[k] - ratio * image.coefficients[k];
    off2 += glm::dot(off, off);
    all2 += glm::dot(x.coefficients[k], x.coefficients[k]);
  }
  if (!(off2 <= 1e-20L * all2)) return std::nullopt;
  for (lvec4& p : preimage.coefficients) p *= std::sqrt(std::abs(ratio));
  return preimage;
}

}  // namespace

std::optional<Preimage> sphere_preimage(const Net& net) {
  return std::visit([](const auto& n) { return factor(n); }, net);
}

}  // namespace rondure
