#include "renderer/projective/cube_faces.h"

namespace rondure {
namespace {

// Turns of the south face. All have determinant 1.
constexpr AxisRotation face_rotations[6] = {{{0, 1, 2}, {1.0, 1.0, 1.0}},  {{0, 1, 2}, {1.0, -1.0, -1.0}},
                                            {{2, 1, 0}, {-1.0, 1.0, 1.0}}, {{2, 1, 0}, {1.0, 1.0, -1.0}},
                                            {{0, 2, 1}, {1.0, -1.0, 1.0}}, {{0, 2, 1}, {1.0, 1.0, -1.0}}};

}  // namespace

TensorNet rotated(const TensorNet& net, const AxisRotation& turn) {
  TensorNet out = net;
  for (std::size_t k = 0; k < out.points.size(); ++k) {
    // Adding 0 makes every zero positive, so that equal control points are equal in their bits.
    for (int c = 0; c < 3; ++c) out.points[k][c] = turn.sign[c] * net.points[k][turn.from[c]] + 0.0;
  }
  return out;
}

std::vector<Net> cube_of(const TensorNet& south) {
  std::vector<Net> patches;
  for (const AxisRotation& turn : face_rotations) patches.emplace_back(rotated(south, turn));
  return patches;
}

TensorNet cube_face_2_4() {
  const long double r2 = 1.414213562373095048801688724209698079L;
  const long double r3 = 1.732050807568877293527446341505872367L;
  const long double r6 = 2.449489742783178098197284074705891392L;
  // Half of a row along x, which the reflection x -> -x completes. The row u = 1 is u = 0 with y -> -y.
  struct Point {
    long double x, y, z, w;
  };
  const Point edge[3] = {{-r3 / 3, -r3 / 3, -r3 / 3, 1},
                         {-0.25L, -(1 + r2) / 4, -(1 + r2) / 4, r3 / 4 + r6 / 6},
                         {0, -(r3 / 9 + r6 / 6), -(r3 / 9 + r6 / 6), (1 + r2) / 3}};
  const Point middle[3] = {{-r2 / 2, 0, -r2 / 2, r6 / 3},
                           {-(r3 + r6) / 12, 0, -(r3 / 4 + r6 / 6), (1 + r2) / 4},
                           {0, 0, -(2.0L / 3 + r2 / 6), 2 * r3 / 9 + r6 / 18}};
  TensorNet net(2, 4);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const Point& p = (i == 1 ? middle : edge)[j <= 2 ? j : 4 - j];
      const long double x = j <= 2 ? p.x : -p.x, y = i <= 1 ? p.y : -p.y;
      net.at(i, j) = dvec4(static_cast<double>(x), static_cast<double>(y), static_cast<double>(p.z),
                           static_cast<double>(p.w));
    }
  }
  return net;
}

}  // namespace rondure
