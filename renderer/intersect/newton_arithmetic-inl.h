// The arithmetic of Newton's method on one leaf, for one ray or for one ray a lane: a kind K says which (its
// Number, its Point, and how they are made). The same operations in the same order, none of them contracted,
// so that both give the same bits. Included inside the namespace of an instruction set, which
// INLINE_FOR_THIS_SET names, after jets-inl.h; hence no guard and no include.

template <class K>
struct Pair {
  Number<K> x, y;
};

// A ray in a leaf's frame.
template <class K>
struct FramedRay {
  Pair<K> slope;  // d(xi, eta) / d(zeta)
  Pair<K> foot;   // (xi, eta) where zeta = 0
};

// `o` and `d`: the ray's base and direction.
template <class K>
INLINE_FOR_THIS_SET FramedRay<K> framed(const LeafFrame& f, const Number<K>* o, const Number<K>* d) {
  const auto& [a, b, c, e] = f.across;
  const Number<K> height = (K::lift(f.normal.x) * o[0] + K::lift(f.normal.y) * o[1]) +
                           (K::lift(f.normal.z) * o[2] + K::lift(f.normal.w));
  const Number<K> rise =
      (K::lift(f.normal.x) * d[0] + K::lift(f.normal.y) * d[1]) + K::lift(f.normal.z) * d[2];
  const Number<K> steep = K::divided(K::lift(1.0), rise);
  const Pair<K> along{(d[0] * K::lift(a.x) + d[1] * K::lift(b.x)) + d[2] * K::lift(c.x),
                      (d[0] * K::lift(a.y) + d[1] * K::lift(b.y)) + d[2] * K::lift(c.y)};
  const Pair<K> from{(o[0] * K::lift(a.x) + o[1] * K::lift(b.x)) + (o[2] * K::lift(c.x) + K::lift(e.x)),
                     (o[0] * K::lift(a.y) + o[1] * K::lift(b.y)) + (o[2] * K::lift(c.y) + K::lift(e.y))};
  const Pair<K> slope{along.x * steep, along.y * steep};
  return {slope, {from.x - height * slope.x, from.y - height * slope.y}};
}

// What is known of a ray's roots on a leaf before any step (newton.h): where one is, but for `room`, and how
// far the left side of (1) is from (a, b) itself.
template <class K>
struct Outlook {
  Pair<K> middle, room;
  Number<K> straight, oblique, grazing;
};

template <class K>
INLINE_FOR_THIS_SET Outlook<K> outlook_of(const LeafFrame& f, const FramedRay<K>& ray) {
  const Pair<K> lean{K::abs(ray.slope.x), K::abs(ray.slope.y)}, far{K::abs(ray.foot.x), K::abs(ray.foot.y)};
  const Number<K> height = K::lift(f.middle_zeta), bound_zeta = K::lift(f.bound_zeta),
                  bound_weight = K::lift(f.bound_weight);
  Outlook<K> out;
  out.middle = {ray.foot.x + height * ray.slope.x, ray.foot.y + height * ray.slope.y};
  out.room = {(K::lift(f.bound[0]) + lean.x * bound_zeta) + far.x * bound_weight,
              (K::lift(f.bound[1]) + lean.y * bound_zeta) + far.y * bound_weight};
  const Number<K> zeta_a = K::lift(f.slack_zeta[0]), zeta_b = K::lift(f.slack_zeta[1]);
  out.straight = K::lift(f.slack) + K::max(far.x, far.y) * K::lift(f.slack_weight);
  out.oblique = K::max(lean.x, lean.y) * (zeta_a + zeta_b);
  out.grazing = (lean.x * zeta_a + lean.y * zeta_b) +
                out.oblique * K::divided(out.straight, K::lift(1.0) - out.straight);
  return out;
}

// After a step of length h, this times h^2 is left at most.
template <class K>
INLINE_FOR_THIS_SET Number<K> tail_of(const Outlook<K>& o) {
  const Number<K> rest = (K::lift(1.0) - o.straight) * (K::lift(1.0) - o.grazing);
  return K::divided(o.straight + o.oblique, rest * rest);
}

