// The unit sphere in biquartic patches: two hemispheres (Cobb 1988, Table 2) or six faces of a cube (Table
// 4). Neighbours share the control points of their common edge bit for bit, in reverse order.
#include <string>

#include "renderer/api/registry.h"
#include "surfaces/families.h"
#include "surfaces/stereographic_patch.h"

namespace rondure {
namespace {

// The square of circular arcs that projects to the cube's face around the south pole (Cobb 1988, Figure 4).
PlanarBiquadratic cube_square(long double middle_weight) {
  const long double r2 = 1.414213562373095048801688724209698079L;
  const long double r3 = 1.732050807568877293527446341505872367L;
  const long double a = r3 - 1;
  const long double e = (3 - r3) * r2 / 2;
  const long double w = (r3 + 1) * r2 / 4;
  const long double c = middle_weight;
  return {{{-a, 0, a}, {-e, 0, e}, {-a, 0, a}},
          {{-a, -e, -a}, {0, 0, 0}, {a, e, a}},
          {{1, w, 1}, {w, c, w}, {1, w, 1}}};
}

// A signed permutation of the axes: coordinate c of the image is sign[c] times coordinate from[c].
struct AxisRotation {
  int from[3];
  double sign[3];
};

// Turns of the south face (about -z) to the faces about -z, +z, +x, -x, +y, -y. All have determinant 1.
constexpr AxisRotation face_rotations[6] = {
    {{0, 1, 2}, {1.0, 1.0, 1.0}},  {{0, 1, 2}, {1.0, -1.0, -1.0}}, {{2, 1, 0}, {-1.0, 1.0, 1.0}},
    {{2, 1, 0}, {1.0, 1.0, -1.0}}, {{0, 2, 1}, {1.0, -1.0, 1.0}},  {{0, 2, 1}, {1.0, 1.0, -1.0}}};

TensorNet rotated(const TensorNet& net, const AxisRotation& turn) {
  TensorNet out = net;
  for (std::size_t k = 0; k < out.points.size(); ++k) {
    // Adding 0 makes every zero positive, so that equal control points are equal in their bits.
    for (int c = 0; c < 3; ++c) out.points[k][c] = turn.sign[c] * net.points[k][turn.from[c]] + 0.0;
  }
  return out;
}

Surface build(Params& params) {
  const std::string topology = params.choice("topology", {"hemispheres", "cube"}, "cube");
  const double middle = params.number("middle_weight", 1.0, Range::positive());
  Surface surface;
  surface.closed = true;
  if (topology == "cube") {
    const TensorNet south = sphere_patch(cube_square(middle), 1);
    for (const AxisRotation& turn : face_rotations) surface.patches.push_back(rotated(south, turn));
  } else {
    const TensorNet south = sphere_patch(disk(2, middle), 1);
    // A half turn about x = y, z = 0: the boundary maps to itself and the net keeps its orientation.
    const AxisRotation half_turn{{1, 0, 2}, {1.0, 1.0, -1.0}};
    surface.patches.push_back(rotated(south, AxisRotation{{0, 1, 2}, {1.0, 1.0, 1.0}}));
    surface.patches.push_back(rotated(south, half_turn));
  }
  return surface;
}

}  // namespace

void register_sphere_tiling(Registry& registry) {
  registry.add(SurfaceFamily{
      "sphere_tiling",
      "the whole unit sphere in biquartic patches (Cobb 1988, Tables 2 and 4)",
      {{"topology", "\"hemispheres\" or \"cube\"", "\"cube\"",
        "two hemispheres, singular at four points of the equator, or six regular faces"},
       {"middle_weight", "number > 0", "1",
        "weight of the planar patch's middle control point; moves parameters, not the surface"}},
      build});
}

}  // namespace rondure
