#include "renderer/complex/octahedron_atlas.h"

namespace rondure {
namespace {

constexpr int axis_bit(int axis) { return 4 >> axis; }

// +1 or -1 by axis: where the two octants differ.
dvec3 flips(int i, int j) {
  dvec3 s(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    if (((i ^ j) & axis_bit(axis)) != 0) s[axis] = -1.0;
  }
  return s;
}

}  // namespace

dvec3 transition(int i, int j, const dvec3& b) {
  const dvec3 x = flips(i, j) * b;
  return x / (x.x + x.y + x.z);
}

glm::dmat2 transition_derivative(int i, int j, const dvec3& b) {
  const dvec3 s = flips(i, j);
  const double sum = s.x * b.x + s.y * b.y + s.z * b.z;
  glm::dmat2 d;
  for (int column = 0; column < 2; ++column) {
    // Moving by e_column - e_3.
    const double slope = s[column] - s.z;
    for (int row = 0; row < 2; ++row) {
      d[column][row] = (s[row] * (row == column ? 1.0 : 0.0) * sum - s[row] * b[row] * slope) / (sum * sum);
    }
  }
  return d;
}

bool in_chart(const OctantChart& chart, const dvec3& b) {
  const double x = b[chart.part], y = b[(chart.part + 1) % 3], z = b[(chart.part + 2) % 3];
  if (chart.kind == OctantChart::Kind::inside) return b.x > 0.0 && b.y > 0.0 && b.z > 0.0;
  if (chart.kind == OctantChart::Kind::edge) return z * z < x * y;
  return y * y + z * z < x * x / 9.0;
}

OctantPoint chart_point(const OctantChart& chart, const dvec3& b) {
  int octant = chart.octant;
  for (int axis = 0; axis < 3; ++axis) {
    if (b[axis] < 0.0) octant ^= axis_bit(axis);
  }
  return {octant, transition(chart.octant, octant, b)};
}

dvec3 chart_coordinates(const OctantChart& chart, const OctantPoint& point) {
  return transition(point.octant, chart.octant, point.barycentric);
}

}  // namespace rondure
