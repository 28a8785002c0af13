#include "renderer/projective/quadric.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace rondure {
namespace {

using lmat3 = glm::mat<3, 3, long double, glm::defaultp>;

// Relative to what cancelled; and to the largest, where a sum that is given has cancelled before.
constexpr long double nothing = 1e-12L, noise = 1e-15L;

struct Axes {
  lvec3 value;
  lmat3 turn;  // columns: the axes, right-handed; near those of the coordinates where there is a choice
};

// Jacobi's method. The angles are at most 45 degrees, so that a diagonal matrix keeps its axes.
Axes principal_axes(lmat3 a) {
  lmat3 turn(1);
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const long double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const long double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0L));
        const long double c = 1 / std::hypot(t, 1.0L), s = t * c;
        lmat3 rotation(1);
        rotation[p][p] = rotation[q][q] = c;
        rotation[q][p] = s;
        rotation[p][q] = -s;
        a = glm::transpose(rotation) * a * rotation;
        a[p][q] = a[q][p] = 0;
        turn = turn * rotation;
      }
    }
  }
  return {{a[0][0], a[1][1], a[2][2]}, turn};
}

// What v^T A v, and b^T v, may be from rounding alone. The sums of the terms' absolute values count, so that
// little is lost where axes are along the coordinates and nothing cancels: quadrics may be long.
long double rounding_of(const lmat3& a, const lvec3& v) {
  long double sum = 0, largest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      sum += std::abs(v[i] * a[i][j] * v[j]);
      largest = std::max(largest, std::abs(a[i][j]));
    }
  }
  return nothing * sum + noise * largest;
}
long double rounding_of(const lvec3& b, const lvec3& v) {
  return nothing * glm::dot(glm::abs(b), glm::abs(v)) + noise * glm::length(b);
}

// Axis k last, the others in cyclic order.
Axes with_last(const Axes& axes, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return {{axes.value[i], axes.value[j], axes.value[k]}, {axes.turn[i], axes.turn[j], axes.turn[k]}};
}

// The axis last, and the first turned with it, reversed: still right-handed.
void reverse_last(Axes& axes) {
  axes.turn[1] = -axes.turn[1];
  axes.turn[2] = -axes.turn[2];
}

lmat4 rigid(const lmat3& turn, const lvec3& origin) {
  lmat4 frame(turn);
  frame[3] = {origin, 1};
  return frame;
}

using Result = std::variant<Quadric, std::string>;

// x^T A x + 2 b x + d = 0 with A of rank 3.
Result central(Axes axes, const lvec3& b, long double d) {
  const lvec3 in_axes = b * axes.turn;  // the transpose times b
  const lvec3 middle = -in_axes / axes.value;
  long double level = d + glm::dot(in_axes, middle);
  if (std::abs(level) <= nothing * (std::abs(d) + glm::length(in_axes) * glm::length(middle))) level = 0;
  int positive = 0;
  for (int k = 0; k < 3; ++k) positive += axes.value[k] > 0;
  const lvec3 origin = axes.turn * middle;
  if (positive < 2) {
    axes.value = -axes.value;
    level = -level;
    positive = 3 - positive;
  }
  if (positive == 3) {
    if (level > 0) return "an imaginary ellipsoid: no point satisfies its equation";
    if (level == 0) return "an imaginary cone: only its apex is real";
    return Quadric{QuadricKind::ellipsoid, glm::sqrt(-level / axes.value), rigid(axes.turn, origin)};
  }
  if (level == 0) return "an elliptic cone: it has an apex";
  int odd = 0;
  while (axes.value[odd] > 0) ++odd;
  const Axes sorted = with_last(axes, odd);
  const QuadricKind kind = level > 0 ? QuadricKind::two_sheets : QuadricKind::one_sheet;
  return Quadric{kind, glm::sqrt(glm::abs(level / sorted.value)), rigid(sorted.turn, origin)};
}

