#include "renderer/continuity/continuity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/angle.h"
#include "renderer/bezier/rational.h"
#include "renderer/continuity/side_foot.h"

namespace rondure {
namespace {

constexpr double degrees = 57.295779513082320876798;

void raise(WorstAt& worst, double value, int patch, int other, const dvec3& point) {
  if (!std::isfinite(value) || (worst.patch >= 0 && value <= worst.value)) return;
  worst = {value, patch, other, point};
}

class Meter {
 public:
  explicit Meter(const Surface& surface)
      : patches_(surface.patches), seams_(find_seams(surface.patches, surface.joins)) {}

  Continuity run() {
    out_.seams = seams_.seams.size();
    out_.open_sides = seams_.open.size();
    out_.collapsed_sides = seams_.collapsed.size();
    out_.vertices = seams_.vertices.size();
    out_.orientable = seams_.orientable;
    out_.complete = seams_.complete;
    const int budget = 100000 / static_cast<int>(std::max<std::size_t>(seams_.seams.size(), 1));
    steps_ = std::clamp(budget, 4, 32);
    out_.places = steps_ + 1;
    for (const Seam& seam : seams_.seams) along(seam);
    for (std::size_t m = 0; m < 3; ++m) refine(m);
    for (const SeamVertex& v : seams_.vertices) {
      if (!v.closed) continue;
      ++out_.closed_vertices;
      around(v);
    }
    return out_;
  }

 private:
  const std::vector<Net>& patches_;
  Seams seams_;
  Continuity out_;
  int steps_ = 32;
  struct Peak {
    double value = 0.0, place = 0.0;
  };
  std::vector<std::array<Peak, 3>> peaks_;  // of each seam, among the places looked at

  const Net& net(int patch) const { return patches_[static_cast<std::size_t>(patch)]; }
  double sign(int patch) const { return seams_.turned[static_cast<std::size_t>(patch)] ? -1.0 : 1.0; }

  dvec3 place(const PatchSide& s, double t) const { return point_on_side(net(s.patch), s.side, t); }

  // What is measured at one place of a seam; NaN where it is not known.
  struct Differences {
    dvec3 point{0.0};
    double gap = NAN;
    std::array<double, 3> jumps{NAN, NAN, NAN};  // of the normal, the mean and the Gaussian curvature
  };

  Differences differences(const Seam& seam, double s) const {
    const int a = seam.a.patch, b = seam.b.patch;
    Differences out;
    out.point = place(seam.a, s);
    const double t = foot_on_side(net(b), seam.b.side, out.point, seam.reversed ? 1.0 - s : s).t;
    out.gap = glm::distance(out.point, place(seam.b, t));
    const dvec2 ua = side_point(net(a), seam.a.side, s), ub = side_point(net(b), seam.b.side, t);
    const double turn = seam.reversed ? 1.0 : -1.0;
    const dvec3 na = unit_normal(net(a), ua.x, ua.y), nb = turn * unit_normal(net(b), ub.x, ub.y);
    if (na == dvec3(0.0) || nb == dvec3(0.0)) return out;
    out.jumps[0] = degrees * angle_between(na, nb);
    // At the ends of a side curvature is often not known.
    if (s <= 0.0 || s >= 1.0) return out;
    const Curvature ca = curvature(net(a), ua.x, ua.y), cb = curvature(net(b), ub.x, ub.y);
    out.jumps[1] = std::abs(ca.mean - turn * cb.mean);
    out.jumps[2] = std::abs(ca.gaussian - cb.gaussian);
    return out;
  }

  std::array<WorstAt*, 3> worst() { return {&out_.tangent, &out_.mean, &out_.gaussian}; }

