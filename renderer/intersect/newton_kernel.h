// Newton's method on one leaf. Included by newton.cpp once for each instruction set, within a namespace of
// its own; FOR_THIS_SET makes a function be compiled for that set (the pragma alone forgets templates). The
// arithmetic is the same in the same order on all, so that the results are the same bits.

// A homogeneous point in registers.
#if POINT_IN_ONE_REGISTER
using Point = double __attribute__((vector_size(32)));
#else
using Point = detail::Lanes4;
#endif

FOR_THIS_SET inline Point load(const dvec4& p) {
  Point out;
  std::memcpy(&out, &p, sizeof out);
  return out;
}
FOR_THIS_SET inline dvec4 store(const Point& p) {
  dvec4 out;
  std::memcpy(&out, &p, sizeof out);
  return out;
}

struct PointJet {
  Point value, du, dv;
};

// As tensor_first (bezier/tensor.h).
template <int M, int N>
FOR_THIS_SET PointJet evaluate(const TensorNet& net, dvec2 p) {
  const int m = M >= 0 ? M : net.m, n = N >= 0 ? N : net.n;
  const int lu = m - 1,
            lv = n - 1;  // a net of degree 0 in one direction has no normal, and does not come here
  double bu[(M >= 0 ? M : max_degree) + 1], bv[(N >= 0 ? N : max_degree) + 1];
  bernstein_values<(M > 0 ? M - 1 : M)>(lu, p.x, bu);
  bernstein_values<(N > 0 ? N - 1 : N)>(lv, p.y, bv);
  const dvec4* row = net.points.data();
  Point s00{}, s01{}, s10{}, s11{};
  for (int i = 0; i <= m; ++i, row += n + 1) {
    Point low = bv[0] * load(row[0]), high = bv[0] * load(row[1]);
    for (int j = 1; j <= lv; ++j) {
      low += bv[j] * load(row[j]);
      high += bv[j] * load(row[j + 1]);
    }
    if (i <= lu) s00 += bu[i] * low, s01 += bu[i] * high;
    if (i > 0) s10 += bu[i - 1] * low, s11 += bu[i - 1] * high;
  }
  const double su = 1.0 - p.x, sv = 1.0 - p.y;
  const Point left = sv * s00 + p.y * s01, right = sv * s10 + p.y * s11;
  return {su * left + p.x * right, static_cast<double>(m) * (right - left),
          static_cast<double>(n) * (su * (s01 - s00) + p.x * (s11 - s10))};
}

// As triangle_first (bezier/triangle.h).
template <int N>
FOR_THIS_SET PointJet evaluate(const TriangleNet& net, dvec2 p) {
  const int n = N >= 0 ? N : net.n;
  const detail::TriangleBasis<(N > 0 ? N - 1 : N)> basis(n - 1, p.x, p.y);
  const dvec4* row = net.points.data();
  Point su{}, sv{}, sw{};
  int at = 0;
  for (int i = 0; i < n; ++i) {
    const dvec4* next = row + n - i + 1;
    for (int j = 0; j < n - i; ++j, ++at) {
      const double b = basis.b[at];
      su += b * load(next[j]);
      sv += b * load(row[j + 1]);
      sw += b * load(row[j]);
    }
    row = next;
  }
  const double scale = n;
  return {p.x * su + p.y * sv + (1.0 - p.x - p.y) * sw, scale * (su - sw), scale * (sv - sw)};
}

// As projected_net.h.
struct Planes {
  Point plane[2];
  FOR_THIS_SET explicit Planes(const LocalRay& ray) : plane{load(ray.plane[0]), load(ray.plane[1])} {}

