// What a root is to its ray, and the hits of a packet as they go out. Included inside the namespace of an
// instruction set, after packet_rays-inl.h; hence no guard and no include.

// As cross_surface, make_crossing, accept and take, for roots in the patch; `s`: the patch there.
HWY_INLINE void take(Packet& q, unsigned surface, const Leaf& leaf, const NewtonPatch& patch, M roots,
                     Pair<Lanes> root, const PointJet<Lanes>& s, const Limits& far, const Slots& at) {
  const D d;
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d), two = hn::Set(d, 2.0);
  const V w = s.value.w, inverse = one / w;
  const Vector point{s.value.x / w, s.value.y / w, s.value.z / w};
  const auto tangent = [&](const Lanes::Point& by) HWY_ATTR {
    return Vector{by.x - point.x * by.w, by.y - point.y * by.w, by.z - point.z * by.w};
  };
  const Vector xu = tangent(s.du), xv = tangent(s.dv), across = cross(xu, xv),
               direction = vector_at(q.direction, at), base = vector_at(q.base, at);
  const V tangents = largest_of(xu) + largest_of(xv), across2 = dot(across, across),
          length = hn::Sqrt(across2);
  M ordinary = hn::Gt(across2, hn::Set(d, 1e-12) * dot(xu, xu) * dot(xv, xv));
  // As is_regular_normal.
  ordinary = hn::And(ordinary, hn::Le(hn::Set(d, patch.noise) * tangents, length));
  ordinary = hn::And(ordinary, hn::And(hn::Gt(length, hn::Set(d, shortest_normal)),
                                       hn::Lt(length, hn::Set(d, longest_normal))));
  const V step = hn::Set(d, unit_roundoff) * tangents * inverse, reach = part(q.reach, at);
  const V bound = hn::Set(d, settled_roundoffs * unit_roundoff) *
                  (hn::Set(d, leaf.scale.position) + reach * hn::Set(d, leaf.scale.weight));
  const V error = bound * inverse + step, extent = hn::Set(d, leaf.scale.position) * inverse;
  const V along = dot(across, direction), length2 = part(q.length2, at),
          inverse_length2 = part(q.inverse_length2, at);
  ordinary = hn::And(ordinary, hn::Ge(two * extent * along * along, error * across2 * length2));
  ordinary = hn::And(ordinary, hn::Le(step, hn::Set(d, 0x1p-50) * (largest_of(point) + reach)));

  const V slide = part(q.slide, at), scale = part(q.scale, at);
  const V place = dot({point.x - base.x, point.y - base.y, point.z - base.z}, direction) * inverse_length2;
  const V straight = error * length / hn::Abs(along),
          quadratic = hn::Sqrt(two * error * extent * inverse_length2);
  const V shift = hn::IfThenElse(hn::Lt(straight, quadratic), straight, quadratic);
  const V place_error = two * shift + hn::Set(d, 0x1p-52) * hn::Abs(slide + place);
  const V t = (slide + place) * scale, t_error = place_error * scale, best = part(q.t, at);
  const M within = hn::And(hn::Ge(t, part(q.t_min, at)), hn::Le(t, part(q.t_max, at)));
  const M counts = hn::And(roots, hn::And(ordinary, within)), nearest = hn::And(counts, hn::Lt(t, best));
  // Which of two at the same t comes first is not for this to say, nor of two surfaces' that are tied.
  const hn::RebindToSigned<D> di;
  M unclear = hn::Eq(t, best);
  if (q.target.doubt > 0.0) {  // more than are_tied
    const V best_error = part(q.t_error, at), less = hn::Min(t_error, best_error);
    const auto named = hn::And(hn::BitCast(di, part(q.name, at)), hn::Set(di, std::int64_t{0xffffffff}));
    const M others = hn::RebindMask(d, hn::Ne(named, hn::Set(di, static_cast<std::int64_t>(surface))));
    const M met = hn::And(others, hn::Lt(best, hn::Set(d, INFINITY)));
    unclear = hn::Or(unclear, hn::And(met, hn::Le(hn::Abs(t - best), hn::Set(d, q.target.doubt) * less)));
  }
  hand_back(q, hn::Or(hn::AndNot(ordinary, roots), hn::And(counts, unclear)), far, at);
  if (hn::AllFalse(d, nearest)) return;
  const std::int64_t name = static_cast<std::int64_t>(leaf.patch) << 32 | static_cast<std::int64_t>(surface);
  const dvec3& frame = q.target.surfaces[surface].origin;
  set_part(q.t, at, nearest, t), set_part(q.t_error, at, nearest, t_error);
  set_part(q.name, at, nearest, hn::BitCast(d, hn::Set(di, name)));
  set_part(q.u, at, nearest, root.x), set_part(q.v, at, nearest, root.y);
  set_part(q.point[0], at, nearest, hn::Set(d, frame.x) + point.x);
  set_part(q.point[1], at, nearest, hn::Set(d, frame.y) + point.y);
  set_part(q.point[2], at, nearest, hn::Set(d, frame.z) + point.z);
  set_part(q.normal[0], at, nearest, across.x / length),
      set_part(q.normal[1], at, nearest, across.y / length);
  set_part(q.normal[2], at, nearest, across.z / length);
  // As Entry::round_far.
  const V ahead = hn::Max(
      ((t + hn::Set(d, q.target.doubt > 0.0 ? q.target.doubt : 1.0) * t_error) - part(q.far_origin, at)) *
          part(q.far_rate, at),
      zero);
  const auto lower = [&](std::size_t g, M lanes) HWY_ATTR {
    const hn::Rebind<float, D> df;
    const auto old = hn::LoadU(df, far.at(g)),
               now = hn::DemoteTo(df, ahead * hn::Set(d, 1.0 + 0x1p-19) + hn::Set(d, 0x1p-100));
    const V chosen = hn::PromoteTo(d, hn::Min(old, now));
    hn::StoreU(hn::DemoteTo(df, hn::IfThenElse(lanes, chosen, hn::PromoteTo(d, old))), df, far.at(g));
  };
  lower(at.first, hn::AndNot(at.in_second, nearest));
  if (!at.are_one()) lower(at.second, hn::And(at.in_second, nearest));
}

