// Pieces of patches are the patch: restriction, halving, splitting, derivative nets, elevation.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/bezier/elevate.h"
#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// De Casteljau in [0, 1] adds at most 1.5 epsilon a step to coefficients below 1.5, and there are m + n
// steps; the two evaluations add (degree + 8) epsilon each. Derivatives multiply that by twice the degree.
double tolerance(int degree) { return 4.0 * (degree + 8) * epsilon; }

double length(const dvec4& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(p.w)});
}

}  // namespace

TEST_CASE("restricted and halved tensor nets are the original", "[bezier]") {
  NetMaker make(31);
  WorstCase worst;
  int differ = 0;
  for (int k = 0; k < 100; ++k) {
    const int m = 1 + k % 12, n = 1 + (k / 3) % 12;
    const TensorNet net = make.tensor(m, n);
    const dvec4* p = net.points.data();
    const double u0 = make.uniform(0.0, 1.0), u1 = make.uniform(0.0, 1.0);
    const double v0 = make.uniform(0.0, 1.0), v1 = make.uniform(0.0, 1.0);
    TensorNet part(m, n), next(m, n), low(m, n), high(m, n), half(m, n);
    tensor_restrict(p, m, n, u0, u1, v0, v1, part.points.data());
    tensor_restrict(p, m, n, u1, 0.3, v0, v1, next.points.data());
    for (int j = 0; j <= n; ++j) {
      if (part.at(m, j) != next.at(0, j)) ++differ;
    }
    const auto compare = [&](const dvec4& a, const dvec4& b, const char* what) {
      worst.add(length(a - b), tolerance(m + n),
                [&] { return fmt::format("{} of degree ({}, {})", what, m, n); });
    };
    for (int sample = 0; sample < 8; ++sample) {
      const double s = make.uniform(0.0, 1.0), t = make.uniform(0.0, 1.0);
      compare(tensor_value(part.points.data(), m, n, s, t),
              tensor_value(p, m, n, u0 + s * (u1 - u0), v0 + t * (v1 - v0)), "restriction");
      tensor_halve_u(p, m, n, low.points.data(), high.points.data());
      compare(tensor_value(low.points.data(), m, n, s, t), tensor_value(p, m, n, 0.5 * s, t), "low u");
      compare(tensor_value(high.points.data(), m, n, s, t), tensor_value(p, m, n, 0.5 + 0.5 * s, t),
              "high u");
      tensor_halve_v(p, m, n, low.points.data(), high.points.data());
      compare(tensor_value(low.points.data(), m, n, s, t), tensor_value(p, m, n, s, 0.5 * t), "low v");
      compare(tensor_value(high.points.data(), m, n, s, t), tensor_value(p, m, n, s, 0.5 + 0.5 * t),
              "high v");
    }
    tensor_restrict(p, m, n, 0.0, 1.0, 0.0, 0.5, half.points.data());
    tensor_halve_v(p, m, n, low.points.data(), high.points.data());
    for (std::size_t c = 0; c < half.points.size(); ++c) compare(half.points[c], low.points[c], "half");
  }
  INFO(worst.text());
  CHECK(differ == 0);
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a net survives extrapolation and back", "[bezier]") {
  NetMaker make(32);
  const TensorNet net = make.tensor(4, 3);
  TensorNet wide(4, 3), back(4, 3);
  tensor_restrict(net.points.data(), 4, 3, -1.0, 2.0, 3.0, -1.0, wide.points.data());
  tensor_restrict(wide.points.data(), 4, 3, 1.0 / 3.0, 2.0 / 3.0, 0.75, 0.5, back.points.data());
  double worst = 0.0;
  for (std::size_t k = 0; k < net.points.size(); ++k)
    worst = std::max(worst, length(net.points[k] - back.points[k]));
  // Extrapolation to three and four times the range grows coefficients by up to 5^4 7^3, and their errors
  // too.
  CHECK(worst < 1e5 * 8.0 * epsilon);
}