  FOR_THIS_SET dvec2 operator()(const Point& s) const {
#if POINT_IN_ONE_REGISTER
    const Point p = plane[0] * s, q = plane[1] * s;
    const Point sum = __builtin_shufflevector(p, q, 0, 4, 2, 6) + __builtin_shufflevector(p, q, 1, 5, 3, 7);
    return dvec2(sum[0] + sum[2], sum[1] + sum[3]);
#else
    const detail::Lanes2 pl = plane[0].low * s.low, ph = plane[0].high * s.high, ql = plane[1].low * s.low,
                         qh = plane[1].high * s.high;
    const detail::Lanes2 low = __builtin_shufflevector(pl, ql, 0, 2) + __builtin_shufflevector(pl, ql, 1, 3),
                         high = __builtin_shufflevector(ph, qh, 0, 2) + __builtin_shufflevector(ph, qh, 1, 3);
    return detail::lane_cast<dvec2>(low + high);
#endif
  }
};

// A ray in a leaf's frame.
struct FramedRay {
  dvec2 slope;  // d(xi, eta) / d(zeta)
  dvec2 foot;   // (xi, eta) where zeta = 0
};

FOR_THIS_SET inline FramedRay framed(const LeafFrame& f, const LocalRay& ray) {
  const dvec3 &o = ray.base, &d = ray.direction;
  const double height = (f.normal.x * o.x + f.normal.y * o.y) + (f.normal.z * o.z + f.normal.w);
  const double rise = (f.normal.x * d.x + f.normal.y * d.y) + f.normal.z * d.z;
  const dvec2 from = (o.x * f.across[0] + o.y * f.across[1]) + (o.z * f.across[2] + f.across[3]);
  const dvec2 along = (d.x * f.across[0] + d.y * f.across[1]) + d.z * f.across[2];
  const dvec2 slope = along * quotient(1.0, rise);
  return {slope, from - height * slope};
}

// Where the ray meets the leaf's osculating paraboloid, in the leaf's parameters less the centre's.
FOR_THIS_SET inline dvec2 start_of(const LeafFrame& f, const FramedRay& ray) {
  const dvec2 &p = ray.foot, &s = ray.slope;
  const double b0 = f.bend[0], b1 = f.bend[1], b2 = f.bend[2];
  // zeta = c + b zeta + a zeta^2 along the ray.
  const double c = (b0 * p.x + b1 * p.y) * p.x + b2 * (p.y * p.y);
  const double b = 2.0 * (b0 * (p.x * s.x) + b2 * (p.y * s.y)) + b1 * (p.x * s.y + p.y * s.x);
  const double a = (b0 * s.x + b1 * s.y) * s.x + b2 * (s.y * s.y);
  const double lead = 1.0 - b, discriminant = lead * lead - 4.0 * a * c;
  const double zeta = discriminant > 0.0 ? 2.0 * c / (lead + std::sqrt(discriminant)) : c;
  const dvec2 q = p + zeta * s;
  const double xx = q.x * q.x, xy = q.x * q.y, yy = q.y * q.y;
  const auto turn = [&](int k)
                        FOR_THIS_SET { return f.turn[0][k] * xx + f.turn[1][k] * xy + f.turn[2][k] * yy; };
  return q - dvec2(turn(0), turn(1));
}

