// The space of smooth inverse spherical surfaces on the eight octants: its dimension, and that the
// construction from the weights inside the octants reaches all of it from degree 3 on.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "renderer/inverse_spherical/octant_model.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// A coefficient: its indices, and on which side of every axis it lies (0 where the index is 0: shared).
using Key = std::array<int, 6>;

Key key_of(int i, int j, int k, int x, int y, int z) {
  return {i, j, k, i > 0 ? x : 0, j > 0 ? y : 0, k > 0 ? z : 0};
}

using Equation = std::map<Key, std::int64_t>;  // sum of factor * coefficient = 0

// 2 (n - 1) c_{k,l,0} = k (c_{k-1,l,1} + c'_{k-1,l,1}) + l (c_{k,l-1,1} + c'_{k,l-1,1}) on every edge: the
// gauge function, of degree 1, is C1 there. c and c' lie on either side.
std::vector<Equation> equations(int n) {
  std::vector<Equation> out;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (const int s : {-1, 1}) {
      for (const int t : {-1, 1}) {
        for (int k = 0; k <= n; ++k) {
          const int l = n - k;
          Equation e;
          const auto add = [&](int a, int b, int c, int side, std::int64_t factor) {
            std::array<int, 3> index{}, sign{};
            index[static_cast<std::size_t>(first)] = a, index[static_cast<std::size_t>(second)] = b;
            index[static_cast<std::size_t>(axis)] = c;
            sign[static_cast<std::size_t>(first)] = s, sign[static_cast<std::size_t>(second)] = t;
            sign[static_cast<std::size_t>(axis)] = side;
            e[key_of(index[0], index[1], index[2], sign[0], sign[1], sign[2])] += factor;
          };
          add(k, l, 0, 0, 2 * (n - 1));
          for (const int side : {-1, 1}) {
            if (k > 0) add(k - 1, l, 1, side, -k);
            if (l > 0) add(k, l - 1, 1, side, -l);
          }
          out.push_back(e);
        }
      }
    }
  }
  return out;
}

std::map<Key, std::size_t> unknowns(int n) {
  std::map<Key, std::size_t> out;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j)
      for (int o = 0; o < 8; ++o)
        out.emplace(key_of(i, j, n - i - j, 1 - 2 * (o & 1), 1 - (o & 2), 1 - (o & 4) / 2), out.size());
  return out;
}

constexpr std::int64_t prime = 998244353;

std::int64_t inverse(std::int64_t a) {
  std::int64_t result = 1;
  for (std::int64_t e = prime - 2; e > 0; e /= 2, a = a * a % prime)
    if (e % 2 == 1) result = result * a % prime;
  return result;
}

// Modulo a prime: never more than the rank over the rationals, and equal unless the prime divides a minor.
std::size_t rank(std::vector<std::vector<std::int64_t>> rows) {
  std::size_t done = 0;
  const std::size_t columns = rows.front().size();
  for (std::size_t c = 0; c < columns && done < rows.size(); ++c) {
    std::size_t pivot = done;
    while (pivot < rows.size() && rows[pivot][c] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[done]);
    const std::int64_t scale = inverse(rows[done][c]);
    for (std::size_t r = done + 1; r < rows.size(); ++r) {
      const std::int64_t factor = rows[r][c] * scale % prime;
      if (factor == 0) continue;
      for (std::size_t k = c; k < columns; ++k)
        rows[r][k] = (rows[r][k] + (prime - factor) * rows[done][k]) % prime;
    }
    ++done;
  }
  return done;
}

}  // namespace

TEST_CASE("the space on eight octants has the reference's dimensions", "[iss]") {
  const std::size_t expected[] = {3, 3, 8, 24, 48, 80};
  for (int n = 1; n <= 6; ++n) {
    const std::map<Key, std::size_t> columns = unknowns(n);
    std::vector<std::vector<std::int64_t>> rows;
    for (const Equation& e : equations(n)) {
      rows.emplace_back(columns.size(), 0);
      for (const auto& [key, factor] : e) rows.back()[columns.at(key)] = (factor % prime + prime) % prime;
    }
    CHECK(columns.size() == static_cast<std::size_t>(4 * n * n + 2));
    CHECK(columns.size() - rank(rows) == expected[n - 1]);
    // Free weights inside the octants, as many as the dimension.
    if (n >= 3) CHECK(expected[n - 1] == static_cast<std::size_t>(4 * (n - 1) * (n - 2)));
  }
}

TEST_CASE("whatever the weights inside the octants, the model is in that space", "[iss]") {
  NetMaker make(81);
  WorstCase worst;
  int unlike = 0;  // shared coefficients, which have the same bits in both patches
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 3 + trial % 6;
    std::array<std::vector<double>, 8> interior;
    for (std::vector<double>& weights : interior) {
      weights.resize(static_cast<std::size_t>(triangle_size(n)));
      for (double& w : weights) w = make.uniform(0.1, 2.0);
    }
    const std::array<PlanarIss, 8> model = octant_model(n, interior);
    std::map<Key, double> values;
    for (int o = 0; o < 8; ++o)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n - i; ++j) {
          const double w =
              model[static_cast<std::size_t>(o)].weights[static_cast<std::size_t>(triangle_index(n, i, j))];
          const auto [at, fresh] =
              values.emplace(key_of(i, j, n - i - j, 1 - 2 * (o & 1), 1 - (o & 2), 1 - (o & 4) / 2), w);
          unlike += !fresh && at->second != w;
        }
    for (const Equation& e : equations(n)) {
      double sum = 0.0, size = 0.0;
      for (const auto& [key, factor] : e)
        sum += static_cast<double>(factor) * values.at(key),
            size += std::fabs(static_cast<double>(factor) * values.at(key));
      // Edges follow from sums of four weights, corners from sums over those: some roundings of each.
      worst.add(std::fabs(sum), 16.0 * 0x1p-52 * size, [&] { return fmt::format("degree {}", n); });
    }
  }
  CHECK(unlike == 0);
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

}  // namespace rondure
