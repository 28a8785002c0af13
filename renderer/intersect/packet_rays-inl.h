// The rays of a packet and what has been found for them, number by number, and how they enter the scene.
// Included inside the namespace of an instruction set, after newton_lanes-inl.h and lanes-inl.h; hence
// no guard and no include.

constexpr std::size_t width = most_in_packet;
static_assert(width % lane_count == 0);

// A packet's way through the surfaces, number by number. Rays that are handed back are no longer `open`.
struct Packet {
  explicit Packet(const PacketTarget& of) : target(of) {}  // which leaves the numbers as they are

  const PacketTarget& target;
  unsigned local_surface = Query::no_surface;  // in whose frame the bases are
  alignas(64) double origin[3][width];
  // As LocalRay; `reach`: of the base.
  double direction[3][width], base[3][width], slide[width], scale[width], length2[width],
      inverse_length2[width], plane[2][4][width], reach[width];
  double t_min[width], t_max[width];
  double entry[3][width], far[width], far_origin[width], far_rate[width];  // as Entry
  double entered[width];                                                   // 1 or 0
  double open[width];                                                      // 1 or 0
  // The hits so far; `name`: surface and patch, as Hit has them.
  double t[width], t_error[width], name[width], u[width], v[width], point[3][width], normal[3][width];
};

// As many of a packet's rays as there are lanes: those from `first`, but where `in_second` those from
// `second`.
struct Slots {
  std::size_t first, second;
  M in_second;
  HWY_ATTR HWY_INLINE bool are_one() const { return first == second; }
};

// How far the traversal goes, of a packet's rays from `first` on.
struct Limits {
  float* far;
  std::size_t first;
  HWY_ATTR HWY_INLINE float* at(std::size_t g) const { return far + (g - first); }
};

HWY_INLINE V part(const double* numbers, std::size_t first) { return hn::Load(D(), numbers + first); }
HWY_INLINE void set_part(double* numbers, std::size_t first, V x) { hn::Store(x, D(), numbers + first); }
HWY_INLINE V part(const double* numbers, const Slots& at) {
  return hn::IfThenElse(at.in_second, part(numbers, at.second), part(numbers, at.first));
}
// Of the lanes `where`.
HWY_INLINE void set_part(double* numbers, const Slots& at, M where, V x) {
  set_part(numbers, at.first, hn::IfThenElse(hn::AndNot(at.in_second, where), x, part(numbers, at.first)));
  if (at.are_one()) return;
  set_part(numbers, at.second, hn::IfThenElse(hn::And(at.in_second, where), x, part(numbers, at.second)));
}

HWY_INLINE M is_open(const Packet& q, std::size_t g) { return hn::Gt(part(q.open, g), hn::Zero(D())); }
template <class At>
HWY_INLINE Vector vector_at(const double (&numbers)[3][width], const At& at) {
  return {part(numbers[0], at), part(numbers[1], at), part(numbers[2], at)};
}

// Lanes that are no longer the packet's: their traversal ends.
HWY_INLINE void hand_back(Packet& q, M lanes, const Limits& far, const Slots& at) {
  if (hn::AllFalse(D(), lanes)) return;
  set_part(q.open, at, lanes, hn::Zero(D()));
  alignas(64) double gone[lane_count], second[lane_count];
  const V one = hn::Set(D(), 1.0);
  hn::Store(hn::IfThenElseZero(lanes, one), D(), gone);
  hn::Store(hn::IfThenElseZero(at.in_second, one), D(), second);
  for (std::size_t k = 0; k < lane_count; ++k)
    if (gone[k] != 0.0)
      far.at(second[k] != 0.0 ? at.second : at.first)[k] = -std::numeric_limits<float>::infinity();
}
HWY_INLINE Slots slots_at(std::size_t g) { return {g, g, hn::Lt(hn::Zero(D()), hn::Zero(D()))}; }

// Farther away, in the ray's own steps, there is more to do (Hierarchy::enter).
constexpr double farthest_base = 0x1p40;

