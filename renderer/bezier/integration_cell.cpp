#include "renderer/bezier/integration_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/legendre_profile.h"

namespace rondure {
namespace {

// Ellipses tried; 1 is the interval itself.
constexpr double ellipses[] = {1.0, 1.1, 1.2, 1.35, 1.5,  1.75, 2.0,  2.4,
                               3.0, 4.0, 5.5, 8.0,  12.0, 20.0, 40.0, 100.0};

struct Nodes {
  std::vector<lvec4> point, du, dv;
};

// Values at all nodes, along v first. The tables have the net's degrees.
std::vector<lvec4> evaluate(const LongNet& net, const std::vector<long double>& in_u, int nu,
                            const std::vector<long double>& in_v, int nv) {
  std::vector<lvec4> rows(static_cast<std::size_t>((net.m + 1) * nv), lvec4(0.0L));
  for (int i = 0; i <= net.m; ++i) {
    for (int j = 0; j < nv; ++j) {
      lvec4& p = rows[grid_index(i, nv, j)];
      for (int k = 0; k <= net.n; ++k)
        p += in_v[grid_index(j, net.n + 1, k)] * net.points[grid_index(i, net.n + 1, k)];
    }
  }
  std::vector<lvec4> out(static_cast<std::size_t>(nu * nv), lvec4(0.0L));
  for (int i = 0; i < nu; ++i) {
    for (int k = 0; k <= net.m; ++k) {
      const long double b = in_u[grid_index(i, net.m + 1, k)];
      for (int j = 0; j < nv; ++j) out[grid_index(i, nv, j)] += b * rows[grid_index(k, nv, j)];
    }
  }
  return out;
}

Nodes evaluate(const IntegrationCell& cell, const GaussRule& u, const GaussRule& v) {
  return {evaluate(cell.net, u.value, u.count, v.value, v.count),
          evaluate(cell.du, u.lower, u.count, v.value, v.count),
          evaluate(cell.dv, u.value, u.count, v.lower, v.count)};
}

// (w X_u - w_u X) x (w X_v - w_v X) / w, without the division.
lvec3 normal(const lvec4& f, const lvec4& a, const lvec4& b) {
  const lvec3 x(f), xu(a), xv(b);
  return f.w * glm::cross(xu, xv) + b.w * glm::cross(x, xu) + a.w * glm::cross(xv, x);
}

long double determinant(const lvec4& f, const lvec4& a, const lvec4& b) {
  return glm::dot(lvec3(f), glm::cross(lvec3(a), lvec3(b)));
}

// At the nodes. N without the distances from the edges where it vanishes.
struct Values {
  Grid weight, determinant, space[3], normal[3];

