#include "renderer/bezier/patch_integrals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/legendre_profile.h"

namespace rondure {
namespace {

// N along an edge is zero but for rounding when below this, relative to the product of its three factors.
constexpr double collapsed_noise = 1e-14;

// The unit of length and that of weight in which a patch is integrated: powers of two.
struct Units {
  double length, weight;
};

Units units_of(const Net& net, double extent) {
  double weight = 0.0;
  for (const dvec4& p : points_of(net)) weight = std::max(weight, std::abs(p.w));
  const auto power = [](double x) {
    return x > 0.0 && std::isfinite(x) ? std::ldexp(1.0, std::ilogb(x)) : 1.0;
  };
  return {power(extent), power(weight)};
}

lvec4 moved(const dvec4& p, const dvec3& about, Units unit) {
  const long double w = static_cast<long double>(p.w) / unit.weight;
  const lvec3 x = lvec3(dvec3(p)) / static_cast<long double>(unit.weight);
  return lvec4((x - w * lvec3(about)) / static_cast<long double>(unit.length), w);
}

// A triangle as a tensor-product patch of the degree (n, n): u stays, v is measured along the chord of
// constant u, so that the edge u = 1 collapses to the corner. Row i has the degree n - i and is raised to n.
LongNet as_tensor(const TriangleNet& net, const dvec3& about, Units unit) {
  const int n = net.n;
  LongNet out{n, n, {}, 0.0};
  for (int i = 0; i <= n; ++i) {
    std::vector<lvec4> row;
    for (int j = 0; j <= n - i; ++j) row.push_back(moved(net.at(i, j), about, unit));
    while (static_cast<int>(row.size()) <= n) {
      const std::size_t degree = row.size();  // after raising
      std::vector<lvec4> raised(degree + 1);
      for (std::size_t k = 0; k <= degree; ++k) {
        const long double t = static_cast<long double>(k) / static_cast<long double>(degree);
        raised[k] = (k > 0 ? t * row[k - 1] : lvec4(0.0L)) + (k < degree ? (1.0L - t) * row[k] : lvec4(0.0L));
      }
      row = std::move(raised);
    }
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  out.noise = long_epsilon * (2 * n + 2) * out.hull();
  return out;
}

LongNet as_tensor(const TensorNet& net, const dvec3& about, Units unit) {
  LongNet out{net.m, net.n, {}, 0.0};
  for (const dvec4& p : net.points) out.points.push_back(moved(p, about, unit));
  if (about != dvec3(0.0)) out.noise = 2.0 * long_epsilon * out.hull();
  return out;
}

LongNet derivative(const LongNet& net, bool along_u) {
  const int degree = along_u ? net.m : net.n;
  LongNet out{along_u ? net.m - 1 : net.m, along_u ? net.n : net.n - 1, {}, 0.0};
  for (int i = 0; i <= out.m; ++i) {
    for (int j = 0; j <= out.n; ++j) {
      const lvec4& low = net.points[grid_index(i, net.n + 1, j)];
      const lvec4& high =
          net.points[along_u ? grid_index(i + 1, net.n + 1, j) : grid_index(i, net.n + 1, j + 1)];
      out.points.push_back(static_cast<long double>(degree) * (high - low));
    }
  }
  out.noise = 2.0 * degree * net.noise + 2.0 * long_epsilon * out.hull();
  return out;
}

// De Casteljau's algorithm averages: a rounding of the hull for each step.
std::array<LongNet, 2> halves(const LongNet& net, bool along_u) {
  const int degree = along_u ? net.m : net.n, lines = along_u ? net.n + 1 : net.m + 1;
  const int step = along_u ? net.n + 1 : 1, next = along_u ? 1 : net.n + 1;
  std::array<LongNet, 2> out{net, net};
  for (LongNet& half : out) half.noise += long_epsilon * degree * net.hull();
  std::vector<lvec4> work(static_cast<std::size_t>(degree) + 1);
  for (int line = 0; line < lines; ++line) {
    const auto at = [&](int k) { return static_cast<std::size_t>(line * next + k * step); };
    for (int k = 0; k <= degree; ++k) work[static_cast<std::size_t>(k)] = net.points[at(k)];
    for (int r = degree; r >= 0; --r) {
      out[0].points[at(degree - r)] = work[0];
      out[1].points[at(r)] = work[static_cast<std::size_t>(r)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(r); ++k) work[k] = 0.5L * (work[k] + work[k + 1]);
    }
  }
  return out;
}

std::array<IntegrationCell, 2> halves(const IntegrationCell& cell) {
  const bool along_u = cell.split_u;
  std::array<LongNet, 2> net = halves(cell.net, along_u), du = halves(cell.du, along_u),
                         dv = halves(cell.dv, along_u);
  std::array<IntegrationCell, 2> out;
  for (std::size_t k = 0; k < 2; ++k) {
    // The parameter that was halved runs over [0, 1] again.
    LongNet& shorter = along_u ? du[k] : dv[k];
    for (lvec4& p : shorter.points) p *= 0.5L;
    shorter.noise *= 0.5;
    out[k].net = std::move(net[k]);
    out[k].du = std::move(du[k]);
    out[k].dv = std::move(dv[k]);
    out[k].collapsed = cell.collapsed;
    out[k].normal_noise = cell.normal_noise;
  }
  out[0].collapsed[along_u ? 1 : 3] = out[1].collapsed[along_u ? 0 : 2] = false;
  return out;
}

// How far a cell's quadrature is from its goal: 1 is there, if it were the only one.
double excess(const IntegrationCell& cell, const IntegralGoal& goal) {
  double worst = 0.0, unit = goal.error * goal.extent * goal.extent;
  for (std::size_t k = 0; k < 3; ++k) {
    worst = std::max({worst, cell.area_error[k] / unit, cell.cone_error[k] / (unit * goal.extent)});
    unit *= goal.extent;
  }
  return std::isnan(worst) ? infinity : worst;
}

void add(MomentSums& sum, const MomentSums& s) {
  sum.total += s.total;
  sum.first += s.first;
  for (std::size_t k = 0; k < s.second.size(); ++k) sum.second[k] += s.second[k];
}

void scale(MomentSums& sum, OrderErrors& error, const std::array<long double, 3>& factor) {
  sum.total *= factor[0];
  sum.first *= factor[1];
  for (long double& s : sum.second) s *= factor[2];
  for (std::size_t k = 0; k < 3; ++k) error[k] *= static_cast<double>(factor[k]);
}

// Flags the edges along which N vanishes. What rounding leaves of it there becomes the cell's `normal_noise`.
void find_collapsed(IntegrationCell& cell, const GaussRule& in_u, const GaussRule& in_v) {
  const double least = collapsed_noise * cell.net.hull() * cell.du.hull() * cell.dv.hull();
  for (int edge = 0; edge < 4; ++edge) {
    const double bound = edge_normal_bound(cell, edge, in_u, in_v, least);
    if (!(bound <= least)) continue;
    cell.collapsed[static_cast<std::size_t>(edge)] = true;
    cell.normal_noise += bound;
  }
}

struct RankedCell {
  double excess;
  std::unique_ptr<IntegrationCell> cell;
};

// Pieces, the worst first, until they reach the goal together, or until twice as many have not halved the
// error: then it is rounding, as in patches of high degree, and more would not help. Few pieces say nothing:
// where no bound but the largest integrand is known yet, halving changes little.
std::vector<RankedCell> pieces_of(std::unique_ptr<IntegrationCell> whole, const GaussRule& in_u,
                                  const GaussRule& in_v, const IntegralGoal& goal) {
  const auto less = [](const RankedCell& a, const RankedCell& b) { return a.excess < b.excess; };
  std::vector<RankedCell> heap;
  const auto push = [&](std::unique_ptr<IntegrationCell> cell) {
    integrate(*cell, in_u, in_v);
    heap.push_back({excess(*cell, goal), std::move(cell)});
    std::push_heap(heap.begin(), heap.end(), less);
  };
  push(std::move(whole));
  const auto total = [&] {
    double sum = 0.0;
    for (const RankedCell& p : heap) sum += p.excess;
    return sum;
  };
  // A piece of high degree has many nodes, which see as much as several pieces of a lower one: 256 pieces of
  // degree 4 are some 40,000.
  const auto nodes = static_cast<std::size_t>(in_u.count * in_v.count);
  std::size_t next_look = std::clamp<std::size_t>(256 * 13 * 13 / nodes, 16, 256);
  double last = infinity;
  // All the work on a patch is at most forty times that on as many pieces of degree 4.
  const auto coefficients = static_cast<std::size_t>((in_u.degree + 1) * (in_v.degree + 1));
  const std::size_t affordable = std::max<std::size_t>(
      16, static_cast<std::size_t>(goal.most_cells) * 40 * (13 * 13 * 5 * 5) / (nodes * coefficients));
  const std::size_t most = std::min(static_cast<std::size_t>(goal.most_cells), affordable);
  while (heap.size() < most && total() > 1.0) {
    if (heap.size() >= next_look) {
      const double now = total();
      if (std::isfinite(last) && now > 0.5 * last) break;
      last = now;
      next_look *= 2;
    }
    std::pop_heap(heap.begin(), heap.end(), less);
    const auto worst = std::move(heap.back().cell);
    heap.pop_back();
    for (IntegrationCell& half : halves(*worst)) {
      push(std::make_unique<IntegrationCell>(std::move(half)));
    }
  }
  return heap;
}

int lesser_degree(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) return std::min(t->m, t->n);
  return std::get<TriangleNet>(net).n;
}

}  // namespace

PatchIntegrals integrate_patch(const Net& net, const dvec3& about, const IntegralGoal& goal) {
  PatchIntegrals out;
  if (lesser_degree(net) < 1) return out;
  const Units unit = units_of(net, goal.extent);
  auto whole = std::make_unique<IntegrationCell>();
  whole->net = std::visit([&](const auto& n) { return as_tensor(n, about, unit); }, net);
  whole->du = derivative(whole->net, true);
  whole->dv = derivative(whole->net, false);
  const GaussRule& in_u = gauss_rule(whole->net.m);
  const GaussRule& in_v = gauss_rule(whole->net.n);
  find_collapsed(*whole, in_u, in_v);
  const IntegralGoal scaled{goal.error, goal.extent / unit.length, goal.most_cells};
  for (const RankedCell& p : pieces_of(std::move(whole), in_u, in_v, scaled)) {
    const IntegrationCell& c = *p.cell;
    add(out.area, c.area);
    add(out.cone, c.cone);
    out.vector_area += c.vector_area;
    ++out.cells;
    for (std::size_t k = 0; k < 3; ++k) {
      out.area_error[k] += c.area_error[k] + c.area_rounding[k];
      out.cone_error[k] += c.cone_error[k] + c.cone_rounding[k];
    }
  }
  const long double l = unit.length, square = l * l, cube = square * l;
  scale(out.area, out.area_error, {square, cube, cube * l});
  out.vector_area *= square;
  // Cones have a third of the base times the height; one more power of the height adds one to the divisor.
  scale(out.cone, out.cone_error, {cube / 3.0L, cube * l / 4.0L, cube * square / 5.0L});
  return out;
}

}  // namespace rondure
