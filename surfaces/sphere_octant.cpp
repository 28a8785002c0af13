// Octants of the unit sphere as surfaces of revolution: biquadratic, with the edge v = 1 collapsed to a pole
// (Cobb 1988, section 1).
#include <algorithm>

#include "renderer/api/registry.h"
#include "renderer/bezier/transform.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

constexpr double half_root = 0.70710678118654752440;

// The quarter circle from (1, 0) to (0, 1): (x, y, w).
constexpr double quarter_circle[3][3] = {{1.0, 0.0, 1.0}, {half_root, half_root, half_root}, {0.0, 1.0, 1.0}};

// Product of quarter circles, in longitude along u and in latitude along v. The middle weight is the exact
// 1/2.
TensorNet first_octant() {
  const auto product = [](double a, double b) { return a == half_root && b == half_root ? 0.5 : a * b; };
  TensorNet net(2, 2);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j) {
      const double* c = quarter_circle[i];
      const double* p = quarter_circle[j];
      net.at(i, j) = {product(c[0], p[0]), product(c[1], p[0]), product(c[2], p[1]), product(c[2], p[2])};
    }
  }
  return net;
}

// Bits 0, 1, 2 of the index mirror x, y, z.
Net octant(std::int64_t index) {
  dmat4 mirror(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    if ((index >> axis & 1) != 0) mirror[axis][axis] = -1.0;
  }
  return transformed(first_octant(), mirror);
}

Surface build_sphere_octant(Params& params) {
  std::vector<std::int64_t> list{0, 1, 2, 3, 4, 5, 6, 7};
  if (params.has("octants")) list = params.integers("octants", 0, 7);
  if (list.empty()) params.fail("octants", "octants is empty: name at least one of 0 to 7");
  std::vector<std::int64_t> sorted = list;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    params.fail("octants", "an octant is listed twice");
  }
  Surface surface;
  for (const std::int64_t index : list) surface.patches.push_back(octant(index));
  surface.closed = list.size() == 8;
  return surface;
}

}  // namespace

void register_sphere_octant(Registry& registry) {
  registry.add(SurfaceFamily{
      "sphere_octant",
      "octants of the unit sphere, biquadratic, one edge collapsed to a pole (Cobb 1988, section 1)",
      {{"octants", "array of distinct integers 0 to 7", "[0, 1, 2, 3, 4, 5, 6, 7]",
        "which octants; bits 0, 1, 2 (values 1, 2, 4) make x, y, z negative"}},
      build_sphere_octant});
}

}  // namespace rondure
