// A net as the exact numbers that its doubles are.
#pragma once

#include "renderer/api/patch.h"
#include "tests/oracle/line.h"

namespace rondure::oracle {

// The net as two pairs of polynomials: (wx, wy) and (wz, w).
struct ExactNet {
  PolynomialPair xy, zw;

  explicit ExactNet(const Net& net) {
    Degrees d;
    if (const auto* tensor = std::get_if<TensorNet>(&net))
      d = {false, tensor->m, tensor->n};
    else
      d = {true, std::get<TriangleNet>(net).n, std::get<TriangleNet>(net).n};
    xy.degrees = zw.degrees = d;
    for (const dvec4& p : points_of(net)) xy.c.push_back({p.x, p.y}), zw.c.push_back({p.z, p.w});
  }

  // Point and derivatives in space, w divided out.
  struct Place {
    Real3 point, du, dv;
  };
  Place at(const Real& u, const Real& v) const {
    const Real2 a = xy(u, v), b = zw(u, v);
    Place out;
    out.point = {a[0] / b[1], a[1] / b[1], b[0] / b[1]};
    for (int k = 0; k < 2; ++k) {
      const Real2 da = xy.derivative(k)(u, v), db = zw.derivative(k)(u, v);
      const Real3 s{da[0], da[1], db[0]};
      for (std::size_t j = 0; j < 3; ++j)
        (k == 0 ? out.du : out.dv)[j] = (s[j] - out.point[j] * db[1]) / b[1];
    }
    return out;
  }
};

}  // namespace rondure::oracle
