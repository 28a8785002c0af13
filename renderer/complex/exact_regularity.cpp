#include "renderer/complex/exact_regularity.h"

#include <algorithm>
#include <cmath>

#include "renderer/api/patch.h"

namespace rondure {
namespace {

std::size_t index(int k) { return static_cast<std::size_t>(k); }

int place(int sides, int n, int i, int j) { return sides == 3 ? triangle_index(n, i, j) : i * (n + 1) + j; }

// The part of degree n - 1 of a triangle that belongs to one corner: the derivative by its coordinate, over
// n.
PolygonPolynomial corner_part(const PolygonPolynomial& p, int corner) {
  const int n = p.degree - 1;
  PolygonPolynomial out{3, n, {}};
  for (int k = 0; k < coefficient_count(3, n); ++k) {
    const auto e = exponents_of(3, n, k);
    out.coefficients.push_back(
        p.coefficients[index(triangle_index(n + 1, e[0] + (corner == 0), e[1] + (corner == 1)))]);
  }
  return out;
}

// A square's derivative, brought back to degree (n, n) and divided by n.
PolygonPolynomial derivative(const PolygonPolynomial& p, int axis) {
  const int n = p.degree;
  PolygonPolynomial out{4, n, std::vector<Exact>(p.coefficients.size())};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const int k = axis == 0 ? i : j;
      const auto difference = [&](int from) {
        const auto at = [&](int m) {
          return p.coefficients[index(axis == 0 ? place(4, n, m, j) : place(4, n, i, m))];
        };
        return Exact(at(from + 1) - at(from));
      };
      Exact sum = 0;
      if (k > 0) sum += k * difference(k - 1);
      if (k < n) sum += (n - k) * difference(k);
      out.coefficients[index(place(4, n, i, j))] = sum / n;
    }
  }
  return out;
}

using Columns = std::array<ExactPatch, 3>;

PolygonPolynomial minor(const Columns& c, std::size_t x, std::size_t y, std::size_t z) {
  const auto pair = [&](std::size_t a, std::size_t b) {
    return add(c[a][y] * c[b][z], c[b][y] * c[a][z], -1);
  };
  return add(add(c[0][x] * pair(1, 2), c[1][x] * pair(2, 0), 1), c[2][x] * pair(0, 1), 1);
}

// Three coordinates of a positive multiple of N.
using ExactNormal = std::array<PolygonPolynomial, 3>;

ExactNormal exact_normal(const ExactPatch& patch) {
  Columns c;
  for (std::size_t d = 0; d < 4; ++d) {
    for (int k = 0; k < 3; ++k) {
      c[index(k)][d] = patch[d].sides == 3 ? corner_part(patch[d], k)
                       : k == 0            ? patch[d]
                                           : derivative(patch[d], k - 1);
    }
  }
  return {minor(c, 1, 2, 3), minor(c, 2, 0, 3), minor(c, 0, 1, 3)};
}

// The Bernstein coefficients over the halves of a run of them.
void halve(std::vector<Exact> run, std::vector<Exact>& low, std::vector<Exact>& high) {
  const std::size_t n = run.size() - 1;
  low.resize(n + 1), high.resize(n + 1);
  for (std::size_t left = n;; --left) {
    low[n - left] = run[0];
    high[left] = run[left];
    if (left == 0) break;
    for (std::size_t k = 0; k < left; ++k) run[k] = (run[k] + run[k + 1]) / 2;
  }
}

// A triangle is cut through its corner w and the middle of the opposite side, and the new corner becomes w of
// both parts, so that they stay of few shapes. A square is cut in u, and u and v are exchanged.
std::array<PolygonPolynomial, 2> cut(const PolygonPolynomial& p) {
  const int n = p.degree;
  std::array<PolygonPolynomial, 2> parts{p, p};
  std::vector<Exact> run, low, high;
  for (int fixed = 0; fixed <= n; ++fixed) {
    const int m = p.sides == 3 ? n - fixed : n;
    run.clear();
    for (int t = 0; t <= m; ++t) {
      run.push_back(p.coefficients[index(p.sides == 3 ? place(3, n, m - t, t) : place(4, n, t, fixed))]);
    }
    halve(run, low, high);
    for (int t = 0; t <= m; ++t) {
      if (p.sides == 4) {
        const auto to = index(place(4, n, fixed, t));
        parts[0].coefficients[to] = low[index(t)];
        parts[1].coefficients[to] = high[index(t)];
        continue;
      }
      // Corners u, middle, w as w, u, middle; middle, v, w as v, w, middle.
      parts[0].coefficients[index(place(3, n, fixed, m - t))] = low[index(t)];
      parts[1].coefficients[index(place(3, n, t, fixed))] = high[index(t)];
    }
  }
  return parts;
}

bool one_sided(const ExactNormal& normal) {
  double mean[3] = {0.0, 0.0, 0.0};
  for (std::size_t d = 0; d < 3; ++d) {
    for (const Exact& c : normal[d].coefficients) mean[d] += rounded(c);
  }
  const double size = std::max({std::abs(mean[0]), std::abs(mean[1]), std::abs(mean[2])});
  if (!(size > 0.0)) return false;
  std::array<int, 3> a{};
  for (std::size_t d = 0; d < 3; ++d) a[d] = static_cast<int>(std::lround(1000.0 * mean[d] / size));
  for (std::size_t k = 0; k < normal[0].coefficients.size(); ++k) {
    Exact sum = 0;
    for (std::size_t d = 0; d < 3; ++d) sum += a[d] * normal[d].coefficients[k];
    if (sum <= 0) return false;
  }
  return true;
}

}  // namespace

ExactRegularity exact_regularity(const std::vector<ExactPatch>& patches, int deepest_allowed,
                                 long most_pieces) {
  ExactRegularity out;
  struct Piece {
    ExactNormal normal;
    int depth;
  };
  std::vector<Piece> left;
  for (const ExactPatch& patch : patches) left.push_back({exact_normal(patch), 0});
  while (!left.empty()) {
    const Piece piece = std::move(left.back());
    left.pop_back();
    out.deepest = std::max(out.deepest, piece.depth);
    if (one_sided(piece.normal)) {
      ++out.pieces;
      continue;
    }
    if (piece.depth == deepest_allowed || out.pieces + static_cast<long>(left.size()) > most_pieces)
      return out;
    Piece parts[2] = {{{}, piece.depth + 1}, {{}, piece.depth + 1}};
    for (std::size_t d = 0; d < 3; ++d) {
      auto halves = cut(piece.normal[d]);
      for (std::size_t k = 0; k < 2; ++k) parts[k].normal[d] = std::move(halves[k]);
    }
    for (Piece& part : parts) left.push_back(std::move(part));
  }
  out.certified = true;
  return out;
}

}  // namespace rondure
