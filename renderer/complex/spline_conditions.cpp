#include "renderer/complex/spline_conditions.h"

#include <algorithm>
#include <map>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// Sum of unknowns times polynomials of s, to be 0 for every s.
using Identity = std::map<int, EdgePolynomial>;

void collect(const Identity& identity, std::vector<SparseRow>& rows) {
  int degree = 0;
  for (const auto& term : identity) degree = std::max(degree, term.second.degree());
  std::vector<SparseRow> made(index(degree + 1));
  for (const auto& [unknown, polynomial] : identity) {
    const std::vector<Exact> b = bernstein_coefficients(polynomial, degree);
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (b[k] != 0) made[k].emplace_back(unknown, b[k]);
    }
  }
  for (SparseRow& row : made) {
    if (!row.empty()) rows.push_back(std::move(row));
  }
}

void subtract(Identity& identity, int unknown, const EdgePolynomial& p) {
  if (p.zero()) return;
  EdgePolynomial& term = identity[unknown];
  term = term - p;
}

// N / d and its derivatives on both sides of a join, over common denominators, all of them polynomials of s.
class JoinRows {
 public:
  JoinRows(const SurfaceComplex& complex, const EdgeJoin& join, int n,
           const std::vector<PolygonPolynomial>& denominators, const std::vector<int>& offsets)
      : n_(n),
        join_(join),
        p_offset_(offsets[index(join.p.polygon)]),
        q_offset_(offsets[index(join.q.polygon)]),
        p_traces_(edge_traces(complex.sides[index(join.p.polygon)], n, join.p.edge)),
        q_traces_(edge_traces(complex.sides[index(join.q.polygon)], n, join.q.edge)) {
    if (denominators.empty()) {
      dp_.value = dq_.value = 1;
      return;
    }
    const PolygonPolynomial& q = denominators[index(join.q.polygon)];
    dp_ = edge_trace(denominators[index(join.p.polygon)], join.p.edge);
    dq_ = edge_trace(q, join.q.edge);
    m_ = q.degree;
  }

  // N_p d_q(mu) = N_q(mu) d_p, times b^(n + m) where mu = a / b.
  Identity value() const {
    Identity identity;
    const EdgePolynomial p_factor = over(dq_.value, m_) * power(b(), n_);
    const EdgePolynomial q_factor = dp_.value * power(b(), m_);
    for (const EdgeTrace& t : p_traces_)
      subtract(identity, p_offset_ + t.coefficient, EdgePolynomial(-1) * t.value * p_factor);
    for (const EdgeTrace& t : q_traces_) {
      if (t.value.zero()) continue;
      subtract(identity, q_offset_ + t.coefficient, over(t.value, n_) * q_factor);
    }
    return identity;
  }

  // D_in(N_p / d_p) = theta_01 D_along(N_q / d_q) + theta_11 D_in(N_q / d_q), times d_p^2 d_q(mu)^2 b^(n+m)
  // and the denominators of theta.
  Identity derivative() const {
    Identity identity;
    const EdgeFunction &along = join_.bundle[0][1], &inward = join_.bundle[1][1];
    const EdgePolynomial dq = over(dq_.value, m_);
    const EdgePolynomial p_factor = dq * dq * power(b(), n_ + m_) * along.denominator * inward.denominator;
    const EdgePolynomial q_factor = dp_.value * dp_.value * power(b(), 2 * m_);
    const EdgePolynomial along_factor = along.numerator * inward.denominator * q_factor;
    const EdgePolynomial inward_factor = inward.numerator * along.denominator * q_factor;
    for (const EdgeTrace& t : p_traces_) {
      const EdgePolynomial slope = t.inward * dp_.value - t.value * dp_.inward;
      subtract(identity, p_offset_ + t.coefficient, EdgePolynomial(-1) * slope * p_factor);
    }
    for (const EdgeTrace& t : q_traces_) {
      const EdgePolynomial in_along = t.value.derivative() * dq_.value - t.value * dq_.value.derivative();
      const EdgePolynomial in_inward = t.inward * dq_.value - t.value * dq_.inward;
      subtract(identity, q_offset_ + t.coefficient,
               over(in_along, n_ + m_) * along_factor + over(in_inward, n_ + m_) * inward_factor);
    }
    return identity;
  }

 private:
  const EdgePolynomial& b() const { return join_.parameter.denominator; }
  EdgePolynomial over(const EdgePolynomial& p, int degree) const {
    return compose(p, degree, join_.parameter.numerator, b());
  }

  int n_, m_ = 0;
  const EdgeJoin& join_;
  int p_offset_, q_offset_;
  std::vector<EdgeTrace> p_traces_, q_traces_;
  EdgeTrace dp_{0, {}, {}}, dq_{0, {}, {}};
};

}  // namespace

std::vector<int> coefficient_offsets(const SurfaceComplex& complex, int n) {
  std::vector<int> offsets{0};
  for (const int sides : complex.sides) offsets.push_back(offsets.back() + coefficient_count(sides, n));
  return offsets;
}

std::vector<SparseRow> gc1_conditions(const SurfaceComplex& complex, int n,
                                      const std::vector<PolygonPolynomial>& denominators) {
  const std::vector<int> offsets = coefficient_offsets(complex, n);
  std::vector<SparseRow> rows;
  for (const EdgeJoin& join : complex.joins) {
    const JoinRows join_rows(complex, join, n, denominators, offsets);
    collect(join_rows.value(), rows);
    collect(join_rows.derivative(), rows);
  }
  return rows;
}

JoinDefect join_defect(const EdgeJoin& join, const PolygonPolynomial& p_numerator,
                       const PolygonPolynomial& p_denominator, const PolygonPolynomial& q_numerator,
                       const PolygonPolynomial& q_denominator) {
  const EdgeTrace np = edge_trace(p_numerator, join.p.edge), dp = edge_trace(p_denominator, join.p.edge);
  const EdgeTrace nq = edge_trace(q_numerator, join.q.edge), dq = edge_trace(q_denominator, join.q.edge);
  const EdgeFunction f(np.value, dp.value), g(nq.value, dq.value);
  const EdgeFunction f_in(np.inward * dp.value - np.value * dp.inward, dp.value * dp.value);
  const EdgeFunction g_in(nq.inward * dq.value - nq.value * dq.inward, dq.value * dq.value);
  const EdgeFunction& mu = join.parameter;
  return {f - compose(g, mu),
          f_in - (join.bundle[0][1] * compose(derivative(g), mu) + join.bundle[1][1] * compose(g_in, mu))};
}

}  // namespace rondure
