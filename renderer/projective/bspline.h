// B-splines in projective 3-space, and their images under delta (Dietz, Hoschek, Juettler 1993, section 4).
#pragma once

#include <string>
#include <vector>

#include "renderer/projective/preimage.h"

namespace rondure {

// Points i of the basis functions over knots i to i + degree + 1; as many knots as points and degree + 1. The
// curve lives between knots[degree] and knots[points.size()].
struct BSpline {
  int degree = 1;
  std::vector<long double> knots;  // not decreasing
  std::vector<lvec4> points;
};

// What is wrong with the knots of that many points, or nothing.
std::string knot_defect(int degree, const std::vector<long double>& knots, std::size_t points);

// Spans of knots between which the curve lives, k of knots[k] < knots[k + 1].
std::vector<std::size_t> spans_of(int degree, const std::vector<long double>& knots, std::size_t points);

// The polynomial of that span as a symmetric multi-affine function of as many arguments as the degree has
// (Ramshaw's blossom): de Boor's algorithm with one argument a step.
lvec4 blossom(const BSpline& spline, std::size_t span, const std::vector<long double>& arguments);

// The Bernstein coefficients of the span.
std::vector<lvec4> bezier_piece(const BSpline& spline, std::size_t span);

// The image under delta of a B-spline curve: points (x, y, z, w), twice the degree d, every knot d times
// more.
BSpline sphere_image(const BSpline& preimage);

// A tensor-product surface, points[i * columns + j] with i along u, and the patches between its knots, those
// along v first.
struct BSplineSurface {
  int degree_u = 1, degree_v = 1;
  std::vector<long double> knots_u, knots_v;
  std::size_t columns = 0;
  std::vector<lvec4> points;
};
std::vector<TensorPreimage> bezier_pieces(const BSplineSurface& surface);

}  // namespace rondure
