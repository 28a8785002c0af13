#include "surfaces/iss_arcs.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/tube.h"
#include "renderer/inverse_spherical/modelling.h"
#include "renderer/projective/ball.h"

namespace rondure {
namespace {

void check_ends(const Params& arc, const dvec3& from, const dvec3& to) {
  const double length = glm::length(from) * glm::length(to);
  // Directions closer to parallel than this leave the great circle through them to rounding.
  if (!(length > 0.0) || !(glm::length(glm::cross(from, to)) > 1e-12 * length)) {
    arc.fail("\"from\" and \"to\" must be directions that are neither parallel nor opposite");
  }
}

// Pieces of one arc, as they follow each other over the patches; a tip that two of them share gets one ball.
class Wire {
 public:
  Wire(double radius, std::vector<Net>& out) : radius_(radius), out_(out) {}

  void add(const InverseCircularCurve& curve) {
    const CurveTube tube = curve_tube(curve.control_points(), radius_);
    append(tube.nets);
    for (const double t : {0.0, 1.0}) add_tip(curve.point(t));
  }
  bool empty() const { return tips_.empty(); }

 private:
  void append(const std::vector<TensorNet>& nets) {
    for (const TensorNet& net : nets) out_.emplace_back(net);
  }
  void add_tip(const dvec3& tip) {
    for (const dvec3& other : tips_)
      if (glm::distance(tip, other) < tube_accuracy * radius_) return;
    tips_.push_back(tip);
    append(ball(tip, radius_));
  }

  double radius_;
  std::vector<Net>& out_;
  std::vector<dvec3> tips_;
};

}  // namespace

void add_iss_arcs(Params& params, const std::vector<IssPatch>& patches, double wire, std::vector<Net>& out) {
  if (!params.has("arcs")) return;
  for (Params& arc : params.objects("arcs")) {
    const dvec3 from = arc.vec3("from"), to = arc.vec3("to");
    arc.finish();
    check_ends(arc, from, to);
    Wire drawn(wire, out);
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const auto* planar = std::get_if<PlanarIss>(&patches[k]);
      if (!planar) {
        arc.fail(
            fmt::format("patch {} has no planar projection domain, so that over a great-circle arc it is no "
                        "inverse circular curve (Casciola and Morigi 2004, Remark 7.1)",
                        k));
      }
      if (const auto curve = along_arc(*planar, from, to)) drawn.add(*curve);
    }
    if (drawn.empty()) arc.fail("the arc passes by every patch");
  }
}

}  // namespace rondure
