#include "renderer/intersect/ellipsoid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "renderer/bezier/product.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/root.h"
#include "renderer/projective/generalised_projection.h"

namespace rondure {
namespace {

using lmat3 = glm::mat<3, 3, long double, glm::defaultp>;

// Semi-axes further apart than this, and patches smaller than this part of their ellipsoid when they have no
// others beside them, leave too few digits.
constexpr long double flattest = 1e4L, smallest_part = 0.2L;
constexpr std::size_t most_fits = 8;  // that failed, before the rest of a surface is given up

// The x that solves the normal equations of rows . x = right; nothing when they are singular to half of the
// digits.
template <std::size_t N>
class Normal {
 public:
  void add(const std::array<long double, N>& row, long double right) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) m_[i][j] += row[i] * row[j];
      m_[i][N] += row[i] * right;
    }
  }
  std::optional<std::array<long double, N>> solve() const {
    auto m = m_;
    long double greatest = 0;
    for (std::size_t k = 0; k < N; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k; i < N; ++i)
        if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
      std::swap(m[k], m[pivot]);
      greatest = std::max(greatest, std::abs(m[k][k]));
      if (!(std::abs(m[k][k]) > 1e-12L * greatest)) return std::nullopt;
      for (std::size_t i = k + 1; i < N; ++i) {
        const long double f = m[i][k] / m[k][k];
        for (std::size_t j = k; j <= N; ++j) m[i][j] -= f * m[k][j];
      }
    }
    std::array<long double, N> x{};
    for (std::size_t k = N; k-- > 0;) {
      x[k] = m[k][N];
      for (std::size_t j = k + 1; j < N; ++j) x[k] -= m[k][j] * x[j];
      x[k] /= m[k][k];
    }
    return x;
  }

 private:
  std::array<std::array<long double, N + 1>, N> m_{};
};

void add_samples(const Net& net, std::vector<lvec3>& out) {
  constexpr int steps = 4;
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= (triangle ? steps - i : steps); ++j)
      out.push_back(lvec3(net_point(net, double(i) / steps, double(j) / steps)));
}

// Less its last bits where that moves it by no more than a net's rounding can have.
long double plain(long double x) {
  const int exponent = std::ilogb(x);
  const long double rounded = std::ldexp(std::nearbyint(std::ldexp(x, 46 - exponent)), exponent - 46);
  return std::abs(rounded - x) <= 2e-16L * x ? rounded : x;
}

struct Map {
  lmat3 linear;
  lvec3 center;
};

std::optional<Map> fit_sphere(const std::vector<lvec3>& points, const lvec3& about, long double size) {
  Normal<4> normal;
  for (const lvec3& p : points) {
    const lvec3 x = (p - about) / size;
    normal.add({2 * x.x, 2 * x.y, 2 * x.z, 1}, glm::dot(x, x));
  }
  const auto s = normal.solve();
  if (!s) return std::nullopt;
  const lvec3 c((*s)[0], (*s)[1], (*s)[2]);
  const long double r = size * std::sqrt((*s)[3] + glm::dot(c, c));
  lvec3 center = about + size * c;
  for (int k = 0; k < 3; ++k)
    if (std::abs(center[k]) < 4e-16L * r) center[k] = 0;
  return Map{lmat3(plain(r)), center};
}

std::optional<Map> fit_ellipsoid(const std::vector<lvec3>& points) {
  lvec3 about(0);
  for (const lvec3& p : points) about += p / static_cast<long double>(points.size());
  long double size = 0;
  for (const lvec3& p : points) size = std::max(size, glm::length(p - about));
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  Normal<9> normal;
  for (const lvec3& p : points) {
    const lvec3 x = (p - about) / size;
    normal.add({x.x * x.x, x.y * x.y, x.z * x.z, 2 * x.x * x.y, 2 * x.y * x.z, 2 * x.z * x.x, 2 * x.x,
                2 * x.y, 2 * x.z},
               1);
  }
  const auto s = normal.solve();
  if (!s) return std::nullopt;
  const auto& q = *s;
  const lmat3 square(q[0], q[3], q[5], q[3], q[1], q[4], q[5], q[4], q[2]);
  const lvec3 linear(q[6], q[7], q[8]);
  if (!(std::abs(glm::determinant(square)) > 0)) return std::nullopt;
  const lvec3 center = -(glm::inverse(square) * linear);
  const long double level = 1 - glm::dot(linear, center);
  if (!(level > 0)) return std::nullopt;
  // Cholesky's factor, upper: its inverse takes the unit sphere to the ellipsoid.
  lmat3 upper(0);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      long double sum = square[j][i] / level;
      for (int k = 0; k < i; ++k) sum -= upper[i][k] * upper[j][k];
      if (i == j && !(sum > 0)) return std::nullopt;
      upper[j][i] = i == j ? std::sqrt(sum) : sum / upper[i][i];
    }
  }
  const lmat3 map = size * glm::inverse(upper);
  const long double a = map[0][0], b = map[1][1], c = map[2][2];
  const long double off = std::max(
      {std::abs(map[1][0]), std::abs(map[2][0]), std::abs(map[2][1]), std::abs(b - a), std::abs(c - a)});
  if (off < 1e-12L * a) return fit_sphere(points, about + size * center, size);
  lvec3 place = about + size * center;
  for (int k = 0; k < 3; ++k)
    if (std::abs(place[k]) < 4e-16L * std::min({a, b, c})) place[k] = 0;
  return Map{map, place};
}

