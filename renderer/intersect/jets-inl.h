// Patches and their derivatives in the arithmetic of a kind K (newton_arithmetic-inl.h). Included inside the
// namespace of an instruction set, which INLINE_FOR_THIS_SET names; hence no guard and no include.

template <class K>
using Number = typename K::Number;

// The patch with its derivatives by (u, v).
template <class K>
struct PointJet {
  typename K::Point value, du, dv;
};
template <class K>
struct PointBend {
  PointJet<K> first;
  typename K::Point duu, duv, dvv;
};

// As bernstein_values.
template <int N, class K>
INLINE_FOR_THIS_SET void basis_of(int n, Number<K> t, Number<K>* out) {
  const int degree = N >= 0 ? N : n;
  const Number<K> s = K::lift(1.0) - t;
  Number<K> power = t;
  out[0] = K::lift(1.0);
  for (int k = 1; k <= degree; ++k) {
    out[k] = K::lift(binomial(degree, k)) * power;
    power = power * t;
  }
  power = s;
  for (int k = degree - 1; k >= 0; --k) {
    out[k] = out[k] * power;
    power = power * s;
  }
}

constexpr int lowered(int degree, int by) { return degree >= by ? degree - by : degree; }
constexpr int room_for(int degree) { return (degree >= 0 ? degree : max_degree) + 1; }

// As tensor_first (bezier/tensor.h); of degree 1 at least in both directions.
template <int M, int N, class K>
INLINE_FOR_THIS_SET PointJet<K> first_order(const dvec4* row, int of_m, int of_n, Number<K> u, Number<K> v) {
  using Point = typename K::Point;
  const int m = M >= 0 ? M : of_m, n = N >= 0 ? N : of_n;
  Number<K> bu[room_for(lowered(M, 1))], bv[room_for(lowered(N, 1))];
  basis_of<lowered(M, 1), K>(m - 1, u, bu);
  basis_of<lowered(N, 1), K>(n - 1, v, bv);
  const Point zero = K::zero();
  Point s00 = zero, s01 = zero, s10 = zero, s11 = zero;
  for (int i = 0; i <= m; ++i, row += n + 1) {
    Point low = bv[0] * K::load(row[0]), high = bv[0] * K::load(row[1]);
    for (int j = 1; j < n; ++j) {
      low = low + bv[j] * K::load(row[j]);
      high = high + bv[j] * K::load(row[j + 1]);
    }
    if (i == 0)
      s00 = bu[0] * low, s01 = bu[0] * high;
    else if (i < m)
      s00 = s00 + bu[i] * low, s01 = s01 + bu[i] * high;
    if (i == 1)
      s10 = bu[0] * low, s11 = bu[0] * high;
    else if (i > 1)
      s10 = s10 + bu[i - 1] * low, s11 = s11 + bu[i - 1] * high;
  }
  const Number<K> su = K::lift(1.0) - u, sv = K::lift(1.0) - v;
  const Point left = sv * s00 + v * s01, right = sv * s10 + v * s11;
  return {su * left + u * right, K::lift(m) * (right - left),
          K::lift(n) * (su * (s01 - s00) + u * (s11 - s10))};
}

// The same and second derivatives, from the nine sums of degree (m - 2, n - 2); of degree 2 at least.
template <int M, int N, class K>
INLINE_FOR_THIS_SET PointBend<K> second_order(const dvec4* row, int of_m, int of_n, Number<K> u,
                                              Number<K> v) {
  using Point = typename K::Point;
  const int m = M >= 0 ? M : of_m, n = N >= 0 ? N : of_n;
  Number<K> bu[room_for(lowered(M, 2))], bv[room_for(lowered(N, 2))];
  basis_of<lowered(M, 2), K>(m - 2, u, bu);
  basis_of<lowered(N, 2), K>(n - 2, v, bv);
  const Point zero = K::zero();
  Point s[3][3] = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
  for (int i = 0; i <= m; ++i, row += n + 1) {
    Point r[3];
    for (int k = 0; k < 3; ++k) r[k] = bv[0] * K::load(row[k]);
    for (int j = 1; j < n - 1; ++j)
      for (int k = 0; k < 3; ++k) r[k] = r[k] + bv[j] * K::load(row[j + k]);
    for (int l = 0; l < 3; ++l) {
      if (i == l)
        for (int k = 0; k < 3; ++k) s[l][k] = bu[0] * r[k];
      else if (i > l && i - l < m - 1)
        for (int k = 0; k < 3; ++k) s[l][k] = s[l][k] + bu[i - l] * r[k];
    }
  }
  const Number<K> su = K::lift(1.0) - u, sv = K::lift(1.0) - v;
  Point value[3], dv[3], dvv[3];
  for (int l = 0; l < 3; ++l) {
    const Point low = sv * s[l][0] + v * s[l][1], high = sv * s[l][1] + v * s[l][2];
    value[l] = sv * low + v * high, dv[l] = high - low;
    dvv[l] = (s[l][2] - s[l][1]) - (s[l][1] - s[l][0]);
  }
  const Point low = su * value[0] + u * value[1], high = su * value[1] + u * value[2];
  const Point low_v = su * dv[0] + u * dv[1], high_v = su * dv[1] + u * dv[2];
  return {{su * low + u * high, K::lift(m) * (high - low), K::lift(n) * (su * low_v + u * high_v)},
          K::lift(m * (m - 1)) * ((value[2] - value[1]) - (value[1] - value[0])),
          K::lift(m * n) * (high_v - low_v),
          K::lift(n * (n - 1)) * (su * (su * dvv[0] + u * dvv[1]) + u * (su * dvv[1] + u * dvv[2]))};
}