  explicit Values(std::size_t count) : weight(count), determinant(count) {
    for (int c = 0; c < 3; ++c) space[c] = normal[c] = weight;
  }
};

struct Profiles {
  Profile weight, determinant, space[3], normal[3];
  Profile along;  // of the normal's product with its own c_00
};

Profiles profiles(const Values& values, const GaussRule& in_u, const GaussRule& in_v) {
  const int m = in_u.degree, n = in_v.degree;
  const auto net_like = [&](const Grid& v) { return profile(series(v, m, n, in_u, in_v)); };
  const auto normal_like = [&](const Grid& v) { return series(v, 3 * m - 2, 3 * n - 2, in_u, in_v); };
  Profiles out;
  out.weight = net_like(values.weight);
  out.determinant = profile(normal_like(values.determinant));
  Series along;
  for (int c = 0; c < 3; ++c) {
    out.space[c] = net_like(values.space[c]);
    const Series s = normal_like(values.normal[c]);
    out.normal[c] = profile(s);
    if (c == 0) along = Series{s.m, s.n, Grid(s.coefficients.size(), 0.0), 0.0};
    const double n0 = s.coefficients[0];
    for (std::size_t k = 0; k < s.coefficients.size(); ++k) along.coefficients[k] += n0 * s.coefficients[k];
    along.error += std::abs(n0) * s.error;
  }
  out.along = profile(along);
  return out;
}

double length3(double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); }

// The largest integrands of order 0 on an ellipse, and how much one more coordinate of the point adds.
struct Majorant {
  double area = infinity, cone = infinity, reach = infinity;
};

Majorant majorant(const Profiles& p, const IntegrationCell& cell, bool along_u, const Grid& growth) {
  Majorant out;
  const double least = std::abs(p.weight.middle) - p.weight.deviation(along_u, growth);
  if (!(least > 0.0)) return out;
  const auto space = [&](int c) { return p.space[c].bound(along_u, growth); };
  const auto spread = [&](int c) { return p.normal[c].deviation(along_u, growth); };
  const auto size = [&](int c) { return p.normal[c].bound(along_u, growth); };
  const double cube = least * least * least;
  out.reach = length3(space(0), space(1), space(2)) / least;
  out.cone = p.determinant.bound(along_u, growth) / cube;
  // sqrt(N . N) is analytic where N . N stays within |n|^2 of n . n, n = c_00. On the interval it need not
  // be.
  const double n2 = p.along.middle, rest = length3(spread(0), spread(1), spread(2));
  const bool real = growth.size() < 2 || growth[1] == 1.0;
  if (real || 2.0 * p.along.deviation(along_u, growth) + rest * rest < n2) {
    // The distance of a complex parameter from an edge is (1 + growth) / 2 at most.
    double distances = 1.0;
    for (std::size_t e = 0; e < 4; ++e) {
      if (cell.collapsed[e] && (e < 2) == along_u && !real) distances *= 0.5 * (1.0 + growth[1]);
    }
    out.area = distances * length3(size(0), size(1), size(2)) / cube;
  }
  return out;
}

OrderErrors powers(double value, double reach) { return {value, value * reach, value * reach * reach}; }

void take_least(OrderErrors& least, double value, double reach) {
  const OrderErrors p = powers(value, reach);
  for (std::size_t k = 0; k < 3; ++k) least[k] = std::min(least[k], p[k]);
}

struct Directed {
  OrderErrors area{infinity, infinity, infinity}, cone{infinity, infinity, infinity};
};

// The least bound over the ellipses for one direction.
Directed bound_direction(const Profiles& p, const IntegrationCell& cell, bool along_u, int count) {
  Directed out;
  Grid growth(static_cast<std::size_t>(count));
  for (const double rho : ellipses) {
    if (rho == 1.0) continue;
    double up = 1.0, down = 1.0;
    for (double& g : growth) {
      g = 0.5 * (up + down);
      up *= rho;
      down /= rho;
    }
    const Majorant m = majorant(p, cell, along_u, growth);
    if (!(m.reach < infinity)) break;
    // 2.2 for 32/15: the rest covers the rounding of the bound itself.
    const double decay = 2.2 * std::pow(rho, -2.0 * count) / (1.0 - 1.0 / (rho * rho));
    if (m.area < infinity) take_least(out.area, m.area * decay, m.reach);
    take_least(out.cone, m.cone * decay, m.reach);
  }
  return out;
}

// Whether the weight is constant: the cone's integrands are then polynomials of degree 5m - 1, which 3m + 1
// nodes integrate exactly.
bool is_polynomial(const IntegrationCell& cell) {
  const auto flat = [](const lvec4& p) { return p.w == 0.0L; };
  return std::all_of(cell.du.points.begin(), cell.du.points.end(), flat) &&
         std::all_of(cell.dv.points.begin(), cell.dv.points.end(), flat);
}

void bound_quadrature(IntegrationCell& cell, const Profiles& p, const Majorant& real, int nu, int nv) {
  const Directed u = bound_direction(p, cell, true, nu), v = bound_direction(p, cell, false, nv);
  OrderErrors area, cone;
  const OrderErrors crude_area = powers(2.0 * real.area, real.reach);
  const OrderErrors crude_cone = powers(2.0 * real.cone, real.reach);
  for (std::size_t k = 0; k < 3; ++k) {
    area[k] = std::min(u.area[k] + v.area[k], crude_area[k]);
    cone[k] = std::min(u.cone[k] + v.cone[k], crude_cone[k]);
  }
  cell.area_error = area;
  cell.cone_error = is_polynomial(cell) ? OrderErrors{} : cone;
  const auto ratio = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
  const double in_u = ratio(u.area[0], crude_area[0]) + ratio(u.cone[0], crude_cone[0]);
  const double in_v = ratio(v.area[0], crude_area[0]) + ratio(v.cone[0], crude_cone[0]);
  // Where neither is bounded, the direction in which the surface turns and the weight changes more.
  const auto variation = [&](bool along_u) {
    double sum = 0.0;
    const auto add = [&](const Profile& q, double scale) {
      const Grid& c = along_u ? q.in_u : q.in_v;
      for (std::size_t k = 1; k < c.size(); ++k) sum += scale > 0.0 ? c[k] / scale : 0.0;
    };
    double size = 0.0;
    for (const Profile& n : p.normal) size += n.in_u[0];
    add(p.weight, p.weight.in_u[0]);
    for (const Profile& n : p.normal) add(n, size);
    return sum;
  };
  const bool finite = in_u < infinity || in_v < infinity;
  cell.split_u = finite ? in_u >= in_v : variation(true) >= variation(false);
}

// Of the sums, from the rounding of the nets and of every operation.
void bound_rounding(IntegrationCell& cell, const Majorant& real, const Profile& weight) {
  const auto error = [](const LongNet& net) {
    return net.noise + long_epsilon * (2 * (net.m + net.n) + 8) * net.hull();
  };
  const double value = error(cell.net), du = error(cell.du), dv = error(cell.dv);
  const double hull = cell.net.hull(), in_u = cell.du.hull(), in_v = cell.dv.hull();
  // N and the determinant are sums of products of three coordinates, one of each kind.
  const double product = 4.0 * (value * in_u * in_v + hull * (du * in_v + in_u * dv)) +
                         16.0 * long_epsilon * hull * in_u * in_v + 4.0 * cell.normal_noise;
  const Grid flat(weight.in_u.size(), 1.0);
  const double least = std::abs(weight.middle) - weight.deviation(true, flat);
  const double quotient = 5.0 * value / least + 64.0 * long_epsilon;
  const double cube = least * least * least;
  cell.area_rounding = powers(product / cube + quotient * real.area, real.reach);
  cell.cone_rounding = powers(product / cube + quotient * real.cone, real.reach);
}

void add_moments(MomentSums& sums, long double density, const lvec3& at) {
  sums.total += density;
  sums.first += density * at;
  std::size_t k = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) sums.second[k++] += density * at[a] * at[b];
  }
}

}  // namespace

