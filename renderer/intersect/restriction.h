// A patch's nets over cells, for bounds: fast, and equal to restrict_to (cell.h) but for rounding.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "renderer/intersect/leaf_arithmetic.h"

namespace rondure {

// For building leaves: one patch after another, in one thread.
template <class Shape>
class Restriction;

template <>
class Restriction<TensorShape> {
 public:
  // `net` must stay where it is.
  void start(const TensorShape& shape, const std::vector<dvec4>& net) {
    if (shape.m != shape_.m || shape.n != shape_.n)
      shape_ = shape, arithmetic = leaf_arithmetic(shape, best_instructions()),
      parameters = parameters_of(shape);
    ++patch_, net_ = net.data();
    magnitudes_.resize(net.size());
    for (std::size_t k = 0; k < net.size(); ++k) magnitudes_[k] = glm::abs(net[k]);
  }

  LeafArithmetic<TensorShape> arithmetic{};
  LeafParameters parameters;

  void points(const RectangleCell& c, dvec4* out) {
    arithmetic.along_v(shape_, across(c).weights.data(), rows(along(c), 0, net_), out);
  }
  // Of the magnitudes |P_ij|, componentwise.
  NetScale scale(const RectangleCell& c) {
    return arithmetic.scale_along_v(shape_, across(c).weights.data(), rows(along(c), 1, magnitudes_.data()));
  }

 private:
  // Of u or v. The cells of one patch after another are cut at the same places, and those of one patch share
  // what is cut along u.
  struct Interval {
    int degree = -1;
    double from = 0.0, to = 0.0;
    std::vector<double> weights;      // row k: of the old coefficients in the new coefficient k
    std::vector<dvec4> rows[2];       // a patch's net and its magnitudes, cut at the ends along u
    std::uint64_t known[2] = {0, 0};  // of which patch they are
  };
  std::array<Interval, 256> known_[2];
  TensorShape shape_{-1, -1};
  std::uint64_t patch_ = 0;
  const dvec4* net_ = nullptr;
  std::vector<dvec4> magnitudes_;

  Interval& along(const RectangleCell& c) { return interval(0, shape_.m, c.low.x, c.high.x); }
  Interval& across(const RectangleCell& c) { return interval(1, shape_.n, c.low.y, c.high.y); }

  Interval& interval(int direction, int degree, double from, double to) {
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
      interval.known[0] = interval.known[1] = 0;
    }
    return interval;
  }

  const dvec4* rows(Interval& interval, int which, const dvec4* net) {
    std::vector<dvec4>& rows = interval.rows[which];
    if (interval.known[which] != patch_) {
      rows.resize(magnitudes_.size());
      arithmetic.along_u(shape_, interval.weights.data(), net, rows.data());
      interval.known[which] = patch_;
    }
    return rows.data();
  }
};

template <>
class Restriction<TriangleShape> {
 public:
  void start(const TriangleShape& shape, const std::vector<dvec4>& net) {
    if (shape.n != shape_.n)
      shape_ = shape, arithmetic = leaf_arithmetic(shape, best_instructions()),
      parameters = parameters_of(shape);
    net_ = net.data();
    magnitudes_.resize(net.size()), cut_.resize(net.size());
    for (std::size_t k = 0; k < net.size(); ++k) magnitudes_[k] = glm::abs(net[k]);
  }

  LeafArithmetic<TriangleShape> arithmetic{};
  LeafParameters parameters;

  void points(const TriangleCell& c, dvec4* out) { arithmetic.restrict_to(shape_, c, net_, out); }
  NetScale scale(const TriangleCell& c) {
    arithmetic.restrict_to(shape_, c, magnitudes_.data(), cut_.data());
    return arithmetic.scale(shape_.size(), cut_.data());
  }

 private:
  TriangleShape shape_{-1};
  const dvec4* net_ = nullptr;
  std::vector<dvec4> magnitudes_, cut_;
};

}  // namespace rondure
