// Proofs about a ray and one patch: that a root exists, and that none comes earlier.
//
// With Y an approximate inverse of the mean Jacobian of F = (f, g) on a piece and rho >= |1 - Y J| all
// over the piece (row sums, from the Bernstein coefficients of J), every root r in the piece and every p of
// it have |p - r| <= |Y F(p)| / (1 - rho). So there is one root at most, and it is within that ball about p;
// and if the ball lies in the piece, there is one: p - Y F maps the ball into itself (Krawczyk 1969).
#pragma once

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/intersect/certified_net.h"
#include "renderer/intersect/enclosure.h"

namespace rondure {

// The one root that a piece can have: within `radius` of `at`, in the piece's parameters.
struct Ball {
  dvec2 at{0.0};
  double radius = 0.0;
};

// Bounds, component by component, of |derivative by a| + |derivative by b| all over the piece.
template <class T>
RayPoint<T> slope_of(const CertifiedPiece<T>& piece) {
  RayPoint<T> out;
  for (int k = 0; k < 2; ++k) {
    RayPoint<T> most;
    piece.for_derivative(k, [&](const RayPoint<T>& d) { most = abs_max(most, d); });
    out = out + most;
  }
  const T error = 2 * piece.derivative_error();
  return out + RayPoint<T>{error, error, error, error};
}

// Y = inverse of J, and what is left of F and J when it is applied.
template <class T>
class Preconditioned {
 public:
  explicit Preconditioned(const CertifiedPiece<T>& piece) : piece_(piece) {
    // Any Y will do; this one is from the means of the derivatives' coefficients.
    RayPoint<T> mean[2];
    for (int k = 0; k < 2; ++k) {
      int count = 0;
      piece.for_derivative(k, [&](const RayPoint<T>& d) { mean[k] = mean[k] + d, ++count; });
      mean[k] = (T(1) / static_cast<T>(count)) * mean[k];
    }
    const T det = mean[0].f * mean[1].g - mean[0].g * mean[1].f;
    const T size = std::abs(mean[0].f * mean[1].g) + std::abs(mean[0].g * mean[1].f);
    if (!(std::abs(det) > 64 * roundoff<T> * size)) return;
    y_[0][0] = mean[1].g / det, y_[0][1] = -mean[1].f / det;
    y_[1][0] = -mean[0].g / det, y_[1][1] = mean[0].f / det;
    for (int j = 0; j < 2; ++j) {
      row_[j] = std::abs(y_[j][0]) + std::abs(y_[j][1]);
      if (!std::isfinite(row_[j])) return;
    }
    good_ = true;
  }

  explicit operator bool() const { return good_; }

  // Component j of Y F, and how far rounding and `error` of F may have put it off.
  T apply(int j, const RayPoint<T>& f) const { return y_[j][0] * f.f + y_[j][1] * f.g; }
  T slack(int j, T error) const { return row_[j] * (error + 4 * roundoff<T> * piece_.largest_coefficient()); }

  // Whether a component of Y F keeps one sign over the piece.
  bool keeps_sign() const {
    for (int j = 0; j < 2; ++j) {
      const T slack_j = slack(j, piece_.error);
      bool above = true, below = true;
      for (const RayPoint<T>& c : piece_.c) {
        const T value = apply(j, c);
        above = above && value > slack_j, below = below && value < -slack_j;
      }
      if (above || below) return true;
    }
    return false;
  }

  // rho.
  T distance_from_identity() const {
    T rows[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
      T most[2] = {0, 0};
      piece_.for_derivative(k, [&](const RayPoint<T>& d) {
        for (int j = 0; j < 2; ++j)
          most[j] = std::max(most[j], std::abs(apply(j, d) - (j == k ? T(1) : T(0))));
      });
      for (int j = 0; j < 2; ++j) rows[j] += most[j] + slack(j, piece_.derivative_error()) + 4 * roundoff<T>;
    }
    return std::max(rows[0], rows[1]);
  }

  // The ball that holds the piece's root, if there is one; rho < 1/2.
  Ball locate() const {
    Ball ball{piece_.middle(), 0.0};
    T best = std::numeric_limits<T>::infinity();
    dvec2 p = ball.at;
    for (int k = 0; k < 24; ++k) {
      const RayPoint<T> f = piece_.value(p);
      const T step[2] = {apply(0, f), apply(1, f)};
      const T size = std::max(std::abs(step[0]), std::abs(step[1]));
      if (!(size < best / 2)) break;
      best = size, ball.at = p;
      p = clamp(p - dvec2(static_cast<double>(step[0]), static_cast<double>(step[1])));
    }
    const T off = best + std::max(slack(0, piece_.value_error()), slack(1, piece_.value_error()));
    ball.radius = static_cast<double>(off) * 2.0 * (1.0 + 0x1p-40);
    return ball;
  }

 private:
  const CertifiedPiece<T>& piece_;
  T y_[2][2] = {{0, 0}, {0, 0}}, row_[2] = {0, 0};
  bool good_ = false;