// A has rank 2; the axis of its zero is last.
Result along_axis(Axes axes, const lvec3& b, long double d) {
  const lvec3 in_axes = b * axes.turn;
  const bool alike = (axes.value[0] > 0) == (axes.value[1] > 0);
  const lvec3 middle(-in_axes[0] / axes.value[0], -in_axes[1] / axes.value[1], 0);
  const long double squares = glm::dot(in_axes, middle);
  long double level = d + squares;
  if (!(std::abs(in_axes[2]) > rounding_of(b, axes.turn[2]))) {
    if (std::abs(level) <= nothing * (std::abs(d) + std::abs(squares))) level = 0;
    if (level == 0) return alike ? "an imaginary pair of planes: a line" : "a pair of planes";
    if (!alike) return "a hyperbolic cylinder";
    return (axes.value[0] > 0) == (level > 0) ? "an imaginary cylinder: no point satisfies its equation"
                                              : "an elliptic cylinder";
  }
  const lvec3 vertex(middle[0], middle[1], -level / (2 * in_axes[2]));
  const lvec3 origin = axes.turn * vertex;
  // z = (x^2 value[0] + y^2 value[1]) / steepness; the first must come out positive.
  long double steepness = -2 * in_axes[2];
  if ((axes.value[0] > 0) != (steepness > 0)) {
    reverse_last(axes);
    steepness = -steepness;
  }
  const lvec3 semi_axes(std::sqrt(std::abs(steepness / axes.value[0])),
                        std::sqrt(std::abs(steepness / axes.value[1])), 1);
  const QuadricKind kind = alike ? QuadricKind::elliptic_paraboloid : QuadricKind::hyperbolic_paraboloid;
  return Quadric{kind, semi_axes, rigid(axes.turn, origin)};
}

Result flat(const Axes& axes, const lvec3& b) {
  const lvec3 in_axes = b * axes.turn;
  const auto counts = [&](int k) { return std::abs(in_axes[k]) > rounding_of(b, axes.turn[k]); };
  if (glm::length(axes.value) == 0) return "a plane or nothing: it has no square terms";
  return counts(0) || counts(1) ? "a parabolic cylinder" : "a pair of parallel planes";
}

}  // namespace

lmat4 matrix_of(const Quadric& quadric) {
  const lvec3 inverse = 1.0L / quadric.semi_axes;
  const lvec3 s = inverse * inverse;
  lmat4 m(0);
  const auto diagonal = [&](long double x, long double y, long double z, long double w) {
    m[0][0] = x * s.x, m[1][1] = y * s.y, m[2][2] = z * s.z, m[3][3] = w;
  };
  switch (quadric.kind) {
    case QuadricKind::ellipsoid:
      diagonal(1, 1, 1, -1);
      break;
    case QuadricKind::two_sheets:
      diagonal(1, 1, -1, 1);
      break;
    case QuadricKind::one_sheet:
      diagonal(1, 1, -1, -1);
      break;
    case QuadricKind::elliptic_paraboloid:
      diagonal(1, 1, 0, 0);
      m[2][3] = m[3][2] = -inverse.z / 2;
      break;
    case QuadricKind::hyperbolic_paraboloid:
      diagonal(1, -1, 0, 0);
      m[2][3] = m[3][2] = -inverse.z / 2;
      break;
  }
  const lmat4 back = glm::inverse(quadric.frame);
  return glm::transpose(back) * m * back;
}

std::variant<Quadric, std::string> classify(const lmat4& matrix) {
  const lmat3 square(matrix);
  const lvec3 b(matrix[3]);
  Axes axes = principal_axes(square);
  int zeros = 0, zero = 0, other = 0;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axes.value[k]) <= rounding_of(square, axes.turn[k])) {
      axes.value[k] = 0;
      ++zeros;
      zero = k;
    } else {
      other = k;
    }
  }
  if (zeros == 0) return central(axes, b, matrix[3][3]);
  if (zeros == 1) return along_axis(with_last(axes, zero), b, matrix[3][3]);
  return flat(with_last(axes, other), b);
}

lmat4 map_to(const Quadric& quadric) {
  const lvec3& s = quadric.semi_axes;
  // Rows of the map to the unit quadric, applied to (x, y, z, w).
  lmat4 rows(1);
  switch (quadric.kind) {
    case QuadricKind::ellipsoid:
    case QuadricKind::one_sheet:
      break;
    case QuadricKind::two_sheets:
      rows[2] = {0, 0, 0, 1};
      rows[3] = {0, 0, -1, 0};
      break;
    case QuadricKind::elliptic_paraboloid:
      rows[2] = {0, 0, 1, 1};
      rows[3] = {0, 0, -1, 1};
      break;
    case QuadricKind::hyperbolic_paraboloid:
      // On ruled_image y^2 - z^2 = (w - x) (w + x).
      rows[0] = {0, 1, 0, 0};
      rows[1] = {0, 0, 1, 0};
      rows[2] = {-1, 0, 0, 1};
      rows[3] = {1, 0, 0, 1};
      break;
  }
  lmat4 scale(1);
  for (int k = 0; k < 3; ++k) scale[k][k] = s[k];
  return quadric.frame * scale * glm::transpose(rows);
}

}  // namespace rondure
