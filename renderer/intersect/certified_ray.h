// Control points seen along a ray, with a bound on what rounding has done to them.
//
// Every bound here counts units of roundoff of T (double or long double) of the terms that were added, under
// rounding to nearest, and takes twice of what it counts: the bound's own arithmetic rounds too.
#pragma once

#include <cmath>
#include <limits>

#include "renderer/intersect/local_ray.h"

namespace rondure {

// f and g vanish on the ray; h / w is s |direction|^2, where s counts directions from the ray's base.
template <class T>
struct RayPoint {
  T f = 0, g = 0, h = 0, w = 0;

  friend RayPoint operator+(const RayPoint& a, const RayPoint& b) {
    return {a.f + b.f, a.g + b.g, a.h + b.h, a.w + b.w};
  }
  friend RayPoint operator-(const RayPoint& a, const RayPoint& b) {
    return {a.f - b.f, a.g - b.g, a.h - b.h, a.w - b.w};
  }
  friend RayPoint operator*(T s, const RayPoint& a) { return {s * a.f, s * a.g, s * a.h, s * a.w}; }
};

template <class T>
RayPoint<T> abs_max(const RayPoint<T>& a, const RayPoint<T>& b) {
  return {std::max(a.f, std::abs(b.f)), std::max(a.g, std::abs(b.g)), std::max(a.h, std::abs(b.h)),
          std::max(a.w, std::abs(b.w))};
}

// Half an ulp of 1.
template <class T>
inline constexpr T roundoff = std::numeric_limits<T>::epsilon() / 2;

template <class T>
class CertifiedRay {
 public:
  // Of a ray whose local form is at hand: its direction and slide are exact choices, its base is made anew.
  CertifiedRay(const dvec3& origin, const dvec3& frame, const LocalRay& local) {
    T size = 0;
    for (int k = 0; k < 3; ++k) {
      d_[k] = local.direction[k];
      const TwoFold offset = two_sum(origin[k], -frame[k]);
      const TwoFold step = two_product(halves(local.slide), halves(local.direction[k]));
      const TwoFold sum = two_sum(offset.high, step.high);
      base_[k] = static_cast<T>(sum.high) +
                 (static_cast<T>(sum.low) + (static_cast<T>(offset.low) + static_cast<T>(step.low)));
      // The three tails are below an ulp of the summands; their sums round at that size.
      base_error_ =
          std::max(base_error_, 4 * roundoff<T> * std::abs(base_[k]) +
                                    static_cast<T>(0x1p-102) * std::abs(static_cast<T>(offset.high)));
      size = std::max(size, std::abs(base_[k]));
    }
    // Two normals that are at right angles to the direction without rounding: its components, exchanged. With
    // the largest in both, they are 60 degrees apart at least.
    for (int k = 1; k < 3; ++k)
      if (std::abs(d_[k]) > std::abs(d_[big_])) big_ = k;
    for (int j = 0; j < 2; ++j) {
      const int other = (big_ + 1 + j) % 3;
      offset_[j] = d_[big_] * base_[other] - d_[other] * base_[big_];
    }
    offset_[2] = d_[0] * base_[0] + d_[1] * base_[1] + d_[2] * base_[2];
    length2_ = d_[0] * d_[0] + d_[1] * d_[1] + d_[2] * d_[2];
    // |d| <= 2 in each component; the offsets: two or three products, and the base's own error times |d|.
    offset_error_ = 2 * (6 * base_error_ + 16 * roundoff<T> * size);
  }

  RayPoint<T> operator()(const dvec4& p) const {
    const T x[3] = {p.x, p.y, p.z}, w = p.w;
    const int a = (big_ + 1) % 3, b = (big_ + 2) % 3;
    return {(d_[big_] * x[a] - d_[a] * x[big_]) - offset_[0] * w,
            (d_[big_] * x[b] - d_[b] * x[big_]) - offset_[1] * w,
            (d_[0] * x[0] + d_[1] * x[1] + d_[2] * x[2]) - offset_[2] * w, w};
  }

  // Bound on the error of f, g and h of such a point; w is exact.
  T error(const dvec4& p) const {
    const T x = largest(dvec3(p)), w = std::abs(static_cast<T>(p.w));
    T most = 0;
    for (const T o : offset_) most = std::max(most, std::abs(o));
    return 2 * (roundoff<T> * (24 * x + 3 * most * w) + offset_error_ * w);
  }

  // Bound on how far from the ray, times its weight, a point is whose f and g are within `error` of these:
  // the length of its cross product with the direction, of which they are two components, over the
  // direction's.
  T distance(const RayPoint<T>& p, T error) const {
    const int a = (big_ + 1) % 3, b = (big_ + 2) % 3;
    const T third = (d_[a] * p.g - d_[b] * p.f) / d_[big_];
    return (std::hypot(p.f, p.g, third) / std::sqrt(length2_) + 3 * error) * (1 + 16 * roundoff<T>);
  }

  T length2() const { return length2_; }
  const T* base() const { return base_; }
  const T* direction() const { return d_; }
  T base_error() const { return base_error_; }

 private:
  T d_[3], base_[3], offset_[3], length2_ = 1, base_error_ = 0, offset_error_ = 0;
  int big_ = 0;
};

}  // namespace rondure
