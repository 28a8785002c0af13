#include "renderer/continuity/exact_normal.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// A polynomial by what stands at u^i (1 - u)^(m - i) v^j (1 - v)^(n - j), or u^i v^j w^(n - i - j): Bernstein
// coefficients times binomials, which multiply without division.
struct Scaled {
  bool triangle = false;
  int m = 0, n = 0;
  std::vector<Integer> c;

  Scaled(bool triangular, int degree_u, int degree_v) : triangle(triangular), m(degree_u), n(degree_v) {
    c.resize(index(triangle ? triangle_size(n) : (m + 1) * (n + 1)));
  }
  std::size_t place(int i, int j) const {
    return index(triangle ? triangle_index(n, i, j) : i * (n + 1) + j);
  }
  int last(int i) const { return triangle ? n - i : n; }
};

Scaled product(const Scaled& a, const Scaled& b) {
  Scaled out(a.triangle, a.m + b.m, a.n + b.n);
  for (int i = 0; i <= a.m; ++i) {
    for (int j = 0; j <= a.last(i); ++j) {
      const Integer& x = a.c[a.place(i, j)];
      if (x == 0) continue;
      for (int k = 0; k <= b.m; ++k) {
        for (int l = 0; l <= b.last(k); ++l) out.c[out.place(i + k, j + l)] += x * b.c[b.place(k, l)];
      }
    }
  }
  return out;
}

Scaled difference(Scaled a, const Scaled& b) {
  for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] -= b.c[k];
  return a;
}

// By coordinate 0, 1, 2 of a triangle, as if they were independent.
Scaled by_coordinate(const Scaled& p, int coordinate) {
  Scaled out(true, p.n - 1, p.n - 1);
  for (int i = 0; i < p.n; ++i) {
    for (int j = 0; j < p.n - i; ++j) {
      const int power[3] = {i, j, p.n - 1 - i - j};
      out.c[out.place(i, j)] =
          (power[coordinate] + 1) * p.c[p.place(i + (coordinate == 0), j + (coordinate == 1))];
    }
  }
  return out;
}

Scaled by_axis(const Scaled& p, int axis) {
  Scaled out(false, p.m - (axis == 0), p.n - (axis == 1));
  for (int i = 0; i <= out.m; ++i) {
    for (int j = 0; j <= out.n; ++j) {
      const int k = axis == 0 ? i : j, degree = axis == 0 ? p.m : p.n;
      out.c[out.place(i, j)] =
          (k + 1) * p.c[p.place(i + (axis == 0), j + (axis == 1))] - (degree - k) * p.c[p.place(i, j)];
    }
  }
  return out;
}

// Whether the power of a linear factor is at least 1 in every term: of u, 1 - u, v, 1 - v, or u, v, w.
bool divides(const Scaled& p, int factor) {
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.last(i); ++j) {
      const int on_triangle[4] = {i, j, p.n - i - j, 1}, on_square[4] = {i, p.m - i, j, p.n - j};
      if ((p.triangle ? on_triangle : on_square)[factor] == 0 && p.c[p.place(i, j)] != 0) return false;
    }
  }
  return true;
}

Scaled divided(const Scaled& p, int factor) {
  const bool in_u = factor < 2;
  Scaled out = p.triangle ? Scaled(true, p.n - 1, p.n - 1) : Scaled(false, p.m - in_u, p.n - !in_u);
  const int i0 = factor == 0, j0 = p.triangle ? factor == 1 : factor == 2;
  for (int i = 0; i <= out.m; ++i) {
    for (int j = 0; j <= out.last(i); ++j) out.c[out.place(i, j)] = p.c[p.place(i + i0, j + j0)];
  }
  return out;
}

using Normal = std::array<Scaled, 3>;

int divide_edges(Normal& n) {
  int count = 0;
  for (int factor = 0; factor < (n[0].triangle ? 3 : 4); ++factor) {
    const auto degree = [&] { return n[0].triangle || factor >= 2 ? n[0].n : n[0].m; };
    while (degree() > 0 &&
           std::all_of(n.begin(), n.end(), [&](const Scaled& p) { return divides(p, factor); })) {
      for (Scaled& p : n) p = divided(p, factor);
      ++count;
    }
  }
  return count;
}

// The least common multiple of the binomials, and what is left of it for each.
template <class Polynomial>
Polynomial bernstein(const Normal& normal, Polynomial out, Integer& multiple) {
  IntegerNet shape;
  shape.triangle = normal[0].triangle, shape.m = normal[0].m, shape.n = normal[0].n;
  multiple = 1;
  for (int i = 0; i <= shape.m; ++i) {
    for (int j = 0; j <= normal[0].last(i); ++j)
      multiple = boost::multiprecision::lcm(multiple, shape.binomials(i, j));
  }
  for (int i = 0; i <= shape.m; ++i) {
    for (int j = 0; j <= normal[0].last(i); ++j) {
      const std::size_t k = normal[0].place(i, j);
      const Integer share = multiple / shape.binomials(i, j);
      out.coefficients[k].x = normal[0].c[k] * share;
      out.coefficients[k].y = normal[1].c[k] * share;
      out.coefficients[k].z = normal[2].c[k] * share;
    }
  }
  return out;
}

