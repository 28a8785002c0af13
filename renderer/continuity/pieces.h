// Patches halved again and again, with the Bernstein polynomials on them that are to be bounded.
#pragma once

#include <utility>
#include <vector>

#include "renderer/bezier/product.h"

namespace rondure {

// Coefficients that cannot be halved. Instead polynomials of degree n become 2^n times themselves when they
// are cut (n in the direction of the cut).
template <class T>
concept Unhalvable = requires(T c, int n) {
  {c << n};
};

// The coefficients over the halves of a run of them that belongs to a polynomial of degree n.
template <class T>
void halve(std::vector<T> run, [[maybe_unused]] int n, std::vector<T>& low, std::vector<T>& high) {
  const std::size_t last = run.size() - 1;
  low.resize(last + 1), high.resize(last + 1);
  for (std::size_t left = last;; --left) {
    if constexpr (Unhalvable<T>) {
      const int doublings = n - static_cast<int>(last - left);
      low[last - left] = run[0] << doublings;
      high[left] = run[left] << doublings;
    } else {
      low[last - left] = run[0];
      high[left] = run[left];
    }
    if (left == 0) break;
    for (std::size_t k = 0; k < left; ++k) {
      if constexpr (Unhalvable<T>) {
        run[k] += run[k + 1];
      } else {
        run[k] = 0.5 * run[k] + 0.5 * run[k + 1];
      }
    }
  }
}

// In u, and u and v exchanged.
template <class T>
std::pair<TensorPolynomial<T>, TensorPolynomial<T>> cut(const TensorPolynomial<T>& p) {
  std::pair<TensorPolynomial<T>, TensorPolynomial<T>> parts{{p.n, p.m}, {p.n, p.m}};
  std::vector<T> run(static_cast<std::size_t>(p.m) + 1), low, high;
  for (int j = 0; j <= p.n; ++j) {
    for (int i = 0; i <= p.m; ++i) run[static_cast<std::size_t>(i)] = p.at(i, j);
    halve(run, p.m, low, high);
    for (int i = 0; i <= p.m; ++i) {
      parts.first.at(j, i) = low[static_cast<std::size_t>(i)];
      parts.second.at(j, i) = high[static_cast<std::size_t>(i)];
    }
  }
  return parts;
}

// Through the corner w and the middle of the opposite side, which becomes corner w of both parts.
template <class T>
std::pair<TrianglePolynomial<T>, TrianglePolynomial<T>> cut(const TrianglePolynomial<T>& p) {
  std::pair<TrianglePolynomial<T>, TrianglePolynomial<T>> parts{TrianglePolynomial<T>(p.n),
                                                                TrianglePolynomial<T>(p.n)};
  std::vector<T> run, low, high;
  for (int k = 0; k <= p.n; ++k) {
    const int m = p.n - k;
    run.resize(static_cast<std::size_t>(m) + 1);
    for (int t = 0; t <= m; ++t) run[static_cast<std::size_t>(t)] = p.at(m - t, t);
    halve(run, p.n, low, high);
    for (int t = 0; t <= m; ++t) {
      parts.first.at(k, m - t) = low[static_cast<std::size_t>(t)];
      parts.second.at(t, k) = high[static_cast<std::size_t>(t)];
    }
  }
  return parts;
}

// A piece of a patch: its normal, its weight, and its corners: 00, 10, 11, 01, or where u, v, w = 1.
template <class Normal, class Weight>
struct Piece {
  Normal normal;
  Weight weight;
  std::vector<dvec2> corners;
  int depth = 0;
};

template <class N, class W>
std::pair<Piece<N, W>, Piece<N, W>> cut(const Piece<N, W>& p) {
  auto normals = cut(p.normal);
  auto weights = cut(p.weight);
  const auto& c = p.corners;
  std::vector<dvec2> first, second;
  const dvec2 middle = 0.5 * (c[0] + c[1]);
  if (c.size() == 3) {
    first = {c[2], c[0], middle};
    second = {c[1], c[2], middle};
  } else {
    // Corners 00, 10, 11, 01; after the exchange u runs from 00 to 01.
    const dvec2 across = 0.5 * (c[3] + c[2]);
    first = {c[0], c[3], across, middle};
    second = {middle, across, c[2], c[1]};
  }
  return {Piece<N, W>{std::move(normals.first), std::move(weights.first), std::move(first), p.depth + 1},
          Piece<N, W>{std::move(normals.second), std::move(weights.second), std::move(second), p.depth + 1}};
}

// Indices of the coefficients at the corners, in the order of Piece::corners.
template <class T>
std::vector<std::size_t> corner_indices(const TensorPolynomial<T>& p) {
  const auto index = [&](int i, int j) { return static_cast<std::size_t>(i * (p.n + 1) + j); };
  return {index(0, 0), index(p.m, 0), index(p.m, p.n), index(0, p.n)};
}
template <class T>
std::vector<std::size_t> corner_indices(const TrianglePolynomial<T>& p) {
  const auto index = [&](int i, int j) { return static_cast<std::size_t>(triangle_index(p.n, i, j)); };
  return {index(p.n, 0), index(0, p.n), index(0, 0)};
}

// A patch's own corners.
inline std::vector<dvec2> whole_triangle() { return {dvec2(1, 0), dvec2(0, 1), dvec2(0, 0)}; }
inline std::vector<dvec2> whole_square() { return {dvec2(0, 0), dvec2(1, 0), dvec2(1, 1), dvec2(0, 1)}; }

}  // namespace rondure
