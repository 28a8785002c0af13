#include "renderer/intersect/ellipsoid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/ellipsoid_proof.h"
#include "renderer/intersect/root.h"

namespace rondure {
namespace {

using lmat3 = EllipsoidMap::Matrix;
using lvec3 = glm::vec<3, long double, glm::defaultp>;

// Semi-axes further apart than this, and patches smaller than this part of their ellipsoid when they have no
// others beside them, leave too few digits.
constexpr long double flattest = 1e4L, smallest_part = 0.2L;
constexpr std::size_t most_fits = 8;  // that failed, before the rest of a surface is given up
constexpr std::size_t many = 4;       // patches, of which fewer points each tell as much of a sphere

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

void add_samples(const Net& net, int steps, std::vector<lvec3>& out) {
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

std::optional<Map> fit_ellipsoid(const std::vector<lvec3>& points, const lvec3& about, long double size) {
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

// The ellipsoid, or sphere, nearest to points of these patches.
std::optional<EllipsoidFit> fit_to(const std::vector<Net>& patches, const std::vector<std::size_t>& which,
                                   bool sphere) {
  std::vector<lvec3> points;
  for (const std::size_t k : which) add_samples(patches[k], sphere && which.size() >= many ? 2 : 4, points);
  lvec3 low(INFINITY), high(-INFINITY), middle(0);
  for (const lvec3& p : points) low = glm::min(low, p), high = glm::max(high, p), middle += p;
  middle /= static_cast<long double>(points.size());
  long double size = 0;
  for (const lvec3& p : points) size = std::max(size, glm::length(p - middle));
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  const auto map = sphere ? fit_sphere(points, middle, size) : fit_ellipsoid(points, middle, size);
  if (!map) return std::nullopt;
  const lmat3 &m = map->linear, inverse = glm::inverse(m);
  const auto longest = [](const lmat3& a) {
    return std::max({glm::length(a[0]), glm::length(a[1]), glm::length(a[2])});
  };
  if (!(longest(m) * longest(inverse) < flattest)) return std::nullopt;
  if (!(glm::length(high - low) > smallest_part * longest(m))) return std::nullopt;
  return EllipsoidFit{dmat3(m), dvec3(map->center), 0.0, {}};
}

// Of a plain net, which then adds what it misses the ellipsoid by.
bool lies_on(const Net& net, const EllipsoidMap& map, EllipsoidFit& fit) {
  const double defect = defect_of(net, map);
  if (!(defect <= ellipsoid_roundoffs * unit_roundoff * static_cast<double>(1 + map.distance))) return false;
  fit.off = std::max(fit.off, 0.5 * defect);
  return true;
}

// All of these patches on one.
std::optional<EllipsoidFit> fit_together(const std::vector<Net>& patches,
                                         const std::vector<std::size_t>& which) {
  for (const bool sphere : {true, false}) {
    auto fit = fit_to(patches, which, sphere);
    if (!fit) continue;
    const EllipsoidMap map(fit->linear, fit->center);
    const auto near = [&](std::size_t k) { return may_lie_on(patches[k], map); };
    const auto on = [&](std::size_t k) { return lies_on(patches[k], map, *fit); };
    if (!std::all_of(which.begin(), which.end(), near) || !std::all_of(which.begin(), which.end(), on))
      continue;
    fit->patches = which;
    return fit;
  }
  return std::nullopt;
}

bool is_plain(const Net& net) {
  for (const dvec4& p : points_of(net))
    if (!(p.w > 0.0) || !std::isfinite(p.x + p.y + p.z + p.w)) return false;
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    return std::max(tensor->m, tensor->n) <= largest_proven_degree;
  return std::get<TriangleNet>(net).n <= largest_proven_degree;
}

// Patches that have no ellipsoid yet, by their first corner's place.
class Rest {
 public:
  Rest(const std::vector<Net>& patches, const std::vector<std::size_t>& which)
      : patches_(patches), which_(which), left_(patches.size(), false) {
    for (const std::size_t k : which) {
      const dvec4& p = points_of(patches[k]).front();
      left_[k] = true, corners_.push_back({p.x / p.w, k});
    }
    std::sort(corners_.begin(), corners_.end());
  }

  std::optional<std::size_t> first() {
    while (first_ < which_.size() && !left_[which_[first_]]) ++first_;
    return first_ < which_.size() ? std::optional(which_[first_]) : std::nullopt;
  }
  void remove(std::size_t patch) { left_[patch] = false; }

  // Those that may be on it, in order.
  std::vector<std::size_t> near(const EllipsoidFit& fit) const {
    const EllipsoidMap map(fit.linear, fit.center);
    const dmat3& m = fit.linear;
    const double half = (1.0 + 1e-5) * glm::length(dvec3(m[0].x, m[1].x, m[2].x)), x = fit.center.x;
    std::vector<std::size_t> out;
    auto corner = std::lower_bound(corners_.begin(), corners_.end(), std::pair(x - half, std::size_t{0}));
    for (; corner != corners_.end() && corner->first <= x + half; ++corner)
      if (left_[corner->second] && may_lie_on(patches_[corner->second], map)) out.push_back(corner->second);
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  const std::vector<Net>& patches_;
  const std::vector<std::size_t>& which_;
  std::vector<bool> left_;
  std::vector<std::pair<double, std::size_t>> corners_;
  std::size_t first_ = 0;
};

// What the seed is on, with all others on it; fitted to all of them where they agree.
std::optional<EllipsoidFit> fit_around(const std::vector<Net>& patches, const Rest& rest, std::size_t seed) {
  for (const bool sphere : {true, false}) {
    auto fit = fit_to(patches, {seed}, sphere);
    if (!fit) continue;
    const std::vector<std::size_t> near = rest.near(*fit);
    if (near.size() > 1)
      if (auto better = fit_together(patches, near)) return better;
    const EllipsoidMap map(fit->linear, fit->center);
    for (const std::size_t k : near)
      if (lies_on(patches[k], map, *fit)) fit->patches.push_back(k);
    if (!fit->patches.empty()) return fit;
  }
  return std::nullopt;
}

}  // namespace

std::vector<EllipsoidFit> fit_ellipsoids(const std::vector<Net>& patches) {
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < patches.size(); ++k)
    if (is_plain(patches[k])) which.push_back(k);
  if (which.empty()) return {};
  // All together where they are on one ellipsoid, which determines it best; else from one after the other.
  if (auto fit = fit_together(patches, which)) return {*fit};
  std::vector<EllipsoidFit> fits;
  Rest rest(patches, which);
  std::size_t failed = 0;
  while (const auto seed = rest.first()) {
    const auto fit = fit_around(patches, rest, *seed);
    if (fit) {
      fits.push_back(*fit);
      for (const std::size_t k : fit->patches) rest.remove(k);
    } else {
      if (++failed == most_fits) break;
    }
    rest.remove(*seed);
  }
  return fits;
}

}  // namespace rondure
