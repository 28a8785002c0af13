// Where one of the projected polynomials vanishes on a graph over a cell: there two unknowns become one.
//
// The pair is turned so that the first polynomial carries the gradient. If its derivative by one parameter,
// y, keeps away from zero over the cell, it vanishes on a graph y(x), and the second polynomial becomes a
// function h(x) along it.
#pragma once

#include <cmath>

#include "renderer/bezier/quotient.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/hull.h"

namespace rondure {

// One polynomial with its derivatives by x and y.
struct Jet {
  double value, x, y, xx, xy, yy;
};

// Which parameter is y: the first when `swapped`.
struct Axes {
  bool swapped;
  dvec2 to_cell(double x, double y) const { return swapped ? dvec2(y, x) : dvec2(x, y); }
  Jet jet(const SecondOrder<dvec2>& s, int k) const {
    return swapped ? Jet{s.value[k], s.dv[k], s.du[k], s.dvv[k], s.duv[k], s.duu[k]}
                   : Jet{s.value[k], s.du[k], s.dv[k], s.duu[k], s.duv[k], s.dvv[k]};
  }
};

// h = second polynomial along the zero graph of the first, and its derivatives by x.
struct Along {
  double h, dh, ddh, dy, miss;  // `miss`: how far y is from the graph
};

template <class Shape>
Along along_graph(const Shape& shape, const dvec2* f, const Axes& axes, double x, double& y) {
  SecondOrder<dvec2> s = shape.second(f, axes.to_cell(x, y));
  Jet g = axes.jet(s, 0);
  double miss = quotient(g.value, g.y);  // no number where the graph is upright: what follows refuses that
  for (int k = 0; k < 4 && std::fabs(miss) > 1e-15; ++k) {
    y -= miss;
    s = shape.second(f, axes.to_cell(x, y));
    g = axes.jet(s, 0);
    miss = quotient(g.value, g.y);
  }
  const Jet h = axes.jet(s, 1);
  const double dy = quotient(-g.x, g.y), ddy = quotient(-(g.xx + dy * (2.0 * g.xy + dy * g.yy)), g.y);
  // To first order, the value on the graph itself.
  return {h.value - h.y * miss, h.x + h.y * dy, h.xx + dy * (2.0 * h.xy + dy * h.yy) + h.y * ddy, dy, miss};
}

// Nets of derivatives, scratch for `slopes_of` and `curvature_of`; each as large as the pair's own.
struct DerivativeNets {
  dvec2 *a, *b, *second;
};

// Ranges over the cell of the derivatives by x and by y, of both polynomials.
struct Slopes {
  Interval x[2], y[2];
};

template <class Shape>
Slopes slopes_of(const Shape& shape, const dvec2* f, bool swapped, const DerivativeNets& nets) {
  shape.derive_a(f, nets.a);
  shape.derive_b(f, nets.b);
  Slopes s;
  for (int k = 0; k < 2; ++k) {
    s.x[k] = range_of(nets.a, shape.derived_a().size(), k);
    s.y[k] = range_of(nets.b, shape.derived_b().size(), k);
    if (swapped) std::swap(s.x[k], s.y[k]);
  }
  return s;
}

// Range of h'' over the cell, given `slopes_of` it (whose nets are used again); s.y[0] must not contain zero.
template <class Shape>
Interval curvature_of(const Shape& shape, const Slopes& s, bool swapped, const DerivativeNets& nets) {
  const Shape along_a = shape.derived_a(), along_b = shape.derived_b();
  Interval xx[2], xy[2], yy[2];
  const auto ranges = [&](int count, Interval* out) {
    for (int k = 0; k < 2; ++k) out[k] = range_of(nets.second, count, k);
  };
  if (along_a.can_derive_a()) along_a.derive_a(nets.a, nets.second), ranges(along_a.derived_a().size(), xx);
  if (along_a.can_derive_b()) along_a.derive_b(nets.a, nets.second), ranges(along_a.derived_b().size(), xy);
  if (along_b.can_derive_b()) along_b.derive_b(nets.b, nets.second), ranges(along_b.derived_b().size(), yy);
  if (swapped)
    for (int k = 0; k < 2; ++k) std::swap(xx[k], yy[k]);
  const Interval dy = -(s.x[0] / s.y[0]);
  const auto bend = [&](int k) { return xx[k] + 2.0 * (xy[k] * dy) + yy[k] * (dy * dy); };
  const Interval ddy = -(bend(0) / s.y[0]);
  return bend(1) + s.y[1] * ddy;
}

// `propose`s points of a cell in which the second polynomial is hardly more than its rounding error: contact
// of high order, or a grazing ray at a singular point. Where it changes sign along the graph of the first,
// else where it is least. False when the graph does not pass through the cell.
template <class Shape, class Propose>
bool propose_on_graph(const Shape& shape, const dvec2* f, bool swapped, const Propose& propose) {
  const Axes axes{swapped};
  struct Sample {
    double x, y, h;
    bool on_graph, inside;
  };
  const auto sample = [&](double x, double y) {
    const Along at = along_graph(shape, f, axes, x, y);
    // Where the graph has left the cell far behind, the search for it ends anywhere.
    const bool on_graph = std::fabs(at.miss) <= 1e-9;
    return Sample{x, y, at.h, on_graph, on_graph && Shape::outside(axes.to_cell(x, y)) <= 1e-9};
  };
  const auto keep_sample = [&](const Sample& s) { propose(axes.to_cell(s.x, s.y)); };
  constexpr int steps = 16;
  Sample last = sample(0.0, 0.5), least = last;
  bool crossed = false;
  for (int k = 1; k <= steps; ++k) {
    const Sample next = sample(static_cast<double>(k) / steps, last.y);
    const bool here = last.on_graph && next.on_graph && (last.inside || next.inside);
    if (here && (last.h < 0.0) != (next.h < 0.0)) {
      Sample low = last, high = next;
      for (int j = 0; j < 24; ++j) {
        const Sample middle = sample(0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
        ((middle.h < 0.0) == (low.h < 0.0) ? low : high) = middle;
      }
      if (low.inside) keep_sample(low);
      crossed = crossed || low.inside;
    }
    if (next.inside && (!least.inside || std::fabs(next.h) < std::fabs(least.h))) least = next;
    last = next;
  }
  if (!crossed && least.inside) keep_sample(least);
  return crossed || least.inside;
}

}  // namespace rondure
