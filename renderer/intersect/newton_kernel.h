// Newton's method on one leaf, for one ray. Included by newton.cpp once for each instruction set, within a
// namespace of its own; FOR_THIS_SET makes a function be compiled for that set (the pragma alone forgets
// templates). The arithmetic is the same in the same order on all, so that the results are the same bits.

#include "renderer/intersect/jets-inl.h"
#include "renderer/intersect/newton_arithmetic-inl.h"
#include "renderer/intersect/one_point-inl.h"

struct OneRay : OnePoint {
  FOR_THIS_SET static double divided(double a, double b) { return quotient(a, b); }
  FOR_THIS_SET static double abs(double x) { return std::fabs(x); }
  FOR_THIS_SET static double sqrt(double x) { return std::sqrt(x); }
  // As vectors have it: b where either is no number.
  FOR_THIS_SET static double max(double a, double b) { return a > b ? a : b; }
  FOR_THIS_SET static double where_positive(double x, double a, double b) { return x > 0.0 ? a : b; }
};
using Place = Pair<OneRay>;

// As projected_net.h.
struct Planes {
  OneRay::Point plane[2];
  FOR_THIS_SET explicit Planes(const LocalRay& ray)
      : plane{OneRay::load(ray.plane[0]), OneRay::load(ray.plane[1])} {}

  FOR_THIS_SET Place operator()(const OneRay::Point& s) const {
#if POINT_IN_ONE_REGISTER
    const OneRay::Point p = plane[0] * s, q = plane[1] * s;
    const OneRay::Point sum =
        __builtin_shufflevector(p, q, 0, 4, 2, 6) + __builtin_shufflevector(p, q, 1, 5, 3, 7);
    return {sum[0] + sum[2], sum[1] + sum[3]};
#else
    const detail::Lanes2 pl = plane[0].low * s.low, ph = plane[0].high * s.high, ql = plane[1].low * s.low,
                         qh = plane[1].high * s.high;
    const detail::Lanes2 low = __builtin_shufflevector(pl, ql, 0, 2) + __builtin_shufflevector(pl, ql, 1, 3),
                         high = __builtin_shufflevector(ph, qh, 0, 2) + __builtin_shufflevector(ph, qh, 1, 3);
    const detail::Lanes2 sum = low + high;
    return {sum[0], sum[1]};
#endif
  }
};

// A patch whose degrees are known when compiling, or `dynamic`.
template <int M, int N>
struct Rectangle {
  static constexpr bool rectangle = true;
  const NewtonPatch& patch;
  bool bends() const { return (M >= 0 ? M : patch.m) > 1 && (N >= 0 ? N : patch.n) > 1; }
  FOR_THIS_SET PointJet<OneRay> first(Place p) const {
    return first_order<M, N, OneRay>(patch.points, patch.m, patch.n, p.x, p.y);
  }
  FOR_THIS_SET PointBend<OneRay> second(Place p) const {
    return second_order<M, N, OneRay>(patch.points, patch.m, patch.n, p.x, p.y);
  }
};

template <int N>
struct Triangle {
  static constexpr bool rectangle = false;
  const NewtonPatch& patch;
  bool bends() const { return (N >= 0 ? N : patch.m) > 1; }
  FOR_THIS_SET PointJet<OneRay> first(Place p) const {
    return first_order<N, OneRay>(patch.points, patch.m, p.x, p.y);
  }
  FOR_THIS_SET PointBend<OneRay> second(Place p) const {
    if constexpr (N == dynamic || N > 1)
      return second_order<N, OneRay>(patch.points, patch.m, p.x, p.y);
    else
      return PointBend<OneRay>();
  }
};

