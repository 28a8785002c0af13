#include "renderer/projective/quad_patch.h"

#include <cmath>

#include "renderer/projective/planar_jacobian.h"

namespace rondure {
namespace {

constexpr int most_doublings = 20;

// Where in the net the control points are, in order of the corners and of the arcs between them.
constexpr int corner_place[4][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
constexpr int arc_place[4][2] = {{1, 0}, {2, 1}, {1, 2}, {0, 1}};

void put(PlanarBiquadratic& planar, const int (&place)[2], const lvec3& p) {
  planar.x[place[0]][place[1]] = p.x;
  planar.y[place[0]][place[1]] = p.y;
  planar.w[place[0]][place[1]] = p.z;
}

}  // namespace

QuadPatch quad_patch(const SphericalQuad& quad, const QuadPatchOptions& options) {
  const StereographicFrame frame(options.centre);
  const bool unit = options.corner_weights == CornerWeights::unit;
  PlanarBiquadratic planar{};
  QuadPatch out{};
  lvec3 corner[4];
  long double mean = 0;
  for (int k = 0; k < 4; ++k) {
    corner[k] = frame.project(quad.corner(k), 1);
    mean += (unit ? 1 : corner[k].z) / 4;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const SphereArc& arc = quad.arc[k];
    const lvec3 p = corner[k], q = corner[(k + 1) % 4];
    put(planar, corner_place[k], unit ? p / p.z : p);
    put(planar, arc_place[k], frame.project(arc.b, arc.w) / (unit ? std::sqrt(p.z * q.z) : 1));
  }
  const lvec3 meet = glm::cross(glm::cross(corner[0], corner[2]), glm::cross(corner[1], corner[3]));
  const lvec3 middle = meet / meet.z;
  put(planar, {1, 1}, middle * (options.middle_weight * mean));
  const auto doublings =
      double_until_regular(planar, options.straight_corners, options.may_double ? most_doublings : 0);
  out.regular = doublings.has_value();
  out.doublings = doublings.value_or(0);
  out.net = sphere_patch(planar, frame);
  return out;
}

}  // namespace rondure