// Along the ray the leaf's osculating paraboloid is zeta = c + b zeta + a zeta^2.
template <class K>
struct Parabola {
  Number<K> a, b, c;
};

template <class K>
INLINE_FOR_THIS_SET Parabola<K> parabola_of(const LeafFrame& f, const FramedRay<K>& ray) {
  const Pair<K>&p = ray.foot, &s = ray.slope;
  const Number<K> b0 = K::lift(f.bend[0]), b1 = K::lift(f.bend[1]), b2 = K::lift(f.bend[2]);
  return {(b0 * s.x + b1 * s.y) * s.x + b2 * (s.y * s.y),
          K::lift(2.0) * (b0 * (p.x * s.x) + b2 * (p.y * s.y)) + b1 * (p.x * s.y + p.y * s.x),
          (b0 * p.x + b1 * p.y) * p.x + b2 * (p.y * p.y)};
}

// Where the ray meets the leaf's osculating paraboloid, in the leaf's parameters less the centre's.
template <class K>
INLINE_FOR_THIS_SET Pair<K> start_of(const LeafFrame& f, const FramedRay<K>& ray) {
  const Pair<K>&p = ray.foot, &s = ray.slope;
  const auto [a, b, c] = parabola_of<K>(f, ray);
  const Number<K> lead = K::lift(1.0) - b, discriminant = lead * lead - (K::lift(4.0) * a) * c;
  const Number<K> zeta = K::where_positive(
      discriminant, K::divided(K::lift(2.0) * c, lead + K::sqrt(K::max(discriminant, K::lift(0.0)))), c);
  const Pair<K> q{p.x + zeta * s.x, p.y + zeta * s.y};
  const Number<K> xx = q.x * q.x, xy = q.x * q.y, yy = q.y * q.y;
  const auto& t = f.turn;
  return {q.x - ((K::lift(t[0][0]) * xx + K::lift(t[1][0]) * xy) + K::lift(t[2][0]) * yy),
          q.y - ((K::lift(t[0][1]) * xx + K::lift(t[1][1]) * xy) + K::lift(t[2][1]) * yy)};
}

// Positive where the ray passes the leaf: it stays further from the paraboloid than any point of the leaf is.
// A root's zeta is one of (c + d) + b zeta + a zeta^2, |d| at most bound_bend. Rounding moves the
// discriminant by less than `doubt` where the ray is within a thousandth of a radian or more of the leaf's
// plane.
template <class K>
INLINE_FOR_THIS_SET Number<K> passing_of(const LeafFrame& f, const FramedRay<K>& ray) {
  const auto [a, b, c] = parabola_of<K>(f, ray);
  const Number<K> one = K::lift(1.0), four = K::lift(4.0), lead = one - b;
  const Number<K> lean = K::max(K::abs(ray.slope.x), K::abs(ray.slope.y)),
                  far = K::max(K::abs(ray.foot.x), K::abs(ray.foot.y));
  const double bends = std::fabs(f.bend[0]) + std::fabs(f.bend[1]) + std::fabs(f.bend[2]);
  const Number<K> reach = one + K::lift(2.0 * bends) * (lean * far), doubt = K::lift(1e-9) * (reach * reach);
  const Number<K> room =
      ((four * a) * c - lead * lead) - ((four * K::abs(a)) * K::lift(f.bound_bend) + doubt);
  return K::where_positive(K::lift(1e3) - lean, room, K::lift(-1.0));
}

// The derivatives of the projected pair by a leaf's parameters.
template <class K>
struct Slopes {
  Pair<K> a, b;
  Number<K> inverse;  // of the determinant; infinite at a singular point
};

