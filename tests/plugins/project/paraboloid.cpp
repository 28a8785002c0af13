// The elliptic paraboloid z = height (x^2 + y^2) over the square [-1, 1]^2, as one biquadratic patch.
#include "renderer/api/registry.h"

namespace rondure {

void register_paraboloid(Registry& registry) {
  SurfaceFamily family;
  family.name = "paraboloid";
  family.summary = "z = height (x^2 + y^2) over a square, from a plugin";
  family.parameters = {{"height", "number", "1", "z per unit of x^2 + y^2"}};
  family.build = [](Params& params) {
    const double height = params.number("height", 1.0, {});
    constexpr double line[3] = {-1.0, 0.0, 1.0};    // x = 2u - 1 in the Bernstein basis of degree 2
    constexpr double square[3] = {1.0, -1.0, 1.0};  // x^2 in the same basis
    TensorNet net(2, 2);
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= 2; ++j)
        net.at(i, j) = dvec4(line[i], line[j], height * (square[i] + square[j]), 1.0);
    Surface surface;
    surface.patches.push_back(net);
    return surface;
  };
  registry.add(family);
}

}  // namespace rondure
