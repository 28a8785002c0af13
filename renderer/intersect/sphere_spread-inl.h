// The step of sphere_kernel-inl.h for one ray: the polynomials' coefficients side by side in lanes, the same
// operations in the same order on each. Included inside the namespace of an instruction set, after the kernel
// and with `hn` for Highway's own; hence no guard and no include.

#if HWY_TARGET == HWY_SCALAR

template <int K>
class Spread {
 public:
  HWY_INLINE Spread(const PatchInverse& inverse, double x, double y, double w) {
    residual_of<K>(inverse.coefficients.data(), x, y, w, c_, same);
  }
  HWY_INLINE Stride<double> step(double& u, double& v) const { return step_towards_zero<K>(c_, u, v, same); }

 private:
  static double same(double q) { return q; }
  Residual<K, double> c_;
};

#else

// Lane 2 i + part: the real (part 0) or imaginary part of the coefficient of u^i.
template <int K>
class Spread {
  using D = hn::CappedTag<double, 8>;
  using Pairs = hn::FixedTag<double, 2>;
  using V = hn::Vec<D>;
  using Pair = hn::Vec<Pairs>;
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D())), used = (2 * (K + 1) + lanes - 1) / lanes,
                       stride = K == 2 ? 8 : 16;

 public:
  HWY_INLINE Spread(const PatchInverse& inverse, double x, double y, double w) {
    const D d;
    const V vx = hn::Set(d, x), vy = hn::Set(d, y), vw = hn::Set(d, w);
    const double* q = inverse.spread.data();
    for (int j = 0; j <= K; ++j)
      for (int k = 0; k < used; ++k) {
        const double* at = q + j * stride + k * lanes;
        c_[j][k] = (vw * hn::Load(d, at) - vx * hn::Load(d, at + (K + 1) * stride)) +
                   vy * hn::Load(d, at + 2 * (K + 1) * stride);
      }
  }

  HWY_INLINE Stride<double> step(double& u, double& v) const {
    const Pairs d2;
    const V vv = hn::Set(D(), v);
    V all_rows[used], all_slopes[used], all_bends[used];
    for (int k = 0; k < used; ++k) {
      V row = c_[K][k] * vv + c_[K - 1][k], slope = c_[K][k] * vv + row, bend = c_[K][k];
      row = row * vv + c_[K - 2][k];
      for (int j = K - 3; j >= 0; --j) {
        bend = bend * vv + slope;
        slope = slope * vv + row;
        row = row * vv + c_[j][k];
      }
      all_rows[k] = row, all_slopes[k] = slope, all_bends[k] = bend;
    }
    Pair rows[K + 1], slopes[K + 1], bends[K + 1];
    split(all_rows, rows), split(all_slopes, slopes), split(all_bends, bends);
    const Pair pu = hn::Set(d2, u);
    Pair value = rows[K] * pu + rows[K - 1], along = rows[K] * pu + value, curve = rows[K];
    Pair across = slopes[K] * pu + slopes[K - 1], twist = slopes[K], sag = bends[K] * pu + bends[K - 1];
    value = value * pu + rows[K - 2];
    for (int i = K - 2;; --i) {
      twist = twist * pu + across;
      across = across * pu + slopes[i];
      sag = sag * pu + bends[i];
      if (i == 0) break;
      curve = curve * pu + along;
      along = along * pu + value;
      value = value * pu + rows[i - 1];
    }
    // Determinants two at a time: of (along, across), and of either with the value.
    const double r = 1.0 / determinant(along, across);
    const double move_u = r * determinant(value, across), move_v = r * determinant(along, value);
    const Pair mu = hn::Set(d2, move_u), mv = hn::Set(d2, move_v);
    const Pair bent = (curve * mu + twist * mv) * mu + (sag * mv) * mv;
    const double more_u = r * determinant(bent, across), more_v = r * determinant(along, bent);
    u = u - (move_u + more_u), v = v - (move_v + more_v);
    return {move_u * move_u + move_v * move_v, more_u * more_u + more_v * more_v,
            (r * r) * (square(along) + square(across))};
  }

 private:
  static HWY_INLINE double first(Pair p) { return hn::GetLane(p); }
  static HWY_INLINE double second(Pair p) { return hn::GetLane(hn::Shuffle01(p)); }
  // a[0] b[1] - a[1] b[0].
  static HWY_INLINE double determinant(Pair a, Pair b) {
    const Pair p = a * hn::Shuffle01(b);
    return first(p) - second(p);
  }
  static HWY_INLINE double square(Pair a) {
    const Pair p = a * a;
    return first(p) + second(p);
  }

  template <int I = 0>
  static HWY_INLINE void split(const V* all, Pair* out) {
    out[I] = pair<(2 * I % lanes) / 2>(all[2 * I / lanes]);
    if constexpr (I < K) split<I + 1>(all, out);
  }
  template <int I, class W>
  static HWY_INLINE Pair pair(W v) {
    constexpr int size = static_cast<int>(hn::MaxLanes(hn::DFromV<W>()));
    if constexpr (size == 2)
      return v;
    else if constexpr (4 * I < size)
      return pair<I>(hn::LowerHalf(v));
    else
      return pair<I - size / 4>(hn::UpperHalf(hn::Half<hn::DFromV<W> >(), v));
  }

  V c_[K + 1][used];
};

#endif
