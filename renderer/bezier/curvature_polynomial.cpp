#include "renderer/bezier/curvature_polynomial.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/bezier/curve.h"
#include "renderer/bezier/triangle.h"
#include "renderer/bezier/wedge.h"

namespace rondure {
namespace {

using Tensor = TensorPolynomial<double>;
using Triangle = TrianglePolynomial<double>;

double dot(const dvec3& a, const dvec3& b) { return glm::dot(a, b); }

template <class Polynomial>
Polynomial times(Polynomial p, double factor) {
  for (auto& c : p.coefficients) c *= factor;
  return p;
}

// P_(i + a)(j + b) for the degree (m, n): a sub-net of the coefficients as they stand.
TensorPolynomial<dvec4> sub_net(const TensorNet& net, int a, int b, int m, int n) {
  TensorPolynomial<dvec4> sub(m, n);
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) sub.at(i, j) = net.at(i + a, j + b);
  }
  return sub;
}

TrianglePolynomial<dvec4> sub_net(const TriangleNet& net, int a, int b, int n) {
  TrianglePolynomial<dvec4> sub(n);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) sub.at(i, j) = net.at(i + a, j + b);
  }
  return sub;
}

Tensor weight_of(const TensorNet& net) {
  Tensor w(net.m, net.n);
  for (std::size_t k = 0; k < net.points.size(); ++k) w.coefficients[k] = net.points[k].w;
  return w;
}

Triangle weight_of(const TriangleNet& net) {
  Triangle w(net.n);
  for (std::size_t k = 0; k < net.points.size(); ++k) w.coefficients[k] = net.points[k].w;
  return w;
}

template <class Polynomial>
auto directions(const Polynomial& f, const Polynomial& g) {
  return multiply(f, g, [](const dvec4& a, const dvec4& b) { return join(b, a).direction; });
}

template <class P>
P transposed(const P& p) {
  P out(p.n, p.m);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) out.at(j, i) = p.at(i, j);
  }
  return out;
}

// m^2 (m - 1) n sum over k = 0, 1, 2 of B_k^2(u) det(F_k0, F_k1, F_(k+1), F_(k+2)): F, F_u and F_uu span what
// the sub-nets F_k = (1 - v) F_k0 + v F_k1, two steps of de Casteljau's algorithm in u down, span.
Tensor second_form_uu(const TensorNet& net) {
  const int m = net.m, n = net.n;
  if (m < 2) return Tensor(0, 4 * n - 2);
  TensorPolynomial<dvec4> f[3];
  for (int k = 0; k < 3; ++k) f[k] = sub_net(net, k, 0, m - 2, n);
  Tensor sum(4 * m - 6, 4 * n - 2);
  for (int k = 0; k < 3; ++k) {
    const auto in_v = multiply(sub_net(net, k, 0, m - 2, n - 1), sub_net(net, k, 1, m - 2, n - 1), join);
    const auto across = multiply(f[(k + 1) % 3], f[(k + 2) % 3], join);
    Tensor basis(2, 0);
    basis.at(k, 0) = 1.0;
    sum = add_scaled(std::move(sum), multiply(basis, multiply(in_v, across, join_lines)), 1.0);
  }
  return times(std::move(sum), static_cast<double>(m * m * (m - 1) * n));
}

struct Forms {
  ScalarPolynomial d_uu, d_uv, d_vv, determinant, mean_sum;
};

Forms forms_of(const TensorNet& net) {
  const int m = net.m, n = net.n;
  const Tensor d_uu = second_form_uu(net);
  // Exchanging u and v turns the normal round.
  const Tensor d_vv = times(transposed(second_form_uu(transposed(net))), -1.0);
  const auto corner = [&](int a, int b) { return sub_net(net, a, b, m - 1, n - 1); };
  const auto d_uv = times(multiply(multiply(corner(0, 0), corner(1, 0), join),
                                   multiply(corner(0, 1), corner(1, 1), join), join_lines),
                          -static_cast<double>(m * m * n * n));
  const auto a_u = times(directions(sub_net(net, 0, 0, m - 1, n), sub_net(net, 1, 0, m - 1, n)), m);
  const auto a_v = times(directions(sub_net(net, 0, 0, m, n - 1), sub_net(net, 0, 1, m, n - 1)), n);
  Tensor determinant = times(multiply(d_uv, d_uv), -1.0);
  if (m > 1 && n > 1) determinant = add_scaled(std::move(determinant), multiply(d_uu, d_vv), 1.0);
  Tensor sum = times(multiply(multiply(a_u, a_v, dot), d_uv), -2.0);
  if (n > 1) sum = add_scaled(std::move(sum), multiply(multiply(a_u, a_u, dot), d_vv), 1.0);
  if (m > 1) sum = add_scaled(std::move(sum), multiply(multiply(a_v, a_v, dot), d_uu), 1.0);
  return {d_uu, d_uv, d_vv, determinant, sum};
}

