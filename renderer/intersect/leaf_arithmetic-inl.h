// The arithmetic of leaves. Included by leaf_arithmetic.cpp once for each instruction set, within a namespace
// of its own; FOR_THIS_SET makes a function be compiled for that set.

#include "renderer/intersect/jets-inl.h"
#include "renderer/intersect/one_point-inl.h"

using Point = OnePoint::Point;

// As GLM's: `a` where b is no number.
#if POINT_IN_ONE_REGISTER
INLINE_FOR_THIS_SET Point larger(Point a, Point b) { return a < b ? b : a; }
INLINE_FOR_THIS_SET Point smaller(Point a, Point b) { return b < a ? b : a; }
INLINE_FOR_THIS_SET Point negative(Point a) { return -a; }
INLINE_FOR_THIS_SET Point divided(Point a, double b) { return a / b; }
INLINE_FOR_THIS_SET Point product(Point a, Point b) { return a * b; }
// (a + b + c + d) from the left, but for the third component: of the sums of the first and the last two.
INLINE_FOR_THIS_SET Point framed_sum(Point a, Point b, Point c, Point d) {
  const Point first = a + b;
  return __builtin_shufflevector((first + c) + d, first + (c + d), 0, 1, 6, 3);
}
#else
INLINE_FOR_THIS_SET Point larger(const Point& a, const Point& b) {
  return {a.low < b.low ? b.low : a.low, a.high < b.high ? b.high : a.high};
}
INLINE_FOR_THIS_SET Point smaller(const Point& a, const Point& b) {
  return {b.low < a.low ? b.low : a.low, b.high < a.high ? b.high : a.high};
}
INLINE_FOR_THIS_SET Point negative(const Point& a) { return {-a.low, -a.high}; }
INLINE_FOR_THIS_SET Point divided(const Point& a, double b) { return {a.low / b, a.high / b}; }
INLINE_FOR_THIS_SET Point product(const Point& a, const Point& b) { return {a.low * b.low, a.high * b.high}; }
INLINE_FOR_THIS_SET Point framed_sum(const Point& a, const Point& b, const Point& c, const Point& d) {
  return {((a.low + b.low) + c.low) + d.low, (a.high + b.high) + (c.high + d.high)};
}
#endif
INLINE_FOR_THIS_SET Point magnitude(const Point& a) { return larger(a, negative(a)); }
INLINE_FOR_THIS_SET Point four(const double* x) {
  Point out;
  std::memcpy(&out, x, sizeof out);
  return out;
}
INLINE_FOR_THIS_SET Point filled(double x) { return OnePoint::load(dvec4(x)); }

template <int M, int N>
FOR_THIS_SET void along_u(const TensorShape& shape, const double* weights, const dvec4* net, dvec4* out) {
  const int rows = (M >= 0 ? M : shape.m) + 1, columns = (N >= 0 ? N : shape.n) + 1;
  for (int i = 0; i < rows; ++i, weights += rows, out += columns) {
    Point sum[room_for(N)];
    for (int j = 0; j < columns; ++j) sum[j] = weights[0] * OnePoint::load(net[j]);
    for (int k = 1; k < rows; ++k)
      for (int j = 0; j < columns; ++j) sum[j] = sum[j] + weights[k] * OnePoint::load(net[k * columns + j]);
    for (int j = 0; j < columns; ++j) out[j] = OnePoint::store(sum[j]);
  }
}

// visit(k, the net's point k).
template <int M, int N, class Visit>
INLINE_FOR_THIS_SET void visit_along_v(const TensorShape& shape, const double* weights, const dvec4* net,
                                       const Visit& visit) {
  const int rows = (M >= 0 ? M : shape.m) + 1, columns = (N >= 0 ? N : shape.n) + 1;
  for (int j = 0; j < columns; ++j, weights += columns) {
    Point sum[room_for(M)];
    for (int i = 0; i < rows; ++i) sum[i] = weights[0] * OnePoint::load(net[i * columns]);
    for (int k = 1; k < columns; ++k)
      for (int i = 0; i < rows; ++i) sum[i] = sum[i] + weights[k] * OnePoint::load(net[i * columns + k]);
    for (int i = 0; i < rows; ++i) visit(i * columns + j, sum[i]);
  }
}

