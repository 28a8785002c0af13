// Rays in lanes: what the vectors of one instruction set do alike, beyond Highway's own. Included inside the
// namespace of an instruction set, with `hn` for Highway's; hence no guard and no include.

template <class D>
struct Lift {
  HWY_INLINE hn::Vec<D> operator()(double x) const { return hn::Set(D(), x); }
};

template <class V>
struct Exact {
  V high, low;
};

template <class V>
HWY_INLINE Exact<V> exact_sum(V a, V b) {
  const V sum = a + b, from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}

// a b - c, rounded once. Without an instruction for it: from the exact product, the sum of whose parts and c
// is rounded to odd before its last addition (Boldo and Melquiond 2008, figure 6).
template <class D, class V>
HWY_INLINE V fused(D d, V a, V b, V c) {
#if HWY_NATIVE_FMA
  (void)d;
  return hn::MulSub(a, b, c);
#else
  const V split = hn::Set(d, 0x1.0000002p27), wide_a = split * a, wide_b = split * b;
  const V a1 = wide_a - (wide_a - a), a2 = a - a1, b1 = wide_b - (wide_b - b), b2 = b - b1;
  const V product = a * b, error = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2, zero = hn::Zero(d);
  const Exact<V> low = exact_sum(zero - c, error), high = exact_sum(product, low.high),
                 rest = exact_sum(low.low, high.low);
  const hn::RebindToSigned<D> di;
  const auto one = hn::Set(di, std::int64_t{1}), bits = hn::BitCast(di, rest.high);
  const auto even = hn::RebindMask(d, hn::Eq(hn::And(bits, one), hn::Zero(di)));
  const auto inexact = hn::Ne(rest.low, zero);
  const auto apart = hn::RebindMask(di, hn::Xor(hn::Lt(rest.high, zero), hn::Lt(rest.low, zero)));
  const auto odd = bits + hn::IfThenElse(apart, hn::Neg(one), one);
  return high.high + hn::IfThenElse(hn::And(even, inexact), hn::BitCast(d, odd), rest.high);
#endif
}

template <class D, class V>
HWY_INLINE void turn(D d, V a, V b, V c, V e, V* out) {  // of four 128-bit blocks each
  const V x = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a),
          y = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a)),
          z = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(e), c),
          w = hn::OddEvenBlocks(e, hn::SwapAdjacentBlocks(c));
  out[0] = hn::ConcatLowerLower(d, z, x), out[1] = hn::ConcatLowerLower(d, w, y);
  out[2] = hn::ConcatUpperUpper(d, z, x), out[3] = hn::ConcatUpperUpper(d, w, y);
}

template <class D, class V>
HWY_INLINE void turn_square(D d, const V* in, V* out) {  // as many rows as lanes
  constexpr std::size_t N = hn::MaxLanes(D());
  if constexpr (N == 8) {
    V lower[4], upper[4], even[4], odd[4];
    for (int k = 0; k < 4; ++k) {
      lower[k] = hn::InterleaveLower(d, in[2 * k], in[2 * k + 1]);
      upper[k] = hn::InterleaveUpper(d, in[2 * k], in[2 * k + 1]);
    }
    turn(d, lower[0], lower[1], lower[2], lower[3], even);
    turn(d, upper[0], upper[1], upper[2], upper[3], odd);
    for (int k = 0; k < 4; ++k) out[2 * k] = even[k], out[2 * k + 1] = odd[k];
  } else if constexpr (N == 4) {
    const V a = hn::InterleaveLower(d, in[0], in[1]), b = hn::InterleaveUpper(d, in[0], in[1]),
            c = hn::InterleaveLower(d, in[2], in[3]), e = hn::InterleaveUpper(d, in[2], in[3]);
    out[0] = hn::ConcatLowerLower(d, c, a), out[1] = hn::ConcatLowerLower(d, e, b);
    out[2] = hn::ConcatUpperUpper(d, c, a), out[3] = hn::ConcatUpperUpper(d, e, b);
  } else {
    out[0] = hn::InterleaveLower(d, in[0], in[1]), out[1] = hn::InterleaveUpper(d, in[0], in[1]);
  }
}

// Four numbers of eight rows: row k and row k + 4 share a vector, in[k]. It is its own inverse.
template <class D, class V>
HWY_INLINE void turn_halves(D d, const V* in, V* out) {
  const V even = hn::InterleaveLower(d, in[0], in[1]), odd = hn::InterleaveUpper(d, in[0], in[1]),
          next_even = hn::InterleaveLower(d, in[2], in[3]), next_odd = hn::InterleaveUpper(d, in[2], in[3]);
  out[0] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(next_even), even);
  out[1] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(next_odd), odd);
  out[2] = hn::OddEvenBlocks(next_even, hn::SwapAdjacentBlocks(even));
  out[3] = hn::OddEvenBlocks(next_odd, hn::SwapAdjacentBlocks(odd));
}

// `count` numbers of each of as many rows as there are lanes, as that many vectors: out[i], lane k, is number
// i of row k.
template <std::size_t count, class D, class V>
HWY_INLINE void columns_of(D d, const double* const* rows, V* out) {
  constexpr std::size_t N = hn::MaxLanes(D());
  if constexpr (N == 8 && count == 4) {
    const hn::Half<D> half;
    V in[4];
    for (std::size_t k = 0; k < 4; ++k)
      in[k] = hn::Combine(d, hn::LoadU(half, rows[k + 4]), hn::LoadU(half, rows[k]));
    turn_halves(d, in, out);
  } else {
    for (std::size_t first = 0; first < count; first += N) {
      V in[N];
      for (std::size_t k = 0; k < N; ++k) in[k] = hn::LoadU(d, rows[k] + first);
      turn_square(d, in, out + first);
    }
  }
}

// And back. `to[k]`: where row k goes, or nullptr.
template <std::size_t count, class D, class V>
HWY_INLINE void rows_of(D d, const V* columns, double* const* to) {
  constexpr std::size_t N = hn::MaxLanes(D());
  if constexpr (N == 8 && count == 4) {
    const hn::Half<D> half;
    V out[4];
    turn_halves(d, columns, out);
    for (std::size_t k = 0; k < 4; ++k) {
      if (to[k]) hn::StoreU(hn::LowerHalf(half, out[k]), half, to[k]);
      if (to[k + 4]) hn::StoreU(hn::UpperHalf(half, out[k]), half, to[k + 4]);
    }
  } else {
    for (std::size_t first = 0; first < count; first += N) {
      V out[N];
      turn_square(d, columns + first, out);
      for (std::size_t k = 0; k < N; ++k)
        if (to[k]) hn::StoreU(out[k], d, to[k] + first);
    }
  }
}