Forms forms_of(const TriangleNet& net) {
  const int n = net.n;
  const auto at_u = sub_net(net, 1, 0, n - 1), at_v = sub_net(net, 0, 1, n - 1);
  const auto at_w = sub_net(net, 0, 0, n - 1);
  const TrianglePolynomial<dvec4> whole(n, net.points);
  const auto a_u = times(directions(whole, add_scaled(at_u, at_w, -1.0)), n);
  const auto a_v = times(directions(whole, add_scaled(at_v, at_w, -1.0)), n);
  Triangle d[3] = {Triangle(std::max(4 * n - 5, 0)), Triangle(std::max(4 * n - 5, 0)),
                   Triangle(std::max(4 * n - 5, 0))};
  if (n > 1) {
    const auto lines = multiply(at_u, at_v, join);
    const auto second = [&](int a, int b) { return sub_net(net, a, b, n - 2); };
    const auto ww = second(0, 0);
    const auto uw = second(1, 0), vw = second(0, 1);
    const auto uu = add_scaled(add_scaled(second(2, 0), uw, -2.0), ww, 1.0);
    const auto vv = add_scaled(add_scaled(second(0, 2), vw, -2.0), ww, 1.0);
    const auto uv = add_scaled(add_scaled(add_scaled(second(1, 1), uw, -1.0), vw, -1.0), ww, 1.0);
    const double factor = -static_cast<double>(n * n * n * (n - 1));
    int k = 0;
    for (const auto* f : {&uu, &uv, &vv}) {
      d[k++] = times(multiply(lines, multiply(at_w, *f, join), join_lines), factor);
    }
  }
  const Triangle determinant = add_scaled(multiply(d[0], d[2]), multiply(d[1], d[1]), -1.0);
  Triangle sum = multiply(multiply(a_u, a_u, dot), d[2]);
  sum = add_scaled(std::move(sum), multiply(multiply(a_u, a_v, dot), d[1]), -2.0);
  sum = add_scaled(std::move(sum), multiply(multiply(a_v, a_v, dot), d[0]), 1.0);
  return {d[0], d[1], d[2], determinant, sum};
}

bool has_normal(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) return t->m > 0 && t->n > 0;
  return std::get<TriangleNet>(net).n > 0;
}

// One step of de Casteljau's algorithm a degree, in v and then in u.
template <class T>
T value_of(const TensorPolynomial<T>& p, double u, double v) {
  std::vector<T> column;
  for (int i = 0; i <= p.m; ++i) {
    std::vector<T> row(p.coefficients.begin() + i * (p.n + 1), p.coefficients.begin() + (i + 1) * (p.n + 1));
    for (int d = p.n; d > 0; --d) detail::casteljau_step(row.data(), d, v);
    column.push_back(row[0]);
  }
  for (int d = p.m; d > 0; --d) detail::casteljau_step(column.data(), d, u);
  return column[0];
}

template <class T>
T value_of(const TrianglePolynomial<T>& p, double u, double v) {
  std::vector<T> work = p.coefficients;
  for (int d = p.n; d > 0; --d) detail::triangle_step(work.data(), d, dvec2(u, v));
  return work[0];
}

}  // namespace

CurvaturePolynomials curvature_polynomials(const Net& net) {
  CurvaturePolynomials out;
  out.weight = std::visit([](const auto& n) -> ScalarPolynomial { return weight_of(n); }, net);
  if (!has_normal(net)) return out;
  const Forms forms = std::visit([](const auto& n) { return forms_of(n); }, net);
  out.d_uu = forms.d_uu;
  out.d_uv = forms.d_uv;
  out.d_vv = forms.d_vv;
  std::visit([&](const auto& n) { out.normal_square = multiply(n, n, dot); }, normal_polynomial(net));
  const auto finish = [&](const auto& w) {
    using P = std::decay_t<decltype(w)>;
    const P ww = multiply(w, w);
    out.gaussian = multiply(multiply(ww, ww), std::get<P>(forms.determinant));
    out.mean = multiply(w, std::get<P>(forms.mean_sum));
  };
  std::visit(finish, out.weight);
  return out;
}

double polynomial_value(const ScalarPolynomial& p, double u, double v) {
  return std::visit([&](const auto& q) { return value_of(q, u, v); }, p);
}

dvec3 polynomial_value(const NormalPolynomial& p, double u, double v) {
  return std::visit([&](const auto& q) { return value_of(q, u, v); }, p);
}

}  // namespace rondure
