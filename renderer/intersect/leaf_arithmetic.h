// The arithmetic of which leaves are made, by the instructions of one set: the same bits on all.
#pragma once

#include <vector>

#include "renderer/intersect/instructions.h"
#include "renderer/intersect/leaf.h"

namespace rondure {

// The leaf's parameters less those of its centre, at a net's points: the Bernstein coefficients of (a, b), as
// (a, b, 0, 1), and of (a^2, a b, b^2), where the degrees allow these.
struct LeafParameters {
  std::vector<dvec4> linear;
  bool has_squares = false;
  std::vector<double> squares[3];  // rounded up to whole `lanes`, by the last of them

  static constexpr std::size_t lanes = 4;
};

LeafParameters parameters_of(const TensorShape& shape);
LeafParameters parameters_of(const TriangleShape& shape);

// What the polynomials (N_xi, N_eta, N_zeta, w) do in a leaf's frame, from their coefficients; componentwise.
struct FrameExtent {
  dvec4 off;                   // largest |N - (a, b, 0, 1)| over the leaf
  double zeta_low, zeta_high;  // over the leaf
  double sagging;              // largest |N_zeta - bend (a^2, a b, b^2)| over the leaf, or infinite
  dvec4 a_low, a_high;         // over the enlarged leaf, differences of neighbours along a
  dvec4 b_low, b_high;         // and along b
};

// By a frame's numbers of homogeneous points, over the weight of the centre's. `points`: of the leaf, `wide`:
// of the enlarged one.
struct FramedNets {
  const LeafFrame& frame;
  double inverse_weight;
  const LeafParameters& parameters;
  const dvec4 *points, *wide;
};

template <class Shape>
struct LeafArithmetic;

template <>
struct LeafArithmetic<TensorShape> {
  // A net's rows combined, out(i, j) = sum of weights[i (m + 1) + k] net(k, j), or its columns, by
  // weights[j (n + 1) + k].
  void (*along_u)(const TensorShape&, const double* weights, const dvec4* net, dvec4* out);
  void (*along_v)(const TensorShape&, const double* weights, const dvec4* net, dvec4* out);
  // The largest magnitudes of the latter's coefficients.
  NetScale (*scale_along_v)(const TensorShape&, const double* weights, const dvec4* net);
  SecondOrder<dvec4> (*second)(const TensorShape&, const dvec4* net, dvec2 at);
  FrameExtent (*extent)(const TensorShape&, const FramedNets&);
  Box (*box)(int size, const dvec4* points);  // of positive weights
};

template <>
struct LeafArithmetic<TriangleShape> {
  // As restrict_to (cell.h).
  void (*restrict_to)(const TriangleShape&, const TriangleCell&, const dvec4* net, dvec4* out);
  NetScale (*scale)(int size, const dvec4* net);
  SecondOrder<dvec4> (*second)(const TriangleShape&, const dvec4* net, dvec2 at);
  FrameExtent (*extent)(const TriangleShape&, const FramedNets&);
  Box (*box)(int size, const dvec4* points);
};

LeafArithmetic<TensorShape> leaf_arithmetic(const TensorShape& shape, Instructions set);
LeafArithmetic<TriangleShape> leaf_arithmetic(const TriangleShape& shape, Instructions set);

}  // namespace rondure
