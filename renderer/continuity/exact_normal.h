// The normal polynomial of a net in integers: doubles are rational numbers, so that nothing is rounded.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "renderer/api/patch.h"
#include "renderer/bezier/exact.h"
#include "renderer/bezier/product.h"

namespace rondure {

// The net's coordinates as integers times 2^exponent, one exponent for w x, w y, w z and one for w.
struct IntegerNet {
  bool triangle = false;
  int m = 0, n = 0;                            // m = n on a triangle
  std::vector<std::array<Integer, 4>> points;  // in the net's order
  std::array<int, 2> exponent{0, 0};           // of space and of weight
  std::size_t place(int i, int j) const;       // of coefficient (i, j)
  Integer binomials(int i, int j) const;       // C(m, i) C(n, j), or n! / (i! j! k!)
};
IntegerNet integer_net(const Net& net);

// Coefficients of the normal polynomial.
struct IntegerVector {
  Integer x, y, z;
  IntegerVector(int all = 0) : x(all), y(all), z(all) {}  // as TensorPolynomial makes them
  IntegerVector& operator+=(const IntegerVector& b) { return x += b.x, y += b.y, z += b.z, *this; }
  friend IntegerVector operator<<(IntegerVector a, int by) { return a.x <<= by, a.y <<= by, a.z <<= by, a; }
  bool zero() const { return x == 0 && y == 0 && z == 0; }
};

// N of renderer/bezier/normal.h is `normal` times `factor` 2^exponent; tensor patches have it with its degree
// raised by one in either direction. Powers of u, 1 - u, v, 1 - v (u, v, w) that divide it are divided out.
struct ExactNormal {
  std::variant<TensorPolynomial<IntegerVector>, TrianglePolynomial<IntegerVector>> normal;
  double factor = 1.0;  // positive, good to an eps or two
  int exponent = 0;
  int divided = 0;  // how many linear factors were divided out
};

// Nothing where a direction has degree 0 or where N is zero everywhere.
std::optional<ExactNormal> exact_normal(const IntegerNet& net);

}  // namespace rondure