template <class Shape, class Evaluate>
FOR_THIS_SET NewtonVerdict search(const Leaf& leaf, const Evaluate& evaluate_at, const LocalRay& ray,
                                  double error, NewtonRoot& out, NewtonCounts& counts) {
  constexpr bool rectangle = std::is_same_v<Shape, TensorShape>;
  const LeafFrame& frame = leaf.frame;
  const FramedRay local = framed(frame, ray);
  const dvec2 lean = glm::abs(local.slope), far = glm::abs(local.foot);
  const dvec2 middle = local.foot + double(frame.middle_zeta) * local.slope;
  const dvec2 room = dvec2(frame.bound[0], frame.bound[1]) + lean * double(frame.bound_zeta) +
                     far * double(frame.bound_weight);
  // Written so that what is not finite is never taken for a proof.
  bool misses;
  if constexpr (rectangle) {
    misses = std::fabs(middle.x) > 0.5 + room.x || std::fabs(middle.y) > 0.5 + room.y;
  } else {
    const dvec2 p = middle + Shape::center();
    misses = p.x < -room.x || p.y < -room.y || p.x + p.y > 1.0 + room.x + room.y;
  }
  if (misses) return NewtonVerdict::none;
  const double zeta_a = frame.slack_zeta[0], zeta_b = frame.slack_zeta[1];
  const double straight = frame.slack + std::max(far.x, far.y) * double(frame.slack_weight);
  const double oblique = std::max(lean.x, lean.y) * (zeta_a + zeta_b);
  const double grazing = lean.x * zeta_a + lean.y * zeta_b + oblique * (straight / (1.0 - straight));
  if (!(straight < straight_limit && grazing < uniqueness_limit)) return NewtonVerdict::undecided;

  ++counts.iterated;
  // How far outside the leaf the bounds hold.
  constexpr double margin = (leaf_enlargement - 1.0) * (rectangle ? 0.5 : 1.0 / 3.0);
  // After a step of length h, tail h^2 is left at most.
  const double rest = (1.0 - straight) * (1.0 - grazing), tail = (straight + oblique) / (rest * rest);
  const Planes planes(ray);
  const dvec2 start = start_of(frame, local);
  dvec2 p = Shape::center() + start;
  for (int k = 0; k < step_limit; ++k) {
    if (!(Shape::outside(p) < margin)) {
      // A root of the leaf would be within the room of the middle, and no iterate further from it than the
      // first.
      const dvec2 first = room + glm::abs(start - middle);
      const double reach = std::max(first.x, first.y);
      return straight + oblique < contraction_limit && Shape::outside(p) > reach ? NewtonVerdict::none
                                                                                 : NewtonVerdict::undecided;
    }
    const PointJet s = evaluate_at(leaf.to_patch(p));
    ++counts.steps;
    const dvec2 f = planes(s.value), fu = planes(s.du), fv = planes(s.dv);
    dvec2 fa, fb;
    if constexpr (rectangle)
      fa = leaf.edge_a.x * fu, fb = leaf.edge_b.y * fv;
    else
      fa = leaf.edge_a.x * fu + leaf.edge_a.y * fv, fb = leaf.edge_b.x * fu + leaf.edge_b.y * fv;
    const double r = quotient(1.0, fa.x * fb.y - fa.y * fb.x);  // infinite at a singular point: undecided
    const dvec2 step = dvec2(fb.y * f.x - fb.x * f.y, fa.x * f.y - fa.y * f.x) * r;
    p -= step;
    const double length = std::max(std::fabs(step.x), std::fabs(step.y));
    if (!(length * length * tail < 0x1p-53)) continue;
    const dvec2 at = leaf.to_patch(p);
    if (Shape::outside(p) > 0.0) {
      // Beside the leaf: of the neighbouring leaf, unless rounding put it here.
      const double rows = std::max(std::fabs(fb.x) + std::fabs(fb.y), std::fabs(fa.x) + std::fabs(fa.y));
      if (Shape::outside(p) > 2.0 * error * rows * std::fabs(r) + 4.0 * unit_roundoff)
        return NewtonVerdict::none;
    }
    const PointJet surface = evaluate_at(at);
    out.root = {at.x, at.y, false};
    out.surface = {store(surface.value), store(surface.du), store(surface.dv)};
    return NewtonVerdict::root;
  }
  return NewtonVerdict::undecided;
}

FOR_THIS_SET inline NewtonVerdict on_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, double error,
                                          NewtonRoot& out, NewtonCounts& counts) noexcept {
  if (const auto* t = std::get_if<TensorNet>(&net))
    return with_degrees(t->m, t->n, [&](auto m, auto n) FOR_THIS_SET {
      return search<TensorShape>(
          leaf, [&](dvec2 p) FOR_THIS_SET { return evaluate<m, n>(*t, p); }, ray, error, out, counts);
    });
  const auto& t = std::get<TriangleNet>(net);
  return with_degree(t.n, [&](auto n) FOR_THIS_SET {
    return search<TriangleShape>(
        leaf, [&](dvec2 p) FOR_THIS_SET { return evaluate<n>(t, p); }, ray, error, out, counts);
  });
}
