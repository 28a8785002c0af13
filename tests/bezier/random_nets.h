// Nets with random control points, for tests.
#pragma once

#include <random>

#include "renderer/api/patch.h"

namespace rondure {

class NetMaker {
 public:
  explicit NetMaker(unsigned seed) : engine_(seed) {}

  // Uniform in [low, high): the same on every platform, unlike the standard distributions.
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  // Coordinates w x in [-1, 1), weights in [low, high).
  dvec4 point(double low = 0.5, double high = 1.5) {
    dvec4 p(0.0);
    for (int c = 0; c < 3; ++c) p[c] = uniform(-1.0, 1.0);
    p.w = uniform(low, high);
    return p;
  }

  TensorNet tensor(int m, int n, double low = 0.5, double high = 1.5) {
    TensorNet net(m, n);
    for (dvec4& p : net.points) p = point(low, high);
    return net;
  }

  TriangleNet triangle(int n, double low = 0.5, double high = 1.5) {
    TriangleNet net(n);
    for (dvec4& p : net.points) p = point(low, high);
    return net;
  }

  // Parameters in the closed triangle.
  dvec2 in_triangle() {
    const double u = uniform(0.0, 1.0);
    const double v = uniform(0.0, 1.0);
    return u + v <= 1.0 ? dvec2(u, v) : dvec2(1.0 - u, 1.0 - v);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rondure
