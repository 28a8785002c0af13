// Three coordinates of one ray, side by side in lanes where there are four of them: the same operations in
// the same order as on each alone. Included inside the namespace of an instruction set, with `hn` for
// Highway's own; hence no guard and no include.

#if HWY_MAX_BYTES >= 32

class Triple {
  using D = hn::FixedTag<double, 4>;
  using V = hn::Vec<D>;

 public:
  explicit HWY_INLINE Triple(V v) : v_(v) {}
  explicit HWY_INLINE Triple(double x) : v_(hn::Set(D(), x)) {}
  // From four numbers, of which the last is not used.
  static HWY_INLINE Triple of_four(const double* x) { return Triple(hn::LoadU(D(), x)); }

  friend HWY_INLINE Triple operator+(Triple a, Triple b) { return Triple(a.v_ + b.v_); }
  friend HWY_INLINE Triple operator-(Triple a, Triple b) { return Triple(a.v_ - b.v_); }
  friend HWY_INLINE Triple operator*(Triple a, Triple b) { return Triple(a.v_ * b.v_); }
  // a b - c, rounded once.
  friend HWY_INLINE Triple fused(Triple a, Triple b, Triple c) {
    return Triple(hn::MulSub(a.v_, b.v_, c.v_));
  }
  friend HWY_INLINE double dot(Triple a, Triple b) {
    const Triple p = a * b;
    return (p.x() + p.y()) + p.z();
  }

  HWY_INLINE double x() const { return hn::GetLane(v_); }
  HWY_INLINE double y() const { return hn::GetLane(hn::Shuffle01(hn::LowerHalf(v_))); }
  HWY_INLINE double z() const { return hn::GetLane(hn::UpperHalf(hn::Half<D>(), v_)); }
  HWY_INLINE dvec3 vector() const { return {x(), y(), z()}; }

 private:
  V v_;
};

#else

class Triple {
 public:
  explicit HWY_INLINE Triple(double x) : v_(x) {}
  explicit HWY_INLINE Triple(const dvec3& x) : v_(x) {}
  static HWY_INLINE Triple of_four(const double* x) { return Triple(dvec3(x[0], x[1], x[2])); }

  friend HWY_INLINE Triple operator+(Triple a, Triple b) { return Triple(a.v_ + b.v_); }
  friend HWY_INLINE Triple operator-(Triple a, Triple b) { return Triple(a.v_ - b.v_); }
  friend HWY_INLINE Triple operator*(Triple a, Triple b) { return Triple(a.v_ * b.v_); }
  friend HWY_INLINE Triple fused(Triple a, Triple b, Triple c) {
    return Triple(dvec3(std::fma(a.x(), b.x(), -c.x()), std::fma(a.y(), b.y(), -c.y()),
                        std::fma(a.z(), b.z(), -c.z())));
  }
  friend HWY_INLINE double dot(Triple a, Triple b) { return glm::dot(a.v_, b.v_); }

  HWY_INLINE double x() const { return v_.x; }
  HWY_INLINE double y() const { return v_.y; }
  HWY_INLINE double z() const { return v_.z; }
  HWY_INLINE dvec3 vector() const { return v_; }

 private:
  dvec3 v_;
};

#endif