template <class Patch>
FOR_THIS_SET NewtonVerdict on_leaf(const Leaf& leaf, const NewtonPatch& of, const LocalRay& ray, double error,
                                   NewtonRoot& out, NewtonCounts& counts) noexcept {
  const Patch patch{of};
  constexpr bool rectangle = Patch::rectangle;
  const LeafFrame& frame = leaf.frame;
  const FramedRay<OneRay> local = framed<OneRay>(frame, &ray.base.x, &ray.direction.x);
  const Outlook<OneRay> outlook = outlook_of<OneRay>(frame, local);
  const Place &middle = outlook.middle, &room = outlook.room;
  constexpr double center = rectangle ? 0.5 : 1.0 / 3.0;
  // Written so that what is not finite is never taken for a proof.
  bool misses;
  if constexpr (rectangle) {
    misses = std::fabs(middle.x) > 0.5 + room.x || std::fabs(middle.y) > 0.5 + room.y;
  } else {
    const Place p{middle.x + center, middle.y + center};
    misses = p.x < -room.x || p.y < -room.y || p.x + p.y > 1.0 + room.x + room.y;
  }
  if (misses) return NewtonVerdict::none;
  if (!(outlook.straight < newton_limits::straight && outlook.grazing < newton_limits::uniqueness))
    return passing_of<OneRay>(frame, local) > 0.0 ? NewtonVerdict::none : NewtonVerdict::undecided;

  ++counts.iterated;
  // How far outside the leaf the bounds hold.
  constexpr double margin = (leaf_enlargement - 1.0) * center;
  const double tail = tail_of<OneRay>(outlook);
  const Planes planes(ray);
  const Place start = start_of<OneRay>(frame, local);
  Place p{center + start.x, center + start.y};
  const auto beyond = [&]() FOR_THIS_SET {
    // A root of the leaf would be within the room of the middle, and no iterate further from it than the
    // first.
    const double reach =
        std::max(room.x + std::fabs(start.x - middle.x), room.y + std::fabs(start.y - middle.y));
    return outlook.straight + outlook.oblique < newton_limits::contraction &&
                   outside_leaf<rectangle, OneRay>(p) > reach
               ? NewtonVerdict::none
               : NewtonVerdict::undecided;
  };
  PointBend<OneRay> bend;
  bool bent = false;
  if (patch.bends()) {
    if (!(outside_leaf<rectangle, OneRay>(p) < margin)) return beyond();
    bend = patch.second(place_in_patch<rectangle, OneRay>(leaf, p));
    ++counts.steps;
    const Place step = first_step<rectangle, OneRay>(leaf, bend, planes);
    p = {p.x - step.x, p.y - step.y};
    bent = size_of<OneRay>(step) < newton_limits::longest_bent;
  }
  for (int k = 0; k < step_limit; ++k) {
    if (!(outside_leaf<rectangle, OneRay>(p) < margin)) return beyond();
    const Place at = place_in_patch<rectangle, OneRay>(leaf, p);
    const PointJet<OneRay> s = patch.first(at);
    ++counts.steps;
    const Slopes<OneRay> slopes = slopes_of<rectangle, OneRay>(leaf, planes(s.du), planes(s.dv));
    const Place step = step_for<OneRay>(slopes, planes(s.value));
    p = {p.x - step.x, p.y - step.y};
    const double length = size_of<OneRay>(step);
    if (!(length * length * tail < 0x1p-53)) continue;
    if (const double outside = outside_leaf<rectangle, OneRay>(p); outside > 0.0) {
      // Beside the leaf: of the neighbouring leaf, unless rounding put it here.
      const double rows = std::max(std::fabs(slopes.b.x) + std::fabs(slopes.b.y),
                                   std::fabs(slopes.a.x) + std::fabs(slopes.a.y));
      if (outside > 2.0 * error * rows * std::fabs(slopes.inverse) + 4.0 * unit_roundoff)
        return NewtonVerdict::none;
    }
    const Place root = place_in_patch<rectangle, OneRay>(leaf, p);
    const PointJet<OneRay> surface =
        bent && length < newton_limits::longest_moved
            ? moved<OneRay>(s, bend, difference_in_patch<rectangle, OneRay>(leaf, step))
            : patch.first(root);
    out.root = {root.x, root.y, false};
    out.surface = {OneRay::store(surface.value), OneRay::store(surface.du), OneRay::store(surface.dv)};
    return NewtonVerdict::root;
  }
  return NewtonVerdict::undecided;
}

inline decltype(NewtonPatch::on_leaf) kernel_for(const NewtonPatch& patch) {
  using Kernel = decltype(NewtonPatch::on_leaf);
  if (patch.is_rectangle())
    return with_degrees(patch.m, patch.n, [](auto m, auto n) -> Kernel { return on_leaf<Rectangle<m, n>>; });
  return with_degree(patch.m, [](auto n) -> Kernel { return on_leaf<Triangle<n>>; });
}
