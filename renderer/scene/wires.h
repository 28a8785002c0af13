// Curves drawn as round tubes with balls at their ends, each once however often it is asked for.
#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "renderer/bezier/rational_curve.h"

namespace rondure {

class Wires {
 public:
  explicit Wires(double radius) : radius_(radius) {}

  // A curve with finite points (see is_finite); balls at its ends of so many radii, none for 0. A curve that
  // is one point leaves its ball only. Throws what curve_tube throws. Curves with the same ends and middle
  // count as the same.
  void add(const RationalCurve& curve, double end_balls);
  void add_ball(const dvec3& point, double balls);

  std::size_t size() const { return tubes_.size() + 6 * balls_.size(); }  // of nets()
  std::vector<Net> nets() const;  // curves in the order in which they came, then balls

 private:
  using Place = std::array<double, 3>;

  double radius_;
  std::vector<Net> tubes_;
  std::set<std::array<Place, 3>> drawn_;
  std::vector<std::pair<dvec3, double>> balls_;  // centre, radii
  std::map<Place, std::size_t> ball_at_;

  Place place(const dvec3& point) const;
};

}  // namespace rondure