static_assert(offsetof(Hit, surface) == 2 * sizeof(double) &&
              offsetof(Hit, patch) == offsetof(Hit, surface) + 4 && offsetof(Hit, u) == 3 * sizeof(double) &&
              offsetof(Hit, v) == 4 * sizeof(double) && offsetof(Hit, point) == 5 * sizeof(double) &&
              offsetof(Hit, normal) == 8 * sizeof(double) && sizeof(Hit) == 11 * sizeof(double));

// Writes the hits and misses of the rays that are still open.
HWY_INLINE void unload(const Packet& q, M found, std::size_t count, Hit* hits, PacketAnswer* answers,
                       std::size_t g) {
  const D d;
  const V zero = hn::Zero(d), none = hn::BitCast(d, hn::Set(hn::RebindToSigned<D>(), std::int64_t{-1}));
  double* to[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) {
    const bool ours = g + k < count && q.open[g + k] != 0.0;
    to[k] = ours ? &hits[g + k].t : nullptr;
    if (g + k < count)
      answers[g + k] = ours                      ? PacketAnswer::done
                       : q.entered[g + k] != 0.0 ? PacketAnswer::prepared
                                                 : PacketAnswer::unknown;
  }
  V numbers[11] = {hn::IfThenElse(found, part(q.t, g), hn::Set(d, INFINITY)), part(q.t_error, g),
                   hn::IfThenElse(found, part(q.name, g), none), part(q.u, g), part(q.v, g)};
  for (int k = 0; k < 3; ++k) numbers[5 + k] = part(q.point[k], g), numbers[8 + k] = part(q.normal[k], g);
  for (const int k : {1, 3, 4, 5, 6, 7, 8, 9, 10}) numbers[k] = hn::IfThenElse(found, numbers[k], zero);
  rows_of<8>(d, numbers, to);
  for (double*& row : to)
    if (row) row += 7;
  rows_of<4>(d, numbers + 7, to);
}

HWY_INLINE void prepare(const Packet& q, std::size_t k, PreparedRay& out) {
  const auto vector = [&](const double(&numbers)[3][width]) {
    return dvec3(numbers[0][k], numbers[1][k], numbers[2][k]);
  };
  LocalRay& local = out.local;
  local.base = vector(q.base), local.direction = vector(q.direction);
  local.slide = q.slide[k], local.scale = q.scale[k], local.inverse_scale = 1.0 / q.scale[k];
  local.length2 = q.length2[k], local.inverse_length2 = q.inverse_length2[k];
  for (int p = 0; p < 2; ++p) {
    const auto& plane = q.plane[p];
    local.plane[p] = dvec4(plane[0][k], plane[1][k], plane[2][k], 0.0);
  }
  out.entry = {vector(q.entry), q.far[k], q.far_origin[k], q.far_rate[k]};
}
