#include "renderer/continuity/continuity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/continuity/side_foot.h"

namespace rondure {
namespace {

constexpr double degrees = 57.295779513082320876798;

double angle_between(const dvec3& a, const dvec3& b) {
  return degrees * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void raise(WorstAt& worst, double value, int patch, int other, const dvec3& point) {
  if (!std::isfinite(value) || (worst.patch >= 0 && value <= worst.value)) return;
  worst = {value, patch, other, point};
}

class Meter {
 public:
  explicit Meter(const std::vector<Net>& patches) : patches_(patches), seams_(find_seams(patches)) {}

  Continuity run() {
    out_.seams = seams_.seams.size();
    out_.open_sides = seams_.open.size();
    out_.collapsed_sides = seams_.collapsed.size();
    out_.vertices = seams_.vertices.size();
    out_.orientable = seams_.orientable;
    const int budget = 100000 / static_cast<int>(std::max<std::size_t>(seams_.seams.size(), 1));
    steps_ = std::clamp(budget, 4, 32);
    out_.places = steps_ + 1;
    for (const Seam& seam : seams_.seams) along(seam);
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

  const Net& net(int patch) const { return patches_[static_cast<std::size_t>(patch)]; }
  double sign(int patch) const { return seams_.turned[static_cast<std::size_t>(patch)] ? -1.0 : 1.0; }

  dvec3 place(const PatchSide& s, double t) const { return point_on_side(net(s.patch), s.side, t); }

  void along(const Seam& seam) {
    for (int k = 0; k <= steps_; ++k) {
      const double s = static_cast<double>(k) / steps_;
      const dvec3 p = place(seam.a, s);
      const int a = seam.a.patch, b = seam.b.patch;
      const double t = foot_on_side(net(b), seam.b.side, p, seam.reversed ? 1.0 - s : s).t;
      const auto at = [&](WorstAt& worst, double value) { raise(worst, value, a, b, p); };
      at(out_.gap, glm::distance(p, place(seam.b, t)));
      const dvec2 ua = side_point(net(a), seam.a.side, s), ub = side_point(net(b), seam.b.side, t);
      const double turn = seam.reversed ? 1.0 : -1.0;
      const dvec3 na = unit_normal(net(a), ua.x, ua.y), nb = turn * unit_normal(net(b), ub.x, ub.y);
      if (na == dvec3(0.0) || nb == dvec3(0.0)) continue;
      at(out_.tangent, angle_between(na, nb));
      if (k == 0 || k == steps_) continue;
      const Curvature ca = curvature(net(a), ua.x, ua.y), cb = curvature(net(b), ub.x, ub.y);
      at(out_.mean, std::abs(ca.mean - turn * cb.mean));
      at(out_.gaussian, std::abs(ca.gaussian - cb.gaussian));
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
      sum += a == dvec3(0.0) || b == dvec3(0.0) ? INFINITY : angle_between(a, b);
      const dvec3 n = sign(corner.patch) * unit_normal(patch, here.x, here.y);
      if (n != dvec3(0.0)) normals.emplace_back(corner.patch, n);
    }
    const int first = vertex.corners.front().patch;
    raise(out_.vertex_sum, std::abs(sum - 360.0), first, first, point);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      for (std::size_t j = i + 1; j < normals.size(); ++j) {
        const double angle = angle_between(normals[i].second, normals[j].second);
        // Where there are no two sides, normals are lines.
        raise(out_.vertex, seams_.orientable ? angle : std::min(angle, 180.0 - angle), normals[i].first,
              normals[j].first, point);
      }
    }
  }
};

}  // namespace

Continuity continuity_of(const Surface& surface) {
  Continuity out = Meter(surface.patches).run();
  for (WorstAt* worst : {&out.gap, &out.tangent, &out.mean, &out.gaussian, &out.vertex, &out.vertex_sum}) {
    worst->point += surface.origin;
  }
  return out;
}

}  // namespace rondure