template <int M, int N>
FOR_THIS_SET void along_v(const TensorShape& shape, const double* weights, const dvec4* net, dvec4* out) {
  visit_along_v<M, N>(shape, weights, net,
                      [&](int k, const Point& p) FOR_THIS_SET { out[k] = OnePoint::store(p); });
}

FOR_THIS_SET inline NetScale scale_of(const Point& most) {
  const dvec4 m = OnePoint::store(most);
  return {largest(dvec3(m)), m.w};
}

template <int M, int N>
FOR_THIS_SET NetScale scale_along_v(const TensorShape& shape, const double* weights, const dvec4* net) {
  Point most = OnePoint::zero();
  visit_along_v<M, N>(shape, weights, net,
                      [&](int, const Point& p) FOR_THIS_SET { most = larger(most, magnitude(p)); });
  return scale_of(most);
}

FOR_THIS_SET inline SecondOrder<dvec4> stored(const PointBend<OnePoint>& s) {
  return {OnePoint::store(s.first.value), OnePoint::store(s.first.du), OnePoint::store(s.first.dv),
          OnePoint::store(s.duu),         OnePoint::store(s.duv),      OnePoint::store(s.dvv)};
}

template <int M, int N>
FOR_THIS_SET SecondOrder<dvec4> second(const TensorShape& shape, const dvec4* net, dvec2 at) {
  if (shape.m < 2 || shape.n < 2) return shape.second(net, at);
  return stored(second_order<M, N, OnePoint>(net, shape.m, shape.n, at.x, at.y));
}

// De Casteljau's step at `at`, whose third coordinate is the first two's rest to 1.
INLINE_FOR_THIS_SET void step_down(Point* a, int n, const dvec3& at) {
  const Point* row = a;
  for (int i = 0; i < n; ++i) {
    const Point* next = row + n - i + 1;
    for (int j = 0; j < n - i; ++j) *a++ = (at.x * next[j] + at.y * row[j + 1]) + at.z * row[j];
    row = next;
  }
}

// As triangle_restrict (bezier/triangle.h).
template <int N>
FOR_THIS_SET void restrict_to(const TriangleShape& shape, const TriangleCell& cell, const dvec4* net,
                              dvec4* out) {
  const int n = N >= 0 ? N : shape.n;
  dvec3 corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = dvec3(cell.corner[k], 1.0 - cell.corner[k].x - cell.corner[k].y);
  Point first[triangle_room_for(N)], other[triangle_room_for(N)], work[triangle_room_for(N)];
  for (int k = 0; k < triangle_size(n); ++k) first[k] = OnePoint::load(net[k]);
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k < triangle_size(n - i); ++k) other[k] = first[k];
    for (int j = 0; j <= n - i; ++j) {
      const int left = n - i - j;
      for (int k = 0; k < triangle_size(left); ++k) work[k] = other[k];
      for (int k = left; k > 0; --k) step_down(work, k, corner[2]);
      out[triangle_index(n, i, j)] = OnePoint::store(work[0]);
      step_down(other, left, corner[1]);
    }
    step_down(first, n - i, corner[0]);
  }
}

FOR_THIS_SET inline NetScale scale(int size, const dvec4* net) {
  Point most = OnePoint::zero();
  for (int k = 0; k < size; ++k) most = larger(most, magnitude(OnePoint::load(net[k])));
  return scale_of(most);
}

template <int N>
FOR_THIS_SET SecondOrder<dvec4> second(const TriangleShape& shape, const dvec4* net, dvec2 at) {
  if constexpr (N == dynamic || N > 1)
    if (shape.n > 1) return stored(second_order<N, OnePoint>(net, shape.n, at.x, at.y));
  return shape.second(net, at);
}

struct Range {
  Point low, high;
  INLINE_FOR_THIS_SET void add(const Point& p) { low = smaller(low, p), high = larger(high, p); }
};
INLINE_FOR_THIS_SET Range nothing() { return {filled(INFINITY), filled(-INFINITY)}; }