// As set_base and set_distances. Lanes of rays from no further than that are what is returned.
HWY_INLINE M set_base_of(Packet& q, const dvec3& frame, std::size_t g) {
  const D d;
  const V length2 = part(q.length2, g), zero = hn::Zero(d), split = hn::Set(d, 0x1.0000002p27);
  Exact<V> offset[3];
  for (int k = 0; k < 3; ++k) offset[k] = exact_sum(hn::Set(d, frame[k]), zero - part(q.origin[k], g));
  const Vector along = vector_at(q.direction, g);
  const V slide = dot({offset[0].high, offset[1].high, offset[2].high}, along) / length2;
  const V wide = split * slide, slide_high = wide - (wide - slide), slide_low = slide - slide_high;
  const V towards[3] = {along.x, along.y, along.z};
  V base[3];
  for (int k = 0; k < 3; ++k) {
    const V wide_k = split * towards[k], high = wide_k - (wide_k - towards[k]), low = towards[k] - high;
    const V step = slide * towards[k],
            rest = ((slide_high * high - step) + slide_high * low + slide_low * high) + slide_low * low;
    const Exact<V> sum = exact_sum(step, zero - offset[k].high);
    base[k] = sum.high + (sum.low + (rest - offset[k].low));
    set_part(q.base[k], g, base[k]);
  }
  set_part(q.slide, g, slide);
  set_part(q.reach, g, largest_of({base[0], base[1], base[2]}));
  for (int p = 0; p < 2; ++p)
    set_part(q.plane[p][3], g,
             hn::Neg((part(q.plane[p][0], g) * base[0] + part(q.plane[p][1], g) * base[1]) +
                     part(q.plane[p][2], g) * base[2]));
  return hn::Lt(hn::Abs(slide), hn::Set(d, farthest_base));
}

// As set_direction and set_normals, of ordinary exponents.
HWY_INLINE M set_direction_of(Packet& q, const V* along, V& inverse_scale, std::size_t g) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const V one = hn::Set(d, 1.0), size = largest_of({along[0], along[1], along[2]});
  const M ordinary = hn::And(hn::Gt(size, hn::Set(d, 0x1p-800)), hn::Lt(size, hn::Set(d, 0x1p800)));
  const auto exponent = hn::And(hn::BitCast(du, size), hn::Set(du, std::uint64_t{0x7ff} << 52));
  inverse_scale = hn::BitCast(d, exponent);
  const V scale = hn::BitCast(d, hn::Set(du, std::uint64_t{2046} << 52) - exponent);
  const Vector direction{along[0] * scale, along[1] * scale, along[2] * scale};
  const V length2 = dot(direction, direction);
  set_part(q.direction[0], g, direction.x), set_part(q.direction[1], g, direction.y);
  set_part(q.direction[2], g, direction.z);
  set_part(q.scale, g, scale), set_part(q.length2, g, length2), set_part(q.inverse_length2, g, one / length2);
  const V shrink = one / hn::Sqrt(length2);
  const Vector unit{direction.x * shrink, direction.y * shrink, direction.z * shrink};
  const V sign = hn::CopySign(one, unit.z), a = hn::Neg(one) / (sign + unit.z), b = unit.x * unit.y * a;
  set_part(q.plane[0][0], g, one + sign * unit.x * unit.x * a), set_part(q.plane[0][1], g, sign * b);
  set_part(q.plane[0][2], g, hn::Neg(sign) * unit.x);
  set_part(q.plane[1][0], g, b), set_part(q.plane[1][1], g, sign + unit.y * unit.y * a);
  set_part(q.plane[1][2], g, hn::Neg(unit.y));
  return ordinary;
}

static_assert(offsetof(Ray, direction) == 3 * sizeof(double) && offsetof(Ray, t_min) == 6 * sizeof(double) &&
              offsetof(Ray, t_max) == 7 * sizeof(double));