// The least exponent of a bit that is set in some coordinate from `first` on, up to `end`.
int least_exponent(const std::vector<dvec4>& points, int first, int end) {
  int least = 2000;
  for (const dvec4& p : points) {
    for (int d = first; d < end; ++d) {
      if (p[d] == 0.0) continue;
      int exponent = 0;
      const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(p[d], &exponent), 53));
      least = std::min(least, exponent - 53 + __builtin_ctzll(static_cast<unsigned long long>(mantissa)));
    }
  }
  return least == 2000 ? 0 : least;
}

}  // namespace

std::size_t IntegerNet::place(int i, int j) const {
  return index(triangle ? triangle_index(n, i, j) : i * (n + 1) + j);
}

Integer IntegerNet::binomials(int i, int j) const {
  return exact_binomial(m, i) * exact_binomial(triangle ? n - i : n, j);
}

IntegerNet integer_net(const Net& net) {
  IntegerNet out;
  const std::vector<dvec4>& points = points_of(net);
  if (const auto* tensor = std::get_if<TensorNet>(&net)) {
    out.m = tensor->m, out.n = tensor->n;
  } else {
    out.triangle = true;
    out.m = out.n = std::get<TriangleNet>(net).n;
  }
  out.exponent = {least_exponent(points, 0, 3), least_exponent(points, 3, 4)};
  for (const dvec4& p : points) {
    std::array<Integer, 4> point;
    for (int d = 0; d < 4; ++d) {
      int exponent = 0;
      point[index(d)] = static_cast<std::int64_t>(std::ldexp(std::frexp(p[d], &exponent), 53));
      const int shift = exponent - 53 - out.exponent[d < 3 ? 0 : 1];
      if (p[d] == 0.0) continue;
      if (shift >= 0) {
        point[index(d)] <<= shift;
      } else {
        point[index(d)] /= Integer(1) << -shift;
      }
    }
    out.points.push_back(point);
  }
  return out;
}

std::optional<ExactNormal> exact_normal(const IntegerNet& net) {
  if (net.m < 1 || net.n < 1) return std::nullopt;
  // X and its derivatives along u and v, or by all three coordinates.
  std::array<std::vector<Scaled>, 3> columns;
  for (std::size_t d = 0; d < 4; ++d) {
    Scaled x(net.triangle, net.m, net.n);
    for (int i = 0; i <= x.m; ++i) {
      for (int j = 0; j <= x.last(i); ++j) {
        const std::size_t k = x.place(i, j);
        x.c[k] = net.points[k][d] * net.binomials(i, j);
      }
    }
    for (int k = 0; k < 3; ++k)
      columns[index(k)].push_back(net.triangle ? by_coordinate(x, k) : k == 0 ? x : by_axis(x, k - 1));
  }
  const auto minor = [&](std::size_t x, std::size_t y, std::size_t z) {
    const auto& c = columns;
    const auto pair = [&](std::size_t a, std::size_t b) {
      return difference(product(c[1][a], c[2][b]), product(c[1][b], c[2][a]));
    };
    Scaled sum = product(c[0][x], pair(y, z));
    for (const Scaled& term : {product(c[0][y], pair(z, x)), product(c[0][z], pair(x, y))}) {
      for (std::size_t k = 0; k < sum.c.size(); ++k) sum.c[k] += term.c[k];
    }
    return sum;
  };
  Normal normal{minor(1, 2, 3), minor(2, 0, 3), minor(0, 1, 3)};
  const bool any = std::any_of(normal.begin(), normal.end(), [](const Scaled& p) {
    return std::any_of(p.c.begin(), p.c.end(), [](const Integer& c) { return c != 0; });
  });
  if (!any) return std::nullopt;
  ExactNormal out;
  out.divided = divide_edges(normal);
  Integer multiple;
  const Scaled& like = normal[0];
  if (net.triangle) {
    out.normal = bernstein(normal, TrianglePolynomial<IntegerVector>(like.n), multiple);
    // n X = u X_u + v X_v + w X_w, the three as if they were independent.
    multiple *= net.n;
  } else {
    out.normal = bernstein(normal, TensorPolynomial<IntegerVector>(like.m, like.n), multiple);
  }
  out.factor = 1.0 / multiple.convert_to<double>();
  out.exponent = 2 * net.exponent[0] + net.exponent[1];
  return out;
}

}  // namespace rondure
