#include "renderer/intersect/certificate.h"

#include <optional>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/certified_ellipsoid.h"
#include "renderer/intersect/certified_point.h"
#include "renderer/intersect/certified_search.h"
#include "renderer/intersect/certified_side.h"
#include "renderer/intersect/short_ray.h"
#include "renderer/intersect/slab.h"

namespace rondure {
namespace {

// Pieces of one patch that a proof may look at.
constexpr long quick = 1 << 9, patient = 1 << 13;

// Of a surface, and of each of its patches; none where a weight is not positive.
struct Bounds {
  std::optional<Box> whole;
  std::vector<std::optional<Box>> patches;
};

std::optional<Box> box_of(const Net& net) {
  Box box;
  for (const dvec4& p : points_of(net)) {
    if (!(p.w > 0.0)) return std::nullopt;
    box.add(dvec3(p) / p.w);
  }
  return box;
}

Bounds bounds_of(const Surface& surface) {
  Bounds out;
  Box whole;
  bool bounded = !surface.ellipsoid;
  for (const Net& net : surface.patches) {
    out.patches.push_back(box_of(net));
    bounded = bounded && out.patches.back();
    if (bounded) whole.add(*out.patches.back());
  }
  if (bounded) out.whole = whole;
  return out;
}

}  // namespace

const char* name_of(Means means) {
  static constexpr const char* names[] = {"interval", "extended", "boundary", "unresolved"};
  return names[static_cast<int>(means)];
}

struct Certifier::Surfaces {
  const std::vector<TracedSurface>& traced;
  std::vector<Bounds> bounds;
};

namespace {

// One attempt at a proof, in the precision T.
template <class T>
class Attempt {
 public:
  Attempt(const std::vector<TracedSurface>& traced, const std::vector<Bounds>& bounds, const Ray& ray,
          const Hit& hit, long limit)
      : traced_(traced), bounds_(bounds), ray_(ray), hit_(hit), limit_(limit) {}

  Certificate run() {
    bool found = !hit_;
    if (hit_) found = locate();
    // Without a proof that it exists there is nothing that could be first.
    if (found) out_.first = nothing_earlier();
    const bool hit_proven = !hit_ || (out_.exists && out_.unique);
    if (out_.first && hit_proven)
      out_.means = std::is_same_v<T, double> ? Means::interval : Means::extended;
    else if (out_.first && found)
      out_.means = Means::boundary;
    if (hit_ && found) measure();
    return out_;
  }

 private:
  const std::vector<TracedSurface>& traced_;
  const std::vector<Bounds>& bounds_;
  const Ray& ray_;
  const Hit& hit_;
  const long limit_;
  Certificate out_;
  Enclosure<T> at_ = Enclosure<T>::everything();  // t of the root

  // t of the local ray's s.
  static Enclosure<T> t_of(const LocalRay& local, const Enclosure<T>& s) {
    const Enclosure<T> scale{static_cast<T>(local.scale), static_cast<T>(local.scale)},
        slide{static_cast<T>(local.slide), static_cast<T>(local.slide)};
    return (slide + s) * scale;
  }
  static Enclosure<T> s_of(const LocalRay& local, T t) {
    const Enclosure<T> scale{static_cast<T>(local.scale), static_cast<T>(local.scale)},
        slide{static_cast<T>(local.slide), static_cast<T>(local.slide)};
    return Enclosure<T>{t, t} / scale - slide;
  }
  static Enclosure<T> length2(const CertifiedRay<T>& ray) {
    return Enclosure<T>::about(ray.length2(), 4 * roundoff<T> * ray.length2());
  }

