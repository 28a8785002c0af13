#include "renderer/complex/octahedron_bases.h"

#include "renderer/api/patch.h"
#include "renderer/bezier/index.h"
#include "renderer/complex/shipped.h"

namespace rondure {
namespace {

PolygonPolynomial quadratic(int i, int j, const Exact& coefficient) {
  PolygonPolynomial p{3, 2, std::vector<Exact>(6)};
  p.coefficients[index(triangle_index(2, i, j))] = coefficient;
  return p;
}

// The octant's sign on an axis: bits 2, 1, 0 of its number make the first, second, third negative.
int sign_of(int octant, int axis) { return (octant >> (2 - axis) & 1) != 0 ? -1 : 1; }

}  // namespace

GcBasis octahedron_splines(int n) {
  const SurfaceComplex complex = octahedron_complex();
  GcBasis basis = basis_of(complex, spline_space(complex, n));
  if (n != 3) return basis;
  for (std::size_t k = 0; k < basis.functions.size(); ++k) {
    basis.names[k] = "h" + std::to_string(k + 1);
    for (PolygonPolynomial& p : basis.functions[k]) {
      for (Exact& c : p.coefficients) c *= 12;
    }
  }
  return basis;
}

GcBasis octahedron_hierarchy() {
  const GcBasis cubic = octahedron_splines(3);
  // As combinations of h1 to h8; all of them add up to 12.
  struct Combination {
    const char* name;
    int factors[8];
  };
  static constexpr Combination combinations[] = {
      {"H0", {1, 1, 1, 1, 1, 1, 1, 1}},     {"Hx", {1, 1, 1, 1, -1, -1, -1, -1}},
      {"Hy", {1, 1, -1, -1, 1, 1, -1, -1}}, {"Hz", {1, -1, 1, -1, 1, -1, 1, -1}},
      {"H12", {1, -1, 0, 0, 0, 0, -1, 1}},  {"H34", {0, 0, 1, -1, -1, 1, 0, 0}},
      {"HC", {1, 0, -1, 0, -1, 0, 1, 0}},   {"HD", {0, 1, 0, -1, 0, -1, 0, 1}}};
  GcBasis basis;
  basis.denominators = cubic.denominators;
  for (const Combination& c : combinations) {
    std::vector<PolygonPolynomial> sum(8, PolygonPolynomial{3, 3, std::vector<Exact>(10)});
    for (int k = 0; k < 8; ++k) {
      const Exact factor = Exact(c.factors[k]) / (basis.names.empty() ? 12 : 1);
      for (std::size_t p = 0; p < 8; ++p) sum[p] = add(sum[p], cubic.functions[index(k)][p], factor);
    }
    basis.names.emplace_back(c.name);
    basis.functions.push_back(std::move(sum));
  }
  return basis;
}

GcBasis octahedron_rationals() {
  GcBasis basis;
  PolygonPolynomial squares{3, 2, std::vector<Exact>(6)};
  for (int k = 0; k < 3; ++k) squares = add(squares, quadratic(k == 0 ? 2 : 0, k == 1 ? 2 : 0, 1), 1);
  basis.denominators.assign(8, squares);
  // Vertices in the paper's order of letters, as axis and sign.
  static constexpr int vertices[6][2] = {{0, 1}, {1, 1}, {2, 1}, {2, -1}, {1, -1}, {0, -1}};
  for (int k = 0; k < 6; ++k) {
    const int axis = vertices[k][0];
    std::vector<PolygonPolynomial> f;
    for (int octant = 0; octant < 8; ++octant) {
      f.push_back(
          quadratic(axis == 0 ? 2 : 0, axis == 1 ? 2 : 0, sign_of(octant, axis) == vertices[k][1] ? 1 : 0));
    }
    basis.names.emplace_back(1, "ABCDEF"[k]);
    basis.functions.push_back(std::move(f));
  }
  static constexpr const char* pairs[3] = {"vw", "uw", "uv"};
  for (int without = 0; without < 3; ++without) {
    std::vector<PolygonPolynomial> f;
    for (int octant = 0; octant < 8; ++octant) {
      const int sign = sign_of(octant, (without + 1) % 3) * sign_of(octant, (without + 2) % 3);
      // u v is 2 u v times 1/2.
      f.push_back(quadratic(without == 0 ? 0 : 1, without == 1 ? 0 : 1, Exact(sign) / 2));
    }
    basis.names.emplace_back(pairs[without]);
    basis.functions.push_back(std::move(f));
  }
  return basis;
}

}  // namespace rondure
