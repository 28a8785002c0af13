#include "renderer/complex/gc_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/bezier/index.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/bezier/triangle_keys.h"

namespace rondure {
namespace {

bool same(const PolygonPolynomial& a, const PolygonPolynomial& b) {
  return a.degree == b.degree && a.coefficients == b.coefficients;
}

double value_at(const PolygonPolynomial& p, double u, double v) {
  std::vector<double> c;
  for (const Exact& x : p.coefficients) c.push_back(rounded(x));
  return p.sides == 3 ? triangle_value(c.data(), p.degree, u, v)
                      : tensor_value(c.data(), p.degree, p.degree, u, v);
}

}  // namespace

GcFunction constant_function(const SurfaceComplex& complex, const Exact& value) {
  GcFunction f;
  for (const int sides : complex.sides) {
    f.numerators.push_back(constant_polynomial(sides, value));
    f.denominators.push_back(constant_polynomial(sides, 1));
  }
  return f;
}

GcFunction operator*(const GcFunction& f, const GcFunction& g) {
  GcFunction out;
  for (std::size_t k = 0; k < f.numerators.size(); ++k) {
    out.numerators.push_back(f.numerators[k] * g.numerators[k]);
    out.denominators.push_back(f.denominators[k] * g.denominators[k]);
  }
  return out;
}

GcFunction add(const GcFunction& f, const GcFunction& g, const Exact& factor) {
  GcFunction out;
  for (std::size_t k = 0; k < f.numerators.size(); ++k) {
    if (same(f.denominators[k], g.denominators[k])) {
      out.numerators.push_back(add(f.numerators[k], g.numerators[k], factor));
      out.denominators.push_back(f.denominators[k]);
      continue;
    }
    out.numerators.push_back(
        add(f.numerators[k] * g.denominators[k], g.numerators[k] * f.denominators[k], factor));
    out.denominators.push_back(f.denominators[k] * g.denominators[k]);
  }
  return out;
}

GcFunction quotient(const GcFunction& f, const GcFunction& g) {
  GcFunction out;
  for (std::size_t k = 0; k < f.numerators.size(); ++k) {
    if (same(f.denominators[k], g.denominators[k])) {
      out.numerators.push_back(f.numerators[k]);
      out.denominators.push_back(g.numerators[k]);
      continue;
    }
    out.numerators.push_back(f.numerators[k] * g.denominators[k]);
    out.denominators.push_back(f.denominators[k] * g.numerators[k]);
  }
  return out;
}

namespace {

JoinDefect defect_of(const EdgeJoin& join, const GcFunction& f) {
  const std::size_t p = index(join.p.polygon), q = index(join.q.polygon);
  return join_defect(join, f.numerators[p], f.denominators[p], f.numerators[q], f.denominators[q]);
}

}  // namespace

bool is_gc1(const SurfaceComplex& complex, const GcFunction& f) {
  return std::all_of(complex.joins.begin(), complex.joins.end(), [&](const EdgeJoin& join) {
    const JoinDefect d = defect_of(join, f);
    return d.value.zero() && d.derivative.zero();
  });
}

GcDefect gc1_defect(const SurfaceComplex& complex, const GcFunction& f) {
  GcDefect worst;
  for (const EdgeJoin& join : complex.joins) {
    const JoinDefect d = defect_of(join, f);
    for (int k = 0; k <= 16; ++k) {
      const Exact s = Exact(k) / 16;
      worst.value = std::fmax(worst.value, std::abs(rounded(d.value.at(s))));
      worst.derivative = std::fmax(worst.derivative, std::abs(rounded(d.derivative.at(s))));
    }
  }
  return worst;
}

double value_at(const GcFunction& f, int polygon, double u, double v) {
  return value_at(f.numerators[index(polygon)], u, v) / value_at(f.denominators[index(polygon)], u, v);
}

GcFunction function_of(const GcBasis& basis, std::size_t k) {
  return {basis.functions[k], basis.denominators};
}

GcBasis basis_of(const SurfaceComplex& complex, const SplineSpace& space) {
  GcBasis basis;
  const int polygons = static_cast<int>(complex.sides.size());
  for (int p = 0; p < polygons; ++p) {
    basis.denominators.push_back(space.denominators.empty() ? constant_polynomial(complex.sides[index(p)], 1)
                                                            : space.denominators[index(p)]);
  }
  for (std::size_t k = 0; k < space.dimension(); ++k) {
    std::vector<PolygonPolynomial> numerators;
    for (int p = 0; p < polygons; ++p) numerators.push_back(numerator_of(complex, space, k, p));
    basis.functions.push_back(std::move(numerators));
    const int unknown = space.solutions.free[k];
    const auto after = std::upper_bound(space.offsets.begin(), space.offsets.end(), unknown);
    const int polygon = static_cast<int>(after - space.offsets.begin()) - 1;
    const int sides = complex.sides[index(polygon)];
    const auto e = exponents_of(sides, space.degree, unknown - space.offsets[index(polygon)]);
    basis.names.push_back(fmt::format(
        "{}:{}", polygon,
        sides == 3 ? triangle_key_name(space.degree, e[0], e[1]) : fmt::format("{},{}", e[0], e[1])));
  }
  return basis;
}

}  // namespace rondure
