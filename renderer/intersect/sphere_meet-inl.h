// As many rays as lanes, on their way to their hits with a sphere of patches: as sphere_ray.cpp has it for
// one. Included inside the namespace of an instruction set, after sphere_kernel-inl.h and lanes-inl.h;
// hence no guard and no include.

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr std::size_t lane_count = hn::MaxLanes(D());

// As many rays as lanes.
struct Group {
  V t, t_error, point[3];  // of the hits: on the unit sphere
  V a, b;                  // places in the cells
  M hit, known;            // known: a hit or a miss, or else to be handed back
  alignas(64) std::int64_t cell[lane_count];
};

static_assert(offsetof(Ray, origin) == 0 && offsetof(Ray, direction) == 3 * sizeof(double) &&
              offsetof(Ray, t_min) == 6 * sizeof(double) && offsetof(Ray, t_max) == 7 * sizeof(double));

// As cell_at.
HWY_INLINE void find_cells(const SpherePatches& patches, Group& g) {
  const hn::RebindToSigned<D> di;
  const Lift<D> lift;
  const V zero = lift(0.0), one = lift(1.0), x = g.point[0], y = g.point[1], z = g.point[2];
  const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
  const M z_leads = hn::Gt(az, hn::Max(ax, ay)), y_leads = hn::Gt(ay, ax);
  const auto chosen = [&](V p, V q, V r)
                          HWY_ATTR { return hn::IfThenElse(z_leads, r, hn::IfThenElse(y_leads, q, p)); };
  const V major = chosen(x, y, z), second = chosen(y, z, x), third = chosen(z, x, y);
  const V side = lift(patches.cells_a_side), middle = lift(0.5 * patches.cells_a_side),
          cells = lift(cells_per_reach * patches.cells_a_side);
  const V face = chosen(zero, lift(2.0), lift(4.0)) + hn::IfThenElseZero(hn::Lt(major, zero), one);
  const V p = second * cells + middle, q = third * cells + middle, row = hn::Floor(p), column = hn::Floor(q);
  // Lanes without a hit hold anything: any cell will do.
  const V index = hn::IfThenElseZero(g.hit, (face * side + row) * side + column);
  hn::Store(hn::ConvertTo(di, index), di, g.cell);
  g.a = lift(2.0) * (p - row) - one, g.b = lift(2.0) * (q - column) - one;
}

// From the rays to points of the sphere and their cells. False when no lane has a hit.
HWY_INLINE bool meet(const SphereTarget& target, const double* const* rays, Group& g) {
  const D d;
  const Lift<D> lift;
  const V zero = lift(0.0), one = lift(1.0);
  V ray[8];
  columns_of<8>(d, rays, ray);
  const V *o = ray, *along = ray + 3, t_min = ray[6], t_max = ray[7];
  const V dx = along[0], dy = along[1], dz = along[2];
  // Lengths of the directions as in sphere_ray.cpp.
  const V length2 = (dx * dx + dy * dy) + dz * dz, inverse_length2 = one / length2;
  M known = hn::And(hn::Gt(length2, lift(shortest_direction2)), hn::Lt(length2, lift(longest_direction2)));

  // As meet_sphere.
  Exact<V> away[3];
  for (int k = 0; k < 3; ++k) away[k] = exact_sum(lift(target.center[k]), zero - o[k]);
  const V slide = ((away[0].high * dx + away[1].high * dy) + away[2].high * dz) * inverse_length2;
  known = hn::And(known, hn::Lt(hn::Abs(slide), lift(farthest_slide)));
  V from[3];
  for (int k = 0; k < 3; ++k)
    from[k] = fused(d, slide, along[k], away[k].high) - (away[k].low + lift(target.center_low[k]));

  const SphereChord<V> chord =
      chord_of(from[0], from[1], from[2], dx, dy, dz, inverse_length2, lift(target.radius2), lift);
  known = hn::And(known, hn::Le(chord.passed2, lift(farthest_middle2 * target.radius2)));
  const M meets = hn::Ge(chord.rest, zero);
  // Beside tangency the bound on t takes another form.
  known = hn::And(known, hn::Or(hn::Not(meets), hn::Ge(chord.rest, lift(target.stretch))));
  const V half = hn::Sqrt(hn::Max(chord.rest, zero) * inverse_length2);
  const V enter = chord.middle - half, leave = chord.middle + half;
  const V t_enter = slide + enter, t_leave = slide + leave;
  known = hn::And(known, hn::Or(hn::Not(meets), hn::Ne(t_enter, t_leave)));
  const M enters = hn::And(hn::Ge(t_enter, t_min), hn::Le(t_enter, t_max)),
          leaves = hn::And(hn::Ge(t_leave, t_min), hn::Le(t_leave, t_max));
  g.known = known, g.hit = hn::And(hn::And(known, meets), hn::Or(enters, leaves));
  if (hn::AllFalse(d, g.hit)) return false;
  g.t = hn::IfThenElse(enters, t_enter, t_leave);
  g.t_error = lift(2.0) * (lift(target.stretch) * inverse_length2 / half) + lift(0x1p-52) * hn::Abs(g.t);

  // As sphere_point.
  const V s = hn::IfThenElse(enters, enter, leave), shrink = lift(target.inverse_radius);
  V &x = g.point[0], &y = g.point[1], &z = g.point[2];
  x = shrink * from[0] + s * (shrink * dx), y = shrink * from[1] + s * (shrink * dy);
  z = shrink * from[2] + s * (shrink * dz);

  if (target.sphere->patches) find_cells(*target.sphere->patches, g);
  settle_point(x, y, z, lift);
  return true;
}
