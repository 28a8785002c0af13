// Nets over cells, for bounds: fast, and equal to restrict_to (cell.h) but for rounding.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "renderer/intersect/cell.h"

namespace rondure {

// For building leaves: not to be shared by threads.
class Restriction {
 public:
  void operator()(const TensorShape& shape, const dvec4* net, const RectangleCell& c, dvec4* out) {
    const double *u = weights(0, shape.m, c.low.x, c.high.x), *v = weights(1, shape.n, c.low.y, c.high.y);
    with_degrees(shape.m, shape.n, [&](auto m, auto n) { multiply<m, n>(shape.m, shape.n, u, v, net, out); });
  }

  void operator()(const TriangleShape& shape, const dvec4* net, const TriangleCell& c, dvec4* out) {
    triangle_restrict(net, shape.n, c.corner, out);
  }

 private:
  struct Interval {
    int degree = -1;
    double from = 0.0, to = 0.0;
    std::vector<double> weights;  // row k: of the old coefficients in the new coefficient k
  };
  // By direction. The cells of one patch after another are cut at the same places.
  std::array<Interval, 256> known_[2];

  const double* weights(int direction, int degree, double from, double to) {
    const std::uint64_t key = std::bit_cast<std::uint64_t>(from) * 3 + std::bit_cast<std::uint64_t>(to) * 5 +
                              static_cast<std::uint64_t>(degree);
    Interval& interval = known_[direction][key * 0x9e3779b97f4a7c15u >> 56];
    if (interval.degree != degree || interval.from != from || interval.to != to) {
      const int size = degree + 1;
      double unit[max_net_size] = {};
      for (int k = 0; k < size; ++k) unit[k * size + k] = 1.0;
      interval.weights.resize(static_cast<std::size_t>(size * size));
      curves_restrict(unit, degree, size, from, to, interval.weights.data());
      interval.degree = degree, interval.from = from, interval.to = to;
    }
    return interval.weights.data();
  }

  template <int M, int N>
  static void multiply(int m, int n, const double* along_u, const double* along_v, const dvec4* net,
                       dvec4* out) {
    const int rows = (M >= 0 ? M : m) + 1, columns = (N >= 0 ? N : n) + 1;
    using Lanes = detail::Lanes4;
    Lanes row[(N >= 0 ? N : max_degree) + 1];
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        Lanes sum{};
        for (int k = 0; k < rows; ++k)
          sum += along_u[i * rows + k] * detail::lane_cast<Lanes>(net[k * columns + j]);
        row[j] = sum;
      }
      for (int j = 0; j < columns; ++j) {
        Lanes sum{};
        for (int k = 0; k < columns; ++k) sum += along_v[j * columns + k] * row[k];
        out[i * columns + j] = detail::lane_cast<dvec4>(sum);
      }
    }
  }
};

}  // namespace rondure