  dvec2 clamp(dvec2 p) const {
    p = dvec2(std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0));
    if (piece_.shape.triangle && p.x + p.y > 1.0) p /= (p.x + p.y) * (1.0 + 0x1p-50);
    return p;
  }
};

// Range of s, times |direction|^2, over the piece; everything where a weight may not be positive.
template <class T>
Enclosure<T> range_of_h(const CertifiedPiece<T>& piece) {
  T low = std::numeric_limits<T>::infinity(), high = -low;
  for (const RayPoint<T>& c : piece.c) {
    if (!(c.w > 2 * piece.error)) return Enclosure<T>::everything();
    const Enclosure<T> s = Enclosure<T>::about(c.h, piece.error) / Enclosure<T>::about(c.w, piece.error);
    low = std::min(low, s.low), high = std::max(high, s.high);
  }
  return {low, high};
}

// The same over a ball in it.
template <class T>
Enclosure<T> range_of_h(const CertifiedPiece<T>& piece, const Ball& ball) {
  const RayPoint<T> at = piece.value(ball.at), slope = slope_of(piece);
  const T error = piece.value_error(), r = static_cast<T>(ball.radius) * (1 + 8 * roundoff<T>);
  const T w_error = error + r * slope.w;
  if (!(at.w > 2 * w_error)) return Enclosure<T>::everything();
  // s = h / w moves by (|h'| + |s| |w'|) / w along the way; the mean value over the ball.
  const Enclosure<T> w = Enclosure<T>::about(at.w, w_error);
  const Enclosure<T> here = Enclosure<T>::about(at.h, error) / Enclosure<T>::about(at.w, error);
  const T s = here.magnitude() + 2 * r * (slope.h + here.magnitude() * slope.w) / w.low;
  return here + Enclosure<T>::about(T(0), 2 * r * (slope.h + s * slope.w) / w.low);
}

// What the search for roots before `until` found; all of them in the units of range_of_h.
template <class T>
struct Earlier {
  bool decided = true;                           // false: somewhere no proof came out within the limits
  bool possible = false;                         // a root before `until` was not excluded
  T least = std::numeric_limits<T>::infinity();  // the least that roots not before `until` may have
  long pieces = 0;
};

// Looks for roots with s in [from, until). `tight`: until what it says of later ones is close to `until`,
// too.
template <class T>
class EarlierSearch {
 public:
  EarlierSearch(T from, T until, long limit, bool tight)
      : from_(from), until_(until), limit_(limit), tight_(tight) {}

  const Earlier<T>& run(const CertifiedPiece<T>& whole) {
    std::vector<CertifiedPiece<T>> stack{whole};
    CertifiedPiece<T> low, high;
    while (!stack.empty()) {
      if (++out_.pieces > limit_) {
        out_.decided = false;
        break;
      }
      const CertifiedPiece<T> piece = std::move(stack.back());
      stack.pop_back();
      if (settled(piece)) continue;
      piece.halve(steepest(piece), low, high);
      stack.push_back(std::move(low)), stack.push_back(std::move(high));
    }
    return out_;
  }

 private:
  const T from_, until_;
  const long limit_;
  const bool tight_;
  Earlier<T> out_;

  bool settled(const CertifiedPiece<T>& piece) {
    if (keeps_sign(piece)) return true;
    const Enclosure<T> s = range_of_h(piece);
    if (s.low >= until_ || s.high < from_) return true;
    const Preconditioned<T> y(piece);
    if (y) {
      if (y.keeps_sign()) return true;
      if (y.distance_from_identity() < T(0.5)) {
        const Ball ball = y.locate();
        if (ball.radius < 0x1p-10) {
          const Enclosure<T> at = range_of_h(piece, ball);
          if (at.high < from_) return true;
          // Beside the border of a large piece a ball may be large, and say little of t: smaller pieces say
          // more, or that no root is there.
          if (at.high >= until_ && (!tight_ || small(piece) || near_until(at.low))) {
            out_.least = std::min(out_.least, at.low);
            return true;
          }
          // A root that is earlier, if its ball is in the piece; else its existence is the border's matter.
          if (at.high < until_ && (piece.outside(ball.at) < -ball.radius || ball.radius < 0x1p-30)) {
            out_.possible = true;
            return true;
          }
        }
      }
    }
    // Nothing but rounding is left of F.
    const RayPoint<T> size = piece.magnitude();
    if (std::max(size.f, size.g) > 4 * piece.error) return false;
    if (s.high >= until_ && s.high - s.low < T(1e-6) * (std::abs(until_) + 1))
      out_.least = std::min(out_.least, s.low);
    else
      out_.decided = false;
    return true;
  }

  bool near_until(T s) const { return until_ - s <= T(0x1p-40) * (std::abs(until_) + 1); }
  static bool small(const CertifiedPiece<T>& piece) {
    return std::max({std::fabs(piece.along_a.x), std::fabs(piece.along_a.y), std::fabs(piece.along_b.x),
                     std::fabs(piece.along_b.y)}) < 0x1p-24;
  }

