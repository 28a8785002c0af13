// Where a line with double coordinates meets an ellipsoid, the image of the unit sphere under a matrix of
// doubles, in quadruple precision; or in the 64 bits of long double, whose rounding is 2^-11 of double's,
// many times faster: for very many lines, where what is asked for is known to double's rounding only.
#pragma once

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

template <class Real>
class EllipsoidIn {
 public:
  EllipsoidIn(const dmat3& linear, const dvec3& center) : center_(center) {
    // The adjugate over the determinant: all bits less what the matrix's condition takes.
    Real m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = linear[j][i];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        inverse_[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
      }
    const Real determinant = m[0][0] * inverse_[0][0] + m[0][1] * inverse_[1][0] + m[0][2] * inverse_[2][0];
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

  // A ray in the unit sphere's space, q + t d, and where it is nearest to the centre.
  class Line {
   public:
    EllipsoidChord chord() const {
      EllipsoidChord out;
      out.clearance = -below_surface(impact2_);
      if (!(impact2_ < 1)) return out;
      dvec3 nearest, along;
      for (int i = 0; i < 3; ++i)
        nearest[i] = static_cast<double>(nearest_[i]), along[i] = static_cast<double>(d_[i]);
      const double half = std::sqrt(static_cast<double>((1 - impact2_) / dd_));
      for (int k = 0; k < 2; ++k) {
        const double way = k == 0 ? -half : half;
        out.t[k] = static_cast<double>(middle_ + static_cast<Real>(way));
        // The gradient there; its product with the direction is the half chord's, whatever cancels.
        const dvec3 gradient = (nearest + way * along) * ellipsoid_->rounded_;
        out.cosine[k] = half * static_cast<double>(dd_) / (glm::length(gradient) * length_);
      }
      return out;
    }

    // How deep in it the points q + t d are at most, t in [0, end], as 1 - |x| in the unit sphere's space.
    // Finite ends only, unless the ray leaves it.
    double depth(double end) const {
      if (middle_ <= 0) return depth_at(0.0);
      return middle_ < end ? below_surface(impact2_) : depth_at(end);
    }
    // And at t alone.
    double depth_at(double t) const {
      if (t == 0.0) return below_surface(dot(q_, q_));
      Real x[3];
      for (int i = 0; i < 3; ++i) x[i] = q_[i] + static_cast<Real>(t) * d_[i];
      return below_surface(dot(x, x));
    }

   private:
    friend class EllipsoidIn;
    Line() = default;

    const EllipsoidIn* ellipsoid_ = nullptr;
    double length_ = 0.0;  // of the direction, in space
    Real q_[3], d_[3], dd_, middle_, nearest_[3], impact2_;
  };

  // It must not outlive the ellipsoid.
  Line line(const dvec3& origin, const dvec3& direction) const {
    Line out;
    out.ellipsoid_ = this, out.length_ = glm::length(direction);
    for (int i = 0; i < 3; ++i) {
      out.q_[i] = out.d_[i] = 0;
      for (int j = 0; j < 3; ++j) {
        if (inverse_[i][j] == 0) continue;  // most, of spheres: a product takes its time
        out.q_[i] += inverse_[i][j] * (static_cast<Real>(origin[j]) - static_cast<Real>(center_[j]));
        out.d_[i] += inverse_[i][j] * static_cast<Real>(direction[j]);
      }
    }
    out.dd_ = dot(out.d_, out.d_), out.middle_ = -dot(out.q_, out.d_) / out.dd_;
    for (int i = 0; i < 3; ++i) out.nearest_[i] = out.q_[i] + out.middle_ * out.d_[i];
    out.impact2_ = dot(out.nearest_, out.nearest_);
    return out;
  }
  EllipsoidChord chord(const dvec3& origin, const dvec3& direction) const {
    return line(origin, direction).chord();
  }

  // Largest distance from the centre, at most sqrt(3) times too large.
  double extent() const { return extent_; }
  // By how much lengths grow, at most, on the way to the unit sphere's space.
  double shrinking() const { return shrinking_; }
  // Unit and outward, at a point of the surface.
  dvec3 normal(const dvec3& point) const { return glm::normalize((rounded_ * (point - center_)) * rounded_); }

 private:
  static Real dot(const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  // 1 - b is (1 - b^2) / (1 + b), where b^2 is |x|^2: near the surface nothing is left of 1 - b itself.
  static double below_surface(Real norm2) {
    return static_cast<double>(1 - norm2) / (1.0 + std::sqrt(static_cast<double>(norm2)));
  }

  dvec3 center_;
  Real inverse_[3][3];
  dmat3 rounded_;  // the same in doubles
  double extent_ = 0.0, shrinking_ = 0.0;
};

using EllipsoidReference = EllipsoidIn<__float128>;

}  // namespace rondure
