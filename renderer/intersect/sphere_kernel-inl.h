// The arithmetic of the quadric solver, for one ray or for one ray a lane: V is double or a vector of them.
// The same operations in the same order, none of them contracted, so that both give the same bits. Included
// inside the namespace (and under the instruction set) that uses it, as often as there are such; hence no
// guard and no include. `lift` makes a V of a number.

// The line against the unit sphere: from `base` along `direction`, roots at middle -+ half.
template <class V>
struct SphereChord {
  V x, y, z;          // the point nearest to the centre
  V dx, dy, dz;       // direction
  V middle, rest;     // the point's place, and 1 - its square: negative where the line misses
  V inverse_length2;  // 1 / direction . direction
};

// About the point nearest to the centre the quadratic has no linear term, and its discriminant no
// cancellation.
template <class V, class Lift>
[[gnu::always_inline]] inline SphereChord<V> chord_of(V ox, V oy, V oz, V dx, V dy, V dz, Lift lift) {
  SphereChord<V> c;
  c.dx = dx, c.dy = dy, c.dz = dz;
  c.inverse_length2 = lift(1.0) / ((dx * dx + dy * dy) + dz * dz);
  c.middle = (lift(0.0) - ((ox * dx + oy * dy) + oz * dz)) * c.inverse_length2;
  c.x = ox + c.middle * dx, c.y = oy + c.middle * dy, c.z = oz + c.middle * dz;
  c.rest = lift(1.0) - ((c.x * c.x + c.y * c.y) + c.z * c.z);
  return c;
}

// The point `half` on (or back, where that is negative), brought to the sphere by half a Newton step.
template <class V, class Lift>
[[gnu::always_inline]] inline void point_at(const SphereChord<V>& c, V half, V& x, V& y, V& z, Lift lift) {
  x = c.x + half * c.dx, y = c.y + half * c.dy, z = c.z + half * c.dz;
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

// A step of Newton's method with the derivatives at (u, v), and one more with the same. The lengths of both
// come back: their product bounds what is left, to a factor of the order of the curvature.
// `steep2`: the square of the most by which an error of the residual moves (u, v).
template <int K, class V, class Lift>
[[gnu::always_inline]] inline void two_steps(const Residual<K, V>& c, V& u, V& v, V& first2, V& second2,
                                             V& steep2, Lift lift) {
  constexpr int width = K + 1;
  V f[2], fu[2], fv[2];
  for (int part = 0; part < 2; ++part) {
    const V* p = part == 0 ? c.re : c.im;
    V rows[width], slopes[width];
    for (int i = 0; i < width; ++i) {
      V row = p[i * width + K], slope = row;
      row = row * v + p[i * width + K - 1];
      for (int j = K - 2; j >= 0; --j) {
        slope = slope * v + row;
        row = row * v + p[i * width + j];
      }
      rows[i] = row, slopes[i] = slope;
    }
    V value = rows[K], along = value, across = slopes[K];
    value = value * u + rows[K - 1];
    across = across * u + slopes[K - 1];
    for (int i = K - 2; i >= 0; --i) {
      along = along * u + value;
      value = value * u + rows[i];
      across = across * u + slopes[i];
    }
    f[part] = value, fu[part] = along, fv[part] = across;
  }
  const V r = lift(1.0) / (fu[0] * fv[1] - fu[1] * fv[0]);
  const V move_u = r * (fv[1] * f[0] - fv[0] * f[1]), move_v = r * (fu[0] * f[1] - fu[1] * f[0]);
  u = u - move_u, v = v - move_v;
  const V along2 = fu[0] * fu[0] + fu[1] * fu[1], across2 = fv[0] * fv[0] + fv[1] * fv[1];
  steep2 = r * r * (along2 + across2);
  first2 = move_u * move_u + move_v * move_v;
  for (int part = 0; part < 2; ++part) {
    const V* p = part == 0 ? c.re : c.im;
    V value = lift(0.0);
    for (int i = K; i >= 0; --i) {
      V row = p[i * width + K];
      for (int j = K - 1; j >= 0; --j) row = row * v + p[i * width + j];
      value = i == K ? row : value * u + row;
    }
    f[part] = value;
  }
  const V last_u = r * (fv[1] * f[0] - fv[0] * f[1]), last_v = r * (fu[0] * f[1] - fu[1] * f[0]);
  u = u - last_u, v = v - last_v;
  second2 = last_u * last_u + last_v * last_v;
}