// The basis on a triangle, as detail::TriangleBasis.
template <int N, class K>
INLINE_FOR_THIS_SET void triangle_basis_of(int n, Number<K> u, Number<K> v, Number<K>* out) {
  const int degree = N >= 0 ? N : n;
  const Number<K> w = (K::lift(1.0) - u) - v;
  Number<K> pv[room_for(N)], pw[room_for(N)], pu = K::lift(1.0);
  pv[0] = pw[0] = K::lift(1.0);
  for (int k = 0; k < degree; ++k) pv[k + 1] = pv[k] * v, pw[k + 1] = pw[k] * w;
  for (int i = 0, at = 0; i <= degree; ++i) {
    const Number<K> c = K::lift(binomial(degree, i)) * pu;
    for (int j = 0; j <= degree - i; ++j, ++at)
      out[at] = c * (K::lift(binomial(degree - i, j)) * (pv[j] * pw[degree - i - j]));
    pu = pu * u;
  }
}

constexpr int triangle_room_for(int degree) { return triangle_size(degree >= 0 ? degree : max_degree); }

// As triangle_first (bezier/triangle.h); of degree 1 at least.
template <int N, class K>
INLINE_FOR_THIS_SET PointJet<K> first_order(const dvec4* row, int of_n, Number<K> u, Number<K> v) {
  using Point = typename K::Point;
  const int n = N >= 0 ? N : of_n;
  Number<K> basis[triangle_room_for(lowered(N, 1))];
  triangle_basis_of<lowered(N, 1), K>(n - 1, u, v, basis);
  const Point zero = K::zero();
  Point su = zero, sv = zero, sw = zero;
  for (int i = 0, at = 0; i < n; ++i) {
    const dvec4* next = row + n - i + 1;
    for (int j = 0; j < n - i; ++j, ++at) {
      const Number<K> b = basis[at];
      su = su + b * K::load(next[j]), sv = sv + b * K::load(row[j + 1]), sw = sw + b * K::load(row[j]);
    }
    row = next;
  }
  const Number<K> w = (K::lift(1.0) - u) - v, scale = K::lift(n);
  return {(u * su + v * sv) + w * sw, scale * (su - sw), scale * (sv - sw)};
}

// As triangle_second; of degree 2 at least.
template <int N, class K>
INLINE_FOR_THIS_SET PointBend<K> second_order(const dvec4* row, int of_n, Number<K> u, Number<K> v) {
  using Point = typename K::Point;
  const int n = N >= 0 ? N : of_n;
  Number<K> basis[triangle_room_for(lowered(N, 2))];
  triangle_basis_of<lowered(N, 2), K>(n - 2, u, v, basis);
  const Point zero = K::zero();
  Point uu = zero, uv = zero, uw = zero, vv = zero, vw = zero, ww = zero;
  for (int i = 0, at = 0; i < n - 1; ++i) {
    const dvec4 *next = row + n - i + 1, *last = next + n - i;
    for (int j = 0; j < n - 1 - i; ++j, ++at) {
      const Number<K> b = basis[at];
      uu = uu + b * K::load(last[j]), uv = uv + b * K::load(next[j + 1]), uw = uw + b * K::load(next[j]);
      vv = vv + b * K::load(row[j + 2]), vw = vw + b * K::load(row[j + 1]), ww = ww + b * K::load(row[j]);
    }
    row = next;
  }
  const Number<K> w = (K::lift(1.0) - u) - v, scale = K::lift(n), twice = K::lift(n * (n - 1));
  const Point su = (u * uu + v * uv) + w * uw, sv = (u * uv + v * vv) + w * vw,
              sw = (u * uw + v * vw) + w * ww;
  return {{(u * su + v * sv) + w * sw, scale * (su - sw), scale * (sv - sw)},
          twice * ((uu - uw) - (uw - ww)),
          twice * ((uv - uw) - (vw - ww)),
          twice * ((vv - vw) - (vw - ww))};
}