void integrate(IntegrationCell& cell, const GaussRule& in_u, const GaussRule& in_v) {
  const int nu = in_u.count, nv = in_v.count;
  const Nodes nodes = evaluate(cell, in_u, in_v);
  Values values(nodes.point.size());
  cell.area = cell.cone = MomentSums{};
  cell.vector_area = lvec3(0.0L);
  for (int i = 0; i < nu; ++i) {
    const long double u = in_u.node[static_cast<std::size_t>(i)];
    for (int j = 0; j < nv; ++j) {
      const long double v = in_v.node[static_cast<std::size_t>(j)];
      const std::size_t at = grid_index(i, nv, j);
      const lvec4& f = nodes.point[at];
      lvec3 n = normal(f, nodes.du[at], nodes.dv[at]);
      const long double det = determinant(f, nodes.du[at], nodes.dv[at]);
      const long double scale = in_u.weight[static_cast<std::size_t>(i)] *
                                in_v.weight[static_cast<std::size_t>(j)] / (f.w * f.w * f.w);
      const lvec3 point = lvec3(f) / f.w;
      add_moments(cell.area, std::abs(scale) * glm::length(n), point);
      add_moments(cell.cone, scale * det, point);
      cell.vector_area += scale * n;
      const long double distance[4] = {u, 1.0L - u, v, 1.0L - v};
      for (std::size_t e = 0; e < 4; ++e) {
        if (cell.collapsed[e]) n /= distance[e];
      }
      for (int c = 0; c < 3; ++c) {
        values.space[c][at] = static_cast<double>(f[c]);
        values.normal[c][at] = static_cast<double>(n[c]);
      }
      values.weight[at] = static_cast<double>(f.w);
      values.determinant[at] = static_cast<double>(det);
    }
  }
  const Profiles p = profiles(values, in_u, in_v);
  const Grid flat(static_cast<std::size_t>(std::max(nu, nv)), 1.0);
  const Majorant real = majorant(p, cell, true, flat);
  if (real.reach < infinity) {
    bound_rounding(cell, real, p.weight);
  } else {
    cell.area_rounding = cell.cone_rounding = {infinity, infinity, infinity};
  }
  bound_quadrature(cell, p, real, nu, nv);
}

double LongNet::hull() const {
  long double largest = 0.0L;
  for (const lvec4& p : points) largest = std::max(largest, glm::length(p));
  return static_cast<double>(largest);
}

double edge_normal_bound(const IntegrationCell& cell, int edge, const GaussRule& in_u, const GaussRule& in_v,
                         double enough) {
  const bool along_v = edge < 2;
  const GaussRule& rule = along_v ? in_v : in_u;
  const std::vector<long double> first{1.0L};
  // At a parameter of 0 or 1 only the first or last row (or column) of a net counts.
  const auto values = [&](const LongNet& net, int count) {
    const int end = edge % 2 == 0 ? 0 : (along_v ? net.m : net.n);
    LongNet row{0, along_v ? net.n : net.m, {}, net.noise};
    for (int k = 0; k <= row.n; ++k)
      row.points.push_back(
          net.points[along_v ? grid_index(end, net.n + 1, k) : grid_index(k, net.n + 1, end)]);
    return evaluate(row, first, 1, row.n == rule.degree ? rule.value : rule.lower, count);
  };
  const auto normals = [&](int count) {
    const std::vector<lvec4> f = values(cell.net, count), a = values(cell.du, count),
                             b = values(cell.dv, count);
    std::vector<lvec3> out;
    for (std::size_t i = 0; i < f.size(); ++i) out.push_back(normal(f[i], a[i], b[i]));
    return out;
  };
  const double one = static_cast<double>(glm::length(normals(1)[0]));
  if (one > enough) return one;
  const std::vector<lvec3> all = normals(rule.count);
  double total = 0.0;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < rule.count; ++k) {
      double sum = 0.0;
      for (int i = 0; i < rule.count; ++i) {
        sum += rule.project[grid_index(k, rule.count, i)] *
               static_cast<double>(all[static_cast<std::size_t>(i)][c]);
      }
      total += std::abs(sum);
    }
  }
  return total;
}

}  // namespace rondure