  void along(const Seam& seam) {
    std::array<Peak, 3> peaks;
    for (int k = 0; k <= steps_; ++k) {
      const double s = static_cast<double>(k) / steps_;
      const Differences d = differences(seam, s);
      raise(out_.gap, d.gap, seam.a.patch, seam.b.patch, d.point);
      for (std::size_t m = 0; m < 3; ++m) {
        raise(*worst()[m], d.jumps[m], seam.a.patch, seam.b.patch, d.point);
        if (d.jumps[m] > peaks[m].value) peaks[m] = {d.jumps[m], s};
      }
    }
    peaks_.push_back(peaks);
  }

  // Climbs from the largest values to the peaks between them, by golden sections.
  void refine(std::size_t m) {
    constexpr std::size_t most_seams = 64;
    constexpr int most_steps = 40;
    constexpr double share = 0.38196601125010515;  // 2 - golden ratio
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < peaks_.size(); ++k) {
      if (peaks_[k][m].value >= 0.5 * worst()[m]->value && peaks_[k][m].value > 0.0) order.push_back(k);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return peaks_[a][m].value > peaks_[b][m].value; });
    if (order.size() > most_seams) order.resize(most_seams);
    for (const std::size_t k : order) {
      const Seam& seam = seams_.seams[k];
      const double h = 1.0 / steps_, end = m == 0 ? 0.0 : 0x1p-10 * h;
      double low = std::max(peaks_[k][m].place - h, end), high = std::min(peaks_[k][m].place + h, 1.0 - end);
      const auto at = [&](double s) {
        const Differences d = differences(seam, s);
        raise(*worst()[m], d.jumps[m], seam.a.patch, seam.b.patch, d.point);
        return std::isfinite(d.jumps[m]) ? d.jumps[m] : -1.0;
      };
      double a = low + share * (high - low), b = high - share * (high - low), fa = at(a), fb = at(b);
      for (int step = 0; step < most_steps; ++step) {
        if (fa >= fb) {
          high = b, b = a, fb = fa;
          a = low + share * (high - low), fa = at(a);
        } else {
          low = a, a = b, fa = fb;
          b = high - share * (high - low), fb = at(b);
        }
      }
    }
  }

  void around(const SeamVertex& vertex) {
    std::vector<std::pair<int, dvec3>> normals;
    double sum = 0.0;
    dvec3 point(0.0);
    for (const PatchSide& corner : vertex.corners) {
      const Net& patch = net(corner.patch);
      const int sides = side_count(patch);
      const dvec2 here = side_point(patch, corner.side, 0.0);
      const dvec2 after = side_point(patch, corner.side, 1.0) - here;
      const dvec2 before = side_point(patch, (corner.side + sides - 1) % sides, 0.0) - here;
      const SurfaceJet jet = surface_jet(patch, here.x, here.y);
      point = jet.point;
      const dvec3 a = after.x * jet.du + after.y * jet.dv, b = before.x * jet.du + before.y * jet.dv;
      // A side without a direction there makes the sum meaningless, and raise() passes it over.
      sum += a == dvec3(0.0) || b == dvec3(0.0) ? INFINITY : degrees * angle_between(a, b);
      const dvec3 n = sign(corner.patch) * unit_normal(patch, here.x, here.y);
      if (n != dvec3(0.0)) normals.emplace_back(corner.patch, n);
    }
    const int first = vertex.corners.front().patch;
    raise(out_.vertex_sum, std::abs(sum - 360.0), first, first, point);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      for (std::size_t j = i + 1; j < normals.size(); ++j) {
        const double angle = degrees * angle_between(normals[i].second, normals[j].second);
        // Where there are no two sides, normals are lines.
        raise(out_.vertex, seams_.orientable ? angle : std::min(angle, 180.0 - angle), normals[i].first,
              normals[j].first, point);
      }
    }
  }
};

}  // namespace

Continuity continuity_of(const Surface& surface) {
  Continuity out = Meter(surface).run();
  for (WorstAt* worst : {&out.gap, &out.tangent, &out.mean, &out.gaussian, &out.vertex, &out.vertex_sum}) {
    worst->point += surface.origin;
  }
  return out;
}

}  // namespace rondure