  // False: the hit is not shown to be one, not even to within rounding of its patch's side.
  bool locate() {
    const auto& [surface, solver] = traced_[static_cast<std::size_t>(hit_.surface)];
    LocalRay local;
    if (!make_local_ray(ray_.origin, ray_.direction, surface.origin, local)) return false;
    const CertifiedRay<T> ray(ray_.origin, surface.origin, local);
    if (surface.ellipsoid) {
      const EllipsoidRoots<T> roots = certified_ellipsoid(*surface.ellipsoid, ray);
      if (!roots.meets) return false;
      const Enclosure<T> entering = t_of(local, roots.s[0]), leaving = t_of(local, roots.s[1]);
      const auto off = [&](const Enclosure<T>& t) {
        return std::abs(static_cast<T>(hit_.t) - (t.low + t.high) / 2);
      };
      const int side = off(entering) <= off(leaving) ? 0 : 1;
      at_ = side == 0 ? entering : leaving;
      out_.exists = out_.unique = true;
      point_radius_ = distance_of(hit_.point - surface.origin, ray, roots.s[side]);
      return true;
    }
    const Net& net = surface.patches[static_cast<std::size_t>(hit_.patch)];
    const CertifiedPiece<T> piece = certified_piece(net, ray);
    const Existence<T> root = prove_root(piece, dvec2(hit_.u, hit_.v));
    if (!root.exists) return false;
    if (!root.inside && !meets_within_rounding(net, piece, ray, solver, {hit_.u, hit_.v})) return false;
    at_ = t_of(local, ldexp(root.h, piece.units.ratio()) / length2(ray));
    out_.exists = root.inside, out_.unique = true, out_.isolation = root.isolation;
    const double off =
        std::max({std::fabs(hit_.u - root.ball.at.x), std::fabs(hit_.v - root.ball.at.y)}) + root.ball.radius;
    point_radius_ = point_bound(net, {hit_.u, hit_.v}, off) +
                    length_of(hit_.point - surface.origin - net_point(net, hit_.u, hit_.v));
    return true;
  }
  double point_radius_ = 0.0;  // of where the hit's point is in the surface's frame

  static double length_of(const dvec3& x) { return std::hypot(x.x, x.y, x.z) * (1.0 + 0x1p-50); }

  // Bound on that of a point from those at s on the ray.
  static double distance_of(const dvec3& point, const CertifiedRay<T>& ray, const Enclosure<T>& s) {
    const T middle = s.low + (s.high - s.low) / 2, reach = std::max(s.high - middle, middle - s.low);
    T off[3], size = 0;
    for (int k = 0; k < 3; ++k) {
      const T step = middle * ray.direction()[k];
      off[k] = static_cast<T>(point[k]) - (ray.base()[k] + step);
      size = std::max(size, std::abs(ray.base()[k]) + std::abs(step));
    }
    const T rounding = 2 * ray.base_error() + 8 * roundoff<T> * size;
    return static_cast<double>(std::hypot(off[0], off[1], off[2]) + reach * std::sqrt(ray.length2()) +
                               rounding) *
           (1.0 + 0x1p-50);
  }

  // Also moves the root's bound down to where the first may be.
  bool nothing_earlier() {
    Enclosure<T> until = hit_ ? at_ : Enclosure<T>{static_cast<T>(ray_.t_max), static_cast<T>(ray_.t_max)};
    T least = until.low;
    for (std::size_t k = 0; k < traced_.size(); ++k)
      if (!clears(k, until.low, least)) return false;
    if (hit_) at_.low = least;
    return true;
  }

