#include "renderer/intersect/leaf_arithmetic.h"

#include <cmath>
#include <cstring>

#include "renderer/bezier/dispatch.h"

namespace rondure {
namespace {

#define COMPILED_FOR_EACH_SET "renderer/intersect/leaf_arithmetic-inl.h"
#include "renderer/intersect/each_set-inl.h"

template <class Shape>
LeafArithmetic<Shape> arithmetic_by(const Shape& shape, [[maybe_unused]] Instructions set) {
#ifdef __x86_64__
  if (set == Instructions::avx2) return avx2::arithmetic_for(shape);
#endif
  return baseline::arithmetic_for(shape);
}

void add(LeafParameters& out, dvec2 p, const dvec3& squares) {
  out.linear.push_back(dvec4(p, 0.0, 1.0));
  for (int k = 0; k < 3; ++k) out.squares[k].push_back(squares[k]);
}

void fill_lanes(LeafParameters& out) {
  for (std::vector<double>& s : out.squares)
    while (s.size() % LeafParameters::lanes != 0) s.push_back(s.back());
}

double part(int k, int n) { return static_cast<double>(k) / n; }

}  // namespace

LeafParameters parameters_of(const TensorShape& shape) {
  LeafParameters out;
  out.has_squares = shape.m > 1 && shape.n > 1;
  const auto square = [&](int n, double t) {  // (t - 1/2)^2 less its value at the coefficient's place
    const double a = t - 0.5;
    return out.has_squares ? a * a - t * (1.0 - t) / (n - 1) : 0.0;
  };
  for (int i = 0; i <= shape.m; ++i)
    for (int j = 0; j <= shape.n; ++j) {
      const dvec2 t(part(i, shape.m), part(j, shape.n)), p = t - 0.5;
      add(out, p, {square(shape.m, t.x), p.x * p.y, square(shape.n, t.y)});
    }
  fill_lanes(out);
  return out;
}

LeafParameters parameters_of(const TriangleShape& shape) {
  LeafParameters out;
  out.has_squares = shape.n > 1;
  const double rest = out.has_squares ? 1.0 / (shape.n - 1.0) : 0.0;
  for (int i = 0; i <= shape.n; ++i)
    for (int j = 0; j <= shape.n - i; ++j) {
      const double u = part(i, shape.n), v = part(j, shape.n);
      const dvec2 p = dvec2(u, v) - 1.0 / 3.0;
      add(out, p,
          {p.x * p.x - u * (1.0 - u) * rest, p.x * p.y + u * v * rest, p.y * p.y - v * (1.0 - v) * rest});
    }
  fill_lanes(out);
  return out;
}

LeafArithmetic<TensorShape> leaf_arithmetic(const TensorShape& shape, Instructions set) {
  return arithmetic_by(shape, set);
}
LeafArithmetic<TriangleShape> leaf_arithmetic(const TriangleShape& shape, Instructions set) {
  return arithmetic_by(shape, set);
}

}  // namespace rondure