template <bool rectangle, class K>
INLINE_FOR_THIS_SET Slopes<K> slopes_of(const Leaf& leaf, Pair<K> fu, Pair<K> fv) {
  Slopes<K> s;
  const Number<K> ax = K::lift(leaf.edge_a.x), by = K::lift(leaf.edge_b.y);
  if constexpr (rectangle) {
    s.a = {ax * fu.x, ax * fu.y}, s.b = {by * fv.x, by * fv.y};
  } else {
    const Number<K> ay = K::lift(leaf.edge_a.y), bx = K::lift(leaf.edge_b.x);
    s.a = {ax * fu.x + ay * fv.x, ax * fu.y + ay * fv.y},
    s.b = {bx * fu.x + by * fv.x, bx * fu.y + by * fv.y};
  }
  s.inverse = K::divided(K::lift(1.0), s.a.x * s.b.y - s.a.y * s.b.x);
  return s;
}

// What has to be taken from the leaf's parameters for the pair to lose `f`, to first order.
template <class K>
INLINE_FOR_THIS_SET Pair<K> step_for(const Slopes<K>& s, Pair<K> f) {
  return {(s.b.y * f.x - s.b.x * f.y) * s.inverse, (s.a.x * f.y - s.a.y * f.x) * s.inverse};
}

// From the leaf's parameters to the patch's: of a difference, and of a place.
template <bool rectangle, class K>
INLINE_FOR_THIS_SET Pair<K> difference_in_patch(const Leaf& leaf, Pair<K> p) {
  const Number<K> ax = K::lift(leaf.edge_a.x), by = K::lift(leaf.edge_b.y);
  if constexpr (rectangle) return {p.x * ax, p.y * by};
  const Number<K> ay = K::lift(leaf.edge_a.y), bx = K::lift(leaf.edge_b.x);
  return {p.x * ax + p.y * bx, p.x * ay + p.y * by};
}
template <bool rectangle, class K>
INLINE_FOR_THIS_SET Pair<K> place_in_patch(const Leaf& leaf, Pair<K> p) {
  const Pair<K> d = difference_in_patch<rectangle, K>(leaf, p);
  return {K::lift(leaf.corner.x) + d.x, K::lift(leaf.corner.y) + d.y};
}

// How far outside the leaf, as Shape::outside.
template <bool rectangle, class K>
INLINE_FOR_THIS_SET Number<K> outside_leaf(Pair<K> p) {
  const Number<K> zero = K::lift(0.0), one = K::lift(1.0);
  if constexpr (rectangle)
    return K::max(K::max(zero - p.x, p.x - one), K::max(zero - p.y, p.y - one));
  else
    return K::max(K::max(zero - p.x, zero - p.y), (p.x + p.y) - one);
}

template <class K>
INLINE_FOR_THIS_SET Number<K> size_of(Pair<K> p) {
  return K::max(K::abs(p.x), K::abs(p.y));
}

// Newton's step, and what the second derivatives add to it (Chebyshev's method) where that is a correction.
// With it a quarter of the step, the distance from a root cannot grow in it either (newton_kernel.h).
template <bool rectangle, class K, class Planes>
INLINE_FOR_THIS_SET Pair<K> first_step(const Leaf& leaf, const PointBend<K>& s, const Planes& planes) {
  const Slopes<K> slopes = slopes_of<rectangle, K>(leaf, planes(s.first.du), planes(s.first.dv));
  const Pair<K> step = step_for<K>(slopes, planes(s.first.value));
  const Pair<K> d = difference_in_patch<rectangle, K>(leaf, step);
  const Number<K> half = K::lift(0.5);
  const auto bent = (((half * d.x) * d.x) * s.duu + (d.x * d.y) * s.duv) + ((half * d.y) * d.y) * s.dvv;
  const Pair<K> more = step_for<K>(slopes, planes(bent));
  const Number<K> spare = K::lift(0.25) * size_of<K>(step) - size_of<K>(more), zero = K::lift(0.0);
  return {step.x + K::where_positive(spare, more.x, zero), step.y + K::where_positive(spare, more.y, zero)};
}

// The patch after a step `d` of its parameters that is small enough for its square not to count.
template <class K>
INLINE_FOR_THIS_SET PointJet<K> moved(const PointJet<K>& s, const PointBend<K>& near, Pair<K> d) {
  return {s.value - (d.x * s.du + d.y * s.dv), s.du - (d.x * near.duu + d.y * near.duv),
          s.dv - (d.x * near.duv + d.y * near.dvv)};
}