// Between which coordinates rays come into the scene's sphere, and go out.
struct Extent {
  V low[6], high[6];
};

// As Hierarchy::enter. Lanes that enter are what is returned; `q.open` becomes 0 where a ray is handed back.
HWY_INLINE M enter(Packet& q, const double* const* rays, M ours, EmbreeScene::Packet& out, Extent& extent,
                   std::size_t g) {
  const D d;
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
  V ray[8], inverse_scale;
  columns_of<8>(d, rays, ray);
  for (int k = 0; k < 3; ++k) set_part(q.origin[k], g, ray[k]);
  set_part(q.t_min, g, ray[6]), set_part(q.t_max, g, ray[7]);
  const V rest = ((ray[0] - ray[0]) + (ray[1] - ray[1])) + (ray[2] - ray[2]);
  M open = hn::And(ours, hn::Eq(rest, zero));
  open = hn::And(open, set_direction_of(q, ray + 3, inverse_scale, g));
  const Hierarchy& hierarchy = *q.target.hierarchy;
  open = hn::And(open, set_base_of(q, hierarchy.center(), g));
  const V unit = hn::Set(d, hierarchy.unit()),
          radius = hn::Set(d, hierarchy.radius() * hierarchy.unit() * (1.0 + 1e-9));
  const Vector local = vector_at(q.base, g), along = vector_at(q.direction, g);
  const Vector base{local.x * unit, local.y * unit, local.z * unit};
  const V slide = part(q.slide, g) * unit, room = radius * radius - dot(base, base);
  open = hn::And(open, hn::Lt(hn::Abs(slide), hn::Set(d, farthest_base)));
  set_part(q.open, g, hn::IfThenElseZero(open, one));
  const V half = hn::Sqrt(hn::Max(room, zero) * part(q.inverse_length2, g));
  const V start = ray[6] * inverse_scale * unit - slide, end = ray[7] * inverse_scale * unit - slide;
  const V near = hn::Max(start - hn::Set(d, 1e-9) * half, zero - half);
  const M enters = hn::And(hn::And(open, hn::Ge(room, zero)), hn::And(hn::Le(near, half), hn::Ge(end, near)));
  set_part(q.far_origin, g, (slide + near) * (one / unit) * part(q.scale, g));
  set_part(q.far_rate, g, unit * inverse_scale);

  set_part(q.entered, g, hn::IfThenElseZero(enters, one));

  const hn::Rebind<float, D> df;
  const hn::Rebind<std::int32_t, D> di;
  const V far = hn::Min(half, end) - near,
          from[3] = {base.x + near * along.x, base.y + near * along.y, base.z + near * along.z},
          towards[3] = {along.x, along.y, along.z};
  const V ends[6] =
      {from[0], from[1], from[2], base.x + half * along.x, base.y + half * along.y, base.z + half * along.z},
          infinity = hn::Set(d, INFINITY);
  for (int k = 0; k < 6; ++k) {
    extent.low[k] = hn::Min(extent.low[k], hn::IfThenElse(enters, ends[k], infinity));
    extent.high[k] = hn::Max(extent.high[k], hn::IfThenElse(enters, ends[k], zero - infinity));
  }
  set_part(q.far, g, far);
  for (int k = 0; k < 3; ++k) {
    set_part(q.entry[k], g, from[k]);
    hn::Store(hn::DemoteTo(df, hn::IfThenElseZero(enters, from[k])), df, out.origin[k] + g);
    hn::Store(hn::DemoteTo(df, hn::IfThenElse(enters, towards[k], one)), df, out.direction[k] + g);
  }
  hn::Store(
      hn::DemoteTo(df, hn::IfThenElseZero(enters, far * hn::Set(d, 1.0 + 0x1p-19) + hn::Set(d, 0x1p-100))),
      df, out.far + g);
  hn::Store(hn::DemoteTo(di, hn::IfThenElseZero(enters, hn::Set(d, -1.0))), di, out.valid + g);
  return enters;
}