TEST_CASE("restricted and split triangles are the original", "[bezier]") {
  NetMaker make(33);
  WorstCase worst;
  for (int k = 0; k < 60; ++k) {
    const int n = 1 + k % 12;
    const TriangleNet net = make.triangle(n);
    const dvec4* p = net.points.data();
    TriangleNet a(n), b(n), c(n), d(n);
    // Corners of a piece, and the piece.
    const auto compare = [&](const TriangleNet& piece, dvec2 cu, dvec2 cv, dvec2 cw, const char* what) {
      for (int sample = 0; sample < 6; ++sample) {
        const dvec2 at = make.in_triangle();
        const dvec2 from = at.x * cu + at.y * cv + (1.0 - at.x - at.y) * cw;
        const dvec4 error =
            triangle_value(piece.points.data(), n, at.x, at.y) - triangle_value(p, n, from.x, from.y);
        worst.add(length(error), tolerance(2 * n), [&] { return fmt::format("{} of degree {}", what, n); });
      }
    };
    const dvec2 cu(1.0, 0.0), cv(0.0, 1.0), cw(0.0, 0.0);
    const dvec2 corners[3] = {make.in_triangle(), make.in_triangle(), make.in_triangle()};
    triangle_restrict(p, n, corners, a.points.data());
    compare(a, corners[0], corners[1], corners[2], "restriction");
    const dvec2 at = make.in_triangle();
    triangle_split_at(p, n, at.x, at.y, a.points.data(), b.points.data(), c.points.data());
    compare(a, at, cv, cw, "split at u");
    compare(b, cu, at, cw, "split at v");
    compare(c, cu, cv, at, "split at w");
    triangle_bisect(p, n, a.points.data(), b.points.data());
    compare(a, cu, dvec2(0.5), cw, "low half");
    compare(b, dvec2(0.5), cv, cw, "high half");
    triangle_quarter(p, n, a.points.data(), b.points.data(), c.points.data(), d.points.data());
    compare(a, cu, {0.5, 0.5}, {0.5, 0.0}, "quarter u");
    compare(b, {0.5, 0.5}, cv, {0.0, 0.5}, "quarter v");
    compare(c, {0.5, 0.0}, {0.0, 0.5}, cw, "quarter w");
    compare(d, {0.0, 0.5}, {0.5, 0.0}, {0.5, 0.5}, "middle quarter");
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("derivative nets are the derivatives, elevated nets the original", "[bezier]") {
  NetMaker make(34);
  WorstCase worst;
  for (int k = 0; k < 48; ++k) {
    const int m = 1 + k % 12, n = 1 + (k / 5) % 12;
    const TensorNet net = make.tensor(m, n);
    const TriangleNet triangle = make.triangle(n);
    const dvec4* p = net.points.data();
    const dvec4* q = triangle.points.data();
    TensorNet du(m - 1, n), dv(m, n - 1), up(m + 1, n), vp(m, n + 1);
    TriangleNet tu(n - 1), tv(n - 1), tp(n + 1);
    tensor_derivative_u(p, m, n, du.points.data());
    tensor_derivative_v(p, m, n, dv.points.data());
    tensor_elevate_u(p, m, n, up.points.data());
    tensor_elevate_v(p, m, n, vp.points.data());
    triangle_derivative_u(q, n, tu.points.data());
    triangle_derivative_v(q, n, tv.points.data());
    triangle_elevate(q, n, tp.points.data());
    const dvec2 at = make.in_triangle();
    const auto f = tensor_first(p, m, n, at.x, at.y);
    const auto g = triangle_first(q, n, at.x, at.y);
    const auto compare = [&](const dvec4& a, const dvec4& b, double factor, const char* what) {
      worst.add(length(a - b), factor * tolerance(m + n),
                [&] { return fmt::format("{} of degree ({}, {})", what, m, n); });
    };
    compare(tensor_value(du.points.data(), m - 1, n, at.x, at.y), f.du, 2.0 * m, "d/du");
    compare(tensor_value(dv.points.data(), m, n - 1, at.x, at.y), f.dv, 2.0 * n, "d/dv");
    compare(tensor_value(up.points.data(), m + 1, n, at.x, at.y), f.value, 1.0, "elevation in u");
    compare(tensor_value(vp.points.data(), m, n + 1, at.x, at.y), f.value, 1.0, "elevation in v");
    compare(triangle_value(tu.points.data(), n - 1, at.x, at.y), g.du, 2.0 * n, "triangle d/du");
    compare(triangle_value(tv.points.data(), n - 1, at.x, at.y), g.dv, 2.0 * n, "triangle d/dv");
    compare(triangle_value(tp.points.data(), n + 1, at.x, at.y), g.value, 1.0, "triangle elevation");
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

}  // namespace rondure