// Bound on |x|^2 / w^2 - 1 over the patch: Bernstein coefficients of |x|^2 - w^2 against those of w^2, one by
// one, as the quotient of both polynomials is a mean of theirs, with positive weights. (The smallest weight's
// square in the place of all would ask more, by the square of the ratio of the weights, where the patch is no
// more exact.)
template <class Polynomial>
long double defect_of(const Polynomial& image) {
  const auto defect = multiply(image, image, [](const lvec4& p, const lvec4& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z - p.w * q.w;
  });
  const auto square = multiply(image, image, [](const lvec4& p, const lvec4& q) { return p.w * q.w; });
  long double most = 0;
  for (std::size_t k = 0; k < defect.coefficients.size(); ++k) {
    const long double here = std::abs(defect.coefficients[k]) / square.coefficients[k];
    if (!(here <= most)) most = here;
  }
  return most;
}

// Of a net with positive weights, which then adds what it misses the ellipsoid by.
bool lies_on(const Net& net, EllipsoidFit& fit) {
  const lmat3 inverse = glm::inverse(lmat3(fit.linear));
  const lvec3 center(fit.center);
  std::vector<lvec4> image;
  for (const dvec4& p : points_of(net))
    image.push_back(lvec4(inverse * (lvec3(p) - center * static_cast<long double>(p.w)), p.w));
  const auto* tensor = std::get_if<TensorNet>(&net);
  const long double defect =
      tensor ? defect_of(TensorPolynomial<lvec4>(tensor->m, tensor->n, std::move(image)))
             : defect_of(TrianglePolynomial<lvec4>(std::get<TriangleNet>(net).n, std::move(image)));
  const long double distance = glm::length(inverse * center);
  if (!(defect <= ellipsoid_roundoffs * unit_roundoff * (1 + distance))) return false;
  fit.off = std::max(fit.off, static_cast<double>(defect / 2));
  return true;
}

// Of these patches alone.
std::optional<EllipsoidFit> fit_one(const std::vector<Net>& patches, const std::vector<std::size_t>& which) {
  std::vector<lvec3> points;
  for (const std::size_t k : which) add_samples(patches[k], points);
  const auto map = fit_ellipsoid(points);
  if (!map) return std::nullopt;
  lvec3 low(INFINITY), high(-INFINITY);
  for (const lvec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
  const lmat3& m = map->linear;
  const long double longest = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
  const lmat3 inverse = glm::inverse(m);
  const long double flat =
      longest * std::max({glm::length(inverse[0]), glm::length(inverse[1]), glm::length(inverse[2])});
  if (!(flat < flattest) || !(glm::length(high - low) > smallest_part * longest)) return std::nullopt;
  return EllipsoidFit{dmat3(m), dvec3(map->center), 0.0, {}};
}

bool is_plain(const Net& net) {
  for (const dvec4& p : points_of(net))
    if (!(p.w > 0.0) || !std::isfinite(p.x + p.y + p.z + p.w)) return false;
  if (const auto* tensor = std::get_if<TensorNet>(&net)) return std::max(tensor->m, tensor->n) <= 8;
  return std::get<TriangleNet>(net).n <= 8;
}

}  // namespace

std::vector<EllipsoidFit> fit_ellipsoids(const std::vector<Net>& patches) {
  std::vector<EllipsoidFit> fits;
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < patches.size(); ++k)
    if (is_plain(patches[k])) rest.push_back(k);
  // All together where they are on one ellipsoid, which determines it best; else from one after the other.
  std::size_t failed = 0;
  for (bool together = true; !rest.empty() && failed < most_fits; together = false) {
    std::vector<std::size_t> seed = together ? rest : std::vector<std::size_t>{rest.front()};
    auto fit = fit_one(patches, seed);
    std::vector<std::size_t> others;
    for (const std::size_t k : rest) (fit && lies_on(patches[k], *fit) ? fit->patches : others).push_back(k);
    const bool found = fit && !fit->patches.empty();
    if (found && !(together && !others.empty())) {
      fits.push_back(*fit);
      rest = std::move(others);
    } else if (!together) {
      ++failed;
      rest.erase(rest.begin());
    }
  }
  return fits;
}

}  // namespace rondure