// Of the differences along a and b.
INLINE_FOR_THIS_SET void add_steps(const TensorShape& shape, const Point* p, Range& a, Range& b) {
  const int columns = shape.n + 1;
  for (int k = 0; k < shape.m * columns; ++k) a.add(p[k + columns] - p[k]);
  for (int i = 0; i <= shape.m; ++i, p += columns)
    for (int j = 0; j < shape.n; ++j) b.add(p[j + 1] - p[j]);
}
INLINE_FOR_THIS_SET void add_steps(const TriangleShape& shape, const Point* p, Range& a, Range& b) {
  for (int i = 0; i < shape.n; ++i) {
    const Point* next = p + shape.n - i + 1;
    for (int j = 0; j < shape.n - i; ++j) a.add(next[j] - p[j]), b.add(p[j + 1] - p[j]);
    p = next;
  }
}

template <class Shape>
FOR_THIS_SET FrameExtent extent(const Shape& shape, const FramedNets& nets) {
  const LeafFrame& f = nets.frame;
  const LeafParameters& parameters = nets.parameters;
  Point column[4];
  for (int k = 0; k < 4; ++k) column[k] = OnePoint::load(dvec4(f.across[k], f.normal[k], k == 3 ? 1.0 : 0.0));
  const auto to_frame = [&](const dvec4& p) FOR_THIS_SET {
    return nets.inverse_weight *
           framed_sum(p.x * column[0], p.y * column[1], p.z * column[2], p.w * column[3]);
  };
  const int size = shape.size();
  constexpr int lanes = static_cast<int>(LeafParameters::lanes);
  alignas(32) double zeta[max_net_size + lanes];
  Point off = OnePoint::zero();
  Range range = nothing();
  for (int k = 0; k < size; ++k) {
    const Point here = to_frame(nets.points[k]);
    off = larger(off, magnitude(here - OnePoint::load(parameters.linear[static_cast<std::size_t>(k)])));
    range.add(here);
    zeta[k] = OnePoint::store(here).z;
  }
  FrameExtent out;
  out.off = OnePoint::store(off);
  out.zeta_low = OnePoint::store(range.low).z, out.zeta_high = OnePoint::store(range.high).z;
  out.sagging = INFINITY;
  if (parameters.has_squares) {
    for (int k = size; k % lanes != 0; ++k) zeta[k] = zeta[size - 1];
    Point most = OnePoint::zero();
    for (int k = 0; k < size; k += lanes) {
      const Point x = four(parameters.squares[0].data() + k), y = four(parameters.squares[1].data() + k),
                  z = four(parameters.squares[2].data() + k);
      const double b0 = f.bend[0], b1 = f.bend[1], b2 = f.bend[2];
      most = larger(most, magnitude(four(zeta + k) - ((b0 * x + b1 * y) + b2 * z)));
    }
    const dvec4 m = OnePoint::store(most);
    out.sagging = std::max(largest(dvec3(m)), m.w);
  }
  Point wide[max_net_size];
  for (int k = 0; k < size; ++k) wide[k] = to_frame(nets.wide[k]);
  Range a = nothing(), b = nothing();
  add_steps(shape, wide, a, b);
  out.a_low = OnePoint::store(a.low), out.a_high = OnePoint::store(a.high);
  out.b_low = OnePoint::store(b.low), out.b_high = OnePoint::store(b.high);
  return out;
}

FOR_THIS_SET inline Box box(int size, const dvec4* points) {
  Range range = nothing();
  for (int k = 0; k < size; ++k) range.add(divided(OnePoint::load(points[k]), points[k].w));
  return {dvec3(OnePoint::store(range.low)), dvec3(OnePoint::store(range.high))};
}

inline LeafArithmetic<TensorShape> arithmetic_for(const TensorShape& shape) {
  return with_degrees(shape.m, shape.n, [](auto m, auto n) -> LeafArithmetic<TensorShape> {
    return {along_u<m, n>, along_v<m, n>, scale_along_v<m, n>, second<m, n>, extent<TensorShape>, box};
  });
}
inline LeafArithmetic<TriangleShape> arithmetic_for(const TriangleShape& shape) {
  return with_degree(shape.n, [](auto n) -> LeafArithmetic<TriangleShape> {
    return {restrict_to<n>, scale, second<n>, extent<TriangleShape>, box};
  });
}