  bool clears(std::size_t k, T until_t, T& least_t) {
    const Surface& surface = traced_[k].surface;
    LocalRay local;
    // Where the ray is a ray, but too far away to be followed, nothing is known.
    if (!make_local_ray(ray_.origin, ray_.direction, surface.origin, local))
      return !is_finite(ray_.origin) || !is_finite(ray_.direction) || ray_.direction == dvec3(0.0);
    const dvec3 inverse = inverse_of(local.direction);
    if (bounds_[k].whole && !meets_box(local, inverse, *bounds_[k].whole)) return true;
    const CertifiedRay<T> ray(ray_.origin, surface.origin, local);
    const T from = s_of(local, static_cast<T>(ray_.t_min)).low, until = s_of(local, until_t).high;
    if (surface.ellipsoid) {
      const EllipsoidRoots<T> roots = certified_ellipsoid(*surface.ellipsoid, ray);
      if (!roots.may_meet) return true;
      for (const Enclosure<T>& s : roots.s) {
        if (s.high < from) continue;
        // The hit's own root, or one that cannot be told from it, is later than `until` in part: by t, as
        // that came from it. Going back to s would round by more than there may be between its bounds.
        if (!(t_of(local, s).high >= until_t)) return false;
        if (!hit_ && s.low <= until) return false;
        least_t = std::min(least_t, t_of(local, s).low);
      }
      return true;
    }
    const Enclosure<T> l2 = length2(ray);
    const Enclosure<T> from_h = Enclosure<T>{from, from} * l2, until_h = Enclosure<T>{until, until} * l2;
    for (std::size_t j = 0; j < surface.patches.size(); ++j) {
      if (bounds_[k].patches[j] && !meets_box(local, inverse, *bounds_[k].patches[j])) continue;
      const CertifiedPiece<T> piece = certified_piece(surface.patches[j], ray);
      const Enclosure<T> between = ldexp(Enclosure<T>{from_h.low, until_h.high}, -piece.units.ratio());
      EarlierSearch<T> search(between.low, between.high, limit_, std::is_same_v<T, double>);
      const Earlier<T>& earlier = search.run(piece);
      out_.pieces += earlier.pieces;
      if (!earlier.decided || earlier.possible) return false;
      if (earlier.least == std::numeric_limits<T>::infinity()) continue;
      // Of a miss, a root that may be at t_max is a root that may be.
      if (!hit_ && !(earlier.least > between.high)) return false;
      const Enclosure<T> least = ldexp(Enclosure<T>{earlier.least, earlier.least}, piece.units.ratio());
      least_t = std::min(least_t, t_of(local, least / l2).low);
    }
    return true;
  }

  void measure() {
    const T t = static_cast<T>(hit_.t);
    out_.t_error = static_cast<double>(std::max(t - at_.low, at_.high - t)) * (1.0 + 0x1p-50) + 0x1p-1074;
    // Beside what moved the point: the rounding of its place in the world.
    const Surface& surface = traced_[static_cast<std::size_t>(hit_.surface)].surface;
    out_.point_error = point_radius_ + 0x1p-50 * (largest(hit_.point) + largest(surface.origin) +
                                                  largest(hit_.point - surface.origin));
  }
};

}  // namespace

Certifier::Certifier(const Tracer& tracer) {
  auto surfaces = std::make_unique<Surfaces>(Surfaces{tracer.surfaces(), {}});
  for (const TracedSurface& traced : surfaces->traced) surfaces->bounds.push_back(bounds_of(traced.surface));
  surfaces_ = std::move(surfaces);
}
Certifier::~Certifier() = default;

Certificate Certifier::certify(const Ray& ray, const Hit& hit) const {
  // As the hit of a short ray was found (short_ray.h); there is no proof of ends and roots that are no
  // doubles in longer steps.
  const bool longer = is_short(ray);
  const double step = longer ? longer_step : 1.0;
  const Ray used = longer ? lengthened(ray) : ray;
  Hit found = hit;
  found.t /= step;
  if (used.t_min * step != ray.t_min || used.t_max * step != ray.t_max || found.t * step != hit.t) return {};
  const auto attempt = [&](auto zero, long limit) {
    Certificate out = Attempt<decltype(zero)>(surfaces_->traced, surfaces_->bounds, used, found, limit).run();
    out.t_error *= step;
    // Somewhere is no place.
    if (!(out.t_error < INFINITY && out.point_error < INFINITY)) out.means = Means::unresolved;
    return out;
  };
  const Certificate first = attempt(0.0, quick);
  if (first.means == Means::interval) return first;
  Certificate second = attempt(0.0L, patient);
  second.pieces += first.pieces;
  return second;
}

}  // namespace rondure
