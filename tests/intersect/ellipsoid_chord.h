// Where a line with double coordinates meets an ellipsoid, the image of the unit sphere under a matrix of
// doubles, in quadruple precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/intersect/ray.h"

namespace rondure {

struct EllipsoidChord {
  double clearance = 0.0;  // impact parameter - 1 in the unit sphere's space: negative when the line meets it
  double t[2] = {0.0, 0.0};  // entry and exit, when it does; each to a roundoff of itself and of the chord
  double cosine[2] = {0.0, 0.0};  // of the angles of incidence there, to some roundoffs of 1
};

class EllipsoidReference {
  using Quad = __float128;

 public:
  EllipsoidReference(const dmat3& linear, const dvec3& center) : center_(center) {
    // The adjugate over the determinant: 113 bits less what the matrix's condition takes.
    Quad m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = linear[j][i];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        inverse_[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
      }
    const Quad determinant = m[0][0] * inverse_[0][0] + m[0][1] * inverse_[1][0] + m[0][2] * inverse_[2][0];
    double norm2 = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        inverse_[i][j] /= determinant;
        rounded_[j][i] = static_cast<double>(inverse_[i][j]);
        norm2 += rounded_[j][i] * rounded_[j][i];
      }
    shrinking_ = std::sqrt(norm2);
    for (int j = 0; j < 3; ++j) extent_ += glm::dot(linear[j], linear[j]);
    extent_ = std::sqrt(extent_);
  }

  EllipsoidChord chord(const dvec3& origin, const dvec3& direction) const {
    Quad q[3], d[3];
    to_unit_space(origin, direction, q, d);
    const Quad dd = dot(d, d), middle = -dot(q, d) / dd;
    Quad impact2 = 0;
    dvec3 nearest, along;
    for (int i = 0; i < 3; ++i) {
      const Quad x = q[i] + middle * d[i];
      impact2 += x * x;
      nearest[i] = static_cast<double>(x), along[i] = static_cast<double>(d[i]);
    }
    EllipsoidChord out;
    out.clearance = static_cast<double>(impact2 - 1) / (1.0 + std::sqrt(static_cast<double>(impact2)));
    if (!(impact2 < 1)) return out;
    const double half = std::sqrt(static_cast<double>((1 - impact2) / dd));
    for (int k = 0; k < 2; ++k) {
      const double way = k == 0 ? -half : half;
      out.t[k] = static_cast<double>(middle + static_cast<Quad>(way));
      // The gradient there; its product with the direction is the half chord's, whatever cancels in the sum.
      const dvec3 gradient = (nearest + way * along) * rounded_;
      out.cosine[k] = half * static_cast<double>(dd) / (glm::length(gradient) * glm::length(direction));
    }
    return out;
  }

  // How deep in it the points o + t d are at most, t in [0, end], as 1 - |x| in the unit sphere's space.
  // Finite ends only, unless the ray leaves it.
  double depth(const dvec3& origin, const dvec3& direction, double end) const {
    Quad q[3], d[3];
    to_unit_space(origin, direction, q, d);
    const Quad dd = dot(d, d), middle = -dot(q, d) / dd;
    const Quad t = std::clamp<Quad>(middle, 0, end);
    for (int i = 0; i < 3; ++i) q[i] += t * d[i];
    return below_surface(q);
  }
  // And at t alone.
  double depth_at(const dvec3& origin, const dvec3& direction, double t) const {
    Quad q[3], d[3];
    to_unit_space(origin, direction, q, d);
    for (int i = 0; i < 3; ++i) q[i] += static_cast<Quad>(t) * d[i];
    return below_surface(q);
  }

  // Largest distance from the centre, at most sqrt(3) times too large.
  double extent() const { return extent_; }
  // By how much lengths grow, at most, on the way to the unit sphere's space.
  double shrinking() const { return shrinking_; }
  // Unit and outward, at a point of the surface.
  dvec3 normal(const dvec3& point) const { return glm::normalize((rounded_ * (point - center_)) * rounded_); }

 private:
  static Quad dot(const Quad* a, const Quad* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  // b - 1 is (b^2 - 1) / (b + 1): near the surface nothing is left of b - 1 itself.
  static double below_surface(const Quad* x) {
    const Quad norm2 = dot(x, x);
    return static_cast<double>(1 - norm2) / (1.0 + std::sqrt(static_cast<double>(norm2)));
  }
  void to_unit_space(const dvec3& origin, const dvec3& direction, Quad* q, Quad* d) const {
    for (int i = 0; i < 3; ++i) {
      q[i] = d[i] = 0;
      for (int j = 0; j < 3; ++j) {
        q[i] += inverse_[i][j] * (static_cast<Quad>(origin[j]) - static_cast<Quad>(center_[j]));
        d[i] += inverse_[i][j] * static_cast<Quad>(direction[j]);
      }
    }
  }

  dvec3 center_;
  Quad inverse_[3][3];
  dmat3 rounded_;  // the same in doubles
  double extent_ = 0.0, shrinking_ = 0.0;
};

}  // namespace rondure
