// What sphere_packets.cpp keeps of each lane, and error-free transformations on vectors. Included inside the
// namespace of an instruction set, with `hn` for Highway's own; hence no guard and no include.

template <class D>
struct Lift {
  HWY_INLINE hn::Vec<D> operator()(double x) const { return hn::Set(D(), x); }
};

// What a lane takes from memory and returns to it.
template <std::size_t N>
struct Lanes {
  alignas(64) double origin[3][N], direction[3][N], t_min[N], t_max[N];
  alignas(64) double axes[9][N];
  alignas(64) float start[12][N];
  alignas(64) std::int64_t cell[N]{};
  alignas(64) double a[N], b[N];  // places in the cells
  alignas(64) double ok[N];
  // Set, since a compiler cannot see that only hits are asked for them.
  alignas(64) double t[N]{}, t_error[N]{}, u[N]{}, v[N]{}, point[3][N]{}, normal[3][N]{};
};

template <class V>
struct Product {
  V high, low;
};

// Exact: the error is what a fused multiply-add leaves, or Dekker's sum where there is none.
template <class D, class V>
HWY_INLINE Product<V> exact_product(D d, V a, V b) {
  const V product = a * b;
#if HWY_NATIVE_FMA
  (void)d;
  return {product, hn::MulSub(a, b, product)};
#else
  const V split = hn::Set(d, 0x1.0000002p27), wide_a = split * a, wide_b = split * b;
  const V a1 = wide_a - (wide_a - a), a2 = a - a1, b1 = wide_b - (wide_b - b), b2 = b - b1;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
#endif
}

template <class V>
HWY_INLINE Product<V> exact_sum(V a, V b) {
  const V sum = a + b, from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}
