// Which boxes a packet's rays may meet together. Included inside the namespace of an instruction set, after
// packet_rays-inl.h; hence no guard and no include.

// Of rays about a cluster. As LeafCluster::meet, but for where the rays start and end.
struct Corridor {
  V below[3][width / lane_count], above[3][width / lane_count], inverse[3][width / lane_count];
  M active[width / lane_count];
  std::size_t groups = 0;

  HWY_ATTR void add(const Packet& q, const LeafCluster& cluster, M rays, std::size_t g) {
    const D d;
    if (hn::AllFalse(d, rays)) return;
    const V most = hn::Set(d, 1e300), one = hn::Set(d, 1.0),
            room = hn::Set(d, 1e-12) * (part(q.reach, g) + hn::Set(d, cluster.reach()));
    for (int axis = 0; axis < 3; ++axis) {
      const V along = part(q.direction[axis], g),
              base = part(q.base[axis], g) - hn::Set(d, cluster.center()[axis]);
      inverse[axis][groups] =
          hn::IfThenElse(hn::Gt(hn::Abs(along) * most, one), one / along, hn::CopySign(most, along));
      below[axis][groups] = base + room, above[axis][groups] = base - room;
    }
    active[groups++] = rays;
  }

  // Whether one of them meets the box, which is about the cluster's centre.
  HWY_ATTR bool meets(const Box& box) const {
    const D d;
    for (std::size_t g = 0; g < groups; ++g) {
      V enter = hn::Set(d, -INFINITY), leave = hn::Set(d, INFINITY);
      for (int axis = 0; axis < 3; ++axis) {
        const V a = (hn::Set(d, box.low[axis]) - below[axis][g]) * inverse[axis][g],
                b = (hn::Set(d, box.high[axis]) - above[axis][g]) * inverse[axis][g];
        enter = hn::Max(enter, hn::Min(a, b)), leave = hn::Min(leave, hn::Max(a, b));
      }
      if (!hn::AllFalse(d, hn::And(active[g], hn::Le(enter, leave)))) return true;
    }
    return false;
  }
};