  static bool keeps_sign(const CertifiedPiece<T>& piece) {
    bool keeps[4] = {true, true, true, true};
    for (const RayPoint<T>& c : piece.c) {
      keeps[0] = keeps[0] && c.f > piece.error, keeps[1] = keeps[1] && c.f < -piece.error;
      keeps[2] = keeps[2] && c.g > piece.error, keeps[3] = keeps[3] && c.g < -piece.error;
    }
    return keeps[0] || keeps[1] || keeps[2] || keeps[3];
  }

  static int steepest(const CertifiedPiece<T>& piece) {
    int best = 0;
    T most = -1;
    for (int edge = 0; edge < piece.shape.edges(); ++edge) {
      T change = 0;
      piece.shape.for_lines(edge, [&](const int* places, int count) {
        for (int k = 1; k < count; ++k) {
          const RayPoint<T> d =
              piece.c[static_cast<std::size_t>(places[k])] - piece.c[static_cast<std::size_t>(places[k - 1])];
          change = std::max({change, std::abs(d.f), std::abs(d.g)});
        }
      });
      if (change > most) most = change, best = edge;
    }
    return best;
  }
};

// The piece about a place of the patch, `reach` to each side (a triangle with the greater inscribed); it may
// lie partly outside.
template <class T>
CertifiedPiece<T> piece_about(const CertifiedPiece<T>& whole, dvec2 at, dvec2 reaches) {
  CertifiedPiece<T> out = whole;
  const double reach = std::max(reaches.x, reaches.y);
  out.origin = at - (whole.shape.triangle ? dvec2(reach) : reaches);
  if (whole.shape.triangle) {
    out.along_a = dvec2(4.0 * reach, 0.0), out.along_b = dvec2(0.0, 4.0 * reach);
    const dvec2 corners[3] = {out.origin + out.along_a, out.origin + out.along_b, out.origin};
    triangle_restrict(whole.c.data(), whole.shape.n, corners, out.c.data());
  } else {
    out.along_a = dvec2(2.0 * reaches.x, 0.0), out.along_b = dvec2(0.0, 2.0 * reaches.y);
    tensor_restrict(whole.c.data(), whole.shape.m, whole.shape.n, out.origin.x,
                    out.origin.x + 2.0 * reaches.x, out.origin.y, out.origin.y + 2.0 * reaches.y,
                    out.c.data());
  }
  // Two or three passes of affine combinations, by factors below 1 + 8 reach in all, at parameters that are
  // off by rounding themselves.
  const T growth =
      std::pow(1 + 8 * static_cast<T>(reach), static_cast<T>(2 * (whole.shape.m + whole.shape.n)));
  out.error = growth * (whole.error +
                        32 * (whole.shape.m + whole.shape.n) * roundoff<T> * whole.largest_coefficient());
  return out;
}

// Where the root next to (u, v) is.
template <class T>
struct Existence {
  bool exists = false;     // in the patch, or the polynomials' extension past its boundary
  bool inside = false;     // in the patch itself
  Ball ball;               // in the patch's parameters
  double isolation = 0.0;  // no other root has both parameters as near as this to (u, v)
  Enclosure<T> h;          // as range_of_h
};

template <class T>
Existence<T> prove_root_in(const CertifiedPiece<T>& whole, dvec2 at, dvec2 reach) {
  Existence<T> out;
  const CertifiedPiece<T> piece = piece_about(whole, at, reach);
  const Preconditioned<T> y(piece);
  if (!y || !(y.distance_from_identity() < T(0.5))) return out;
  const Ball ball = y.locate();
  if (!(piece.outside(ball.at) < -ball.radius)) return out;
  out.exists = true;
  out.isolation = std::min(reach.x, reach.y);
  out.h = range_of_h(piece, ball);
  out.ball.at = piece.to_patch(ball.at);
  out.ball.radius = ball.radius * std::max(piece.along_a.x, piece.along_b.y) + 0x1p-50;
  out.inside = whole.outside(out.ball.at) < -2.0 * out.ball.radius;
  return out;
}

template <class T>
Existence<T> prove_root(const CertifiedPiece<T>& whole, dvec2 at) {
  for (double reach = 0x1p-6; reach > 0x1p-48; reach *= 0.25)
    if (const Existence<T> out = prove_root_in(whole, at, dvec2(reach)); out.exists) return out;
  // Beside a side that is a point, where the parameter along it is hardly told apart: wide along the side,
  // and no nearer to it than half the way. In double precision little would come of that.
  if (whole.shape.triangle || std::is_same_v<T, double>) return {};
  const dvec2 to_side = glm::min(at, dvec2(1.0) - at);
  for (const int across : {0, 1}) {
    if (!(to_side[across] > 0.0)) continue;
    for (double reach = 0x1p-4; reach > 0x1p-30; reach *= 0.25)
      for (const double part : {0.5, 0.125}) {
        dvec2 reaches(reach);
        reaches[across] = std::min(reach, part * to_side[across]);
        Existence<T> out = prove_root_in(whole, at, reaches);
        if (!out.exists) continue;
        // The piece that it is in, if not the ball, is all inside.
        out.inside = out.inside || reach < to_side[1 - across];
        return out;
      }
  }
  return {};
}

}  // namespace rondure
