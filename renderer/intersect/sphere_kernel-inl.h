// The arithmetic of the quadric solver, for one ray or for one ray a lane: V is double or a vector of them.
// The same operations in the same order, none of them contracted, so that both give the same bits. Included
// inside the namespace (and under the instruction set) that uses it, as often as there are such; hence no
// guard and no include. `lift` makes a V of a number.

// A line against a sphere about zero, from the point (x, y, z) that is nearest to it but for rounding: roots
// at middle -+ half, half being the square root of rest / direction . direction. `rest`: the squared radius
// less the line's squared distance, negative where the line misses. `passed2`: the squared distance of the
// point from the middle, of which each has its roundings.
template <class V>
struct SphereChord {
  V middle, rest, passed2;
};

// So near the middle the quadratic's discriminant has no cancellation. `inverse_length2`: of the direction.
template <class V, class Lift>
[[gnu::always_inline]] inline SphereChord<V> chord_of(V x, V y, V z, V dx, V dy, V dz, V inverse_length2,
                                                      V radius2, Lift lift) {
  const V back = lift(0.0) - ((x * dx + y * dy) + z * dz), middle = back * inverse_length2,
          passed2 = back * middle;
  return {middle, (radius2 - ((x * x + y * y) + z * z)) + passed2, passed2};
}

// Brings a point to the unit sphere by half a Newton step.
template <class V, class Lift>
[[gnu::always_inline]] inline void settle_point(V& x, V& y, V& z, Lift lift) {
  const V off = (lift(1.0) - ((x * x + y * y) + z * z)) * lift(0.5);
  x = x + off * x, y = y + off * y, z = z + off * z;
}

// (1 - z) a - (x + i y) b, the polynomial whose zero is the parameters of the point (x, y, z) of the patch's
// frame; w = 1 - z.
template <int K, class V>
struct Residual {
  V re[(K + 1) * (K + 1)], im[(K + 1) * (K + 1)];
};

template <int K, class V, class Lift>
[[gnu::always_inline]] inline void residual_of(const double* q, V x, V y, V w, Residual<K, V>& c, Lift lift) {
  for (int i = 0; i < (K + 1) * (K + 1); ++i, q += 4) {
    c.re[i] = (w * lift(q[0]) - x * lift(q[2])) + y * lift(q[3]);
    c.im[i] = (w * lift(q[1]) - x * lift(q[3])) - y * lift(q[2]);
  }
}

// How far a step went.
template <class V>
struct Stride {
  V first2, second2;  // squared lengths of its two parts
  V steep2;           // the square of the most by which an error of the residual moves (u, v)
};

// A step of Newton's method, and what the second derivatives add to it (Chebyshev's method): what is left is
// of the third order. The product of the lengths of both parts bounds it, to a factor of the order of the
// curvature.
template <int K, class V, class Lift>
[[gnu::always_inline]] inline Stride<V> step_towards_zero(const Residual<K, V>& c, V& u, V& v, Lift lift) {
  constexpr int width = K + 1;
  // The value, its derivatives, and half of the second ones along u and along v.
  V f[2], fu[2], fv[2], fuu[2], fuv[2], fvv[2];
  for (int part = 0; part < 2; ++part) {
    V rows[width], slopes[width], bends[width];
    for (int i = 0; i < width; ++i) {
      const V* p = (part == 0 ? c.re : c.im) + i * width;
      V row = p[K] * v + p[K - 1], slope = p[K] * v + row, bend = p[K];
      row = row * v + p[K - 2];
      for (int j = K - 3; j >= 0; --j) {
        bend = bend * v + slope;
        slope = slope * v + row;
        row = row * v + p[j];
      }
      rows[i] = row, slopes[i] = slope, bends[i] = bend;
    }
    V value = rows[K] * u + rows[K - 1], along = rows[K] * u + value, curve = rows[K];
    V across = slopes[K] * u + slopes[K - 1], twist = slopes[K], sag = bends[K] * u + bends[K - 1];
    value = value * u + rows[K - 2];
    for (int i = K - 2;; --i) {
      twist = twist * u + across;
      across = across * u + slopes[i];
      sag = sag * u + bends[i];
      if (i == 0) break;
      curve = curve * u + along;
      along = along * u + value;
      value = value * u + rows[i - 1];
    }
    f[part] = value, fu[part] = along, fv[part] = across;
    fuu[part] = curve, fuv[part] = twist, fvv[part] = sag;
  }
  const V r = lift(1.0) / (fu[0] * fv[1] - fu[1] * fv[0]);
  const V move_u = r * (fv[1] * f[0] - fv[0] * f[1]), move_v = r * (fu[0] * f[1] - fu[1] * f[0]);
  V bent[2];
  for (int part = 0; part < 2; ++part)
    bent[part] = (fuu[part] * move_u + fuv[part] * move_v) * move_u + (fvv[part] * move_v) * move_v;
  const V more_u = r * (fv[1] * bent[0] - fv[0] * bent[1]), more_v = r * (fu[0] * bent[1] - fu[1] * bent[0]);
  u = u - (move_u + more_u), v = v - (move_v + more_v);
  return {move_u * move_u + move_v * move_v, more_u * more_u + more_v * more_v,
          (r * r) * ((fu[0] * fu[0] + fu[1] * fu[1]) + (fv[0] * fv[0] + fv[1] * fv[1]))};
}
