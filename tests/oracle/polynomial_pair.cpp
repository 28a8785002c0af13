#include "tests/oracle/polynomial_pair.h"

namespace rondure::oracle {

std::size_t Degrees::size() const {
  return static_cast<std::size_t>(triangle ? (n + 1) * (n + 2) / 2 : (m + 1) * (n + 1));
}

std::size_t Degrees::at(int i, int j) const {
  if (!triangle) return static_cast<std::size_t>(i * (n + 1) + j);
  int start = 0;
  for (int k = 0; k < i; ++k) start += n + 1 - k;
  return static_cast<std::size_t>(start + j);
}

std::vector<std::vector<std::size_t>> Degrees::lines(int edge) const {
  std::vector<std::vector<std::size_t>> out;
  if (!triangle) {
    for (int k = 0; k <= (edge == 0 ? n : m); ++k) {
      out.emplace_back();
      for (int l = 0; l <= (edge == 0 ? m : n); ++l) out.back().push_back(edge == 0 ? at(l, k) : at(k, l));
    }
    return out;
  }
  // The third index stays fixed along a line.
  for (int fixed = 0; fixed <= n; ++fixed) {
    out.emplace_back();
    for (int from = n - fixed, to = 0; from >= 0; --from, ++to)
      out.back().push_back(edge == 0 ? at(from, to) : edge == 1 ? at(fixed, from) : at(to, fixed));
  }
  return out;
}

Degrees Degrees::derived(int parameter) const {
  if (triangle) return {true, std::max(m - 1, 0), std::max(n - 1, 0)};
  return parameter == 0 ? Degrees{false, std::max(m - 1, 0), n} : Degrees{false, m, std::max(n - 1, 0)};
}

std::array<PolynomialPair, 2> PolynomialPair::halves(int edge) const {
  std::array<PolynomialPair, 2> out{*this, *this};
  const Real half = 0.5;
  std::vector<Real2> line;
  for (const auto& places : degrees.lines(edge)) {
    line.clear();
    for (const std::size_t k : places) line.push_back(c[k]);
    const std::size_t n = places.size() - 1;
    for (std::size_t level = 0; level <= n; ++level) {
      out[0].c[places[level]] = line[0];
      out[1].c[places[n - level]] = line[n - level];
      for (std::size_t k = 0; k + level < n; ++k) line[k] = half * (line[k] + line[k + 1]);
    }
  }
  return out;
}

namespace {

// The polynomial of degree n less one that fixing one argument of the polar form at `p` leaves.
std::vector<Real2> polar(const std::vector<Real2>& c, int n, const std::array<Real, 3>& p) {
  const Degrees from{true, n, n}, to{true, n - 1, n - 1};
  std::vector<Real2> out(to.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
      out[to.at(i, j)] = p[0] * c[from.at(i + 1, j)] + p[1] * c[from.at(i, j + 1)] + p[2] * c[from.at(i, j)];
  return out;
}

}  // namespace

PolynomialPair PolynomialPair::enlarged(const Real& by) const {
  PolynomialPair out = *this;
  if (!degrees.triangle) {
    // To [-by, 1], then that to [0, (1 + 2 by) / (1 + by)].
    const Real low = -by, high = (1 + 2 * by) / (1 + by);
    for (int edge = 0; edge < 2; ++edge)
      for (const auto& at : degrees.lines(edge)) {
        const std::size_t n = at.size() - 1;
        for (std::size_t level = 1; level <= n; ++level)
          for (std::size_t k = 0; k + level <= n; ++k)
            out.c[at[k]] = (1 - low) * out.c[at[k]] + low * out.c[at[k + 1]];
        for (std::size_t level = 1; level <= n; ++level)
          for (std::size_t k = n; k >= level; --k)
            out.c[at[k]] = (1 - high) * out.c[at[k - 1]] + high * out.c[at[k]];
      }
    return out;
  }
  // The corner of a = 1 goes to a = 1 + 2 by, b = c = -by, and so on.
  const std::array<Real, 3> corner[3] = {
      {1 + 2 * by, -by, -by}, {-by, 1 + 2 * by, -by}, {-by, -by, 1 + 2 * by}};
  std::vector<Real2> thirds = c;
  for (int k = 0; k <= degrees.n; ++k) {
    std::vector<Real2> seconds = thirds;
    for (int j = 0; j + k <= degrees.n; ++j) {
      const int i = degrees.n - j - k;
      std::vector<Real2> firsts = seconds;
      for (int l = i; l > 0; --l) firsts = polar(firsts, l, corner[0]);
      out.c[degrees.at(i, j)] = firsts[0];
      if (i > 0) seconds = polar(seconds, i, corner[1]);
    }
    if (k < degrees.n) thirds = polar(thirds, degrees.n - k, corner[2]);
  }
  return out;
}

PolynomialPair PolynomialPair::derivative(int parameter) const {
  const int degree = degrees.triangle || parameter == 1 ? degrees.n : degrees.m;
  PolynomialPair out(degrees.derived(parameter), {});
  out.c.assign(out.degrees.size(), Real2{Real(0), Real(0)});
  if (degree == 0) return out;
  const Real factor = degree;
  for (int i = 0; i <= out.degrees.m; ++i)
    for (int j = 0; j <= (degrees.triangle ? out.degrees.n - i : out.degrees.n); ++j) {
      const Real2& up = c[parameter == 0 ? degrees.at(i + 1, j) : degrees.at(i, j + 1)];
      out.c[out.degrees.at(i, j)] = factor * (up - c[degrees.at(i, j)]);
    }
  return out;
}

Real2 PolynomialPair::operator()(const Real& a, const Real& b) const {
  std::vector<Real2> f = c;
  if (degrees.triangle) {
    for (int n = degrees.n; n > 0; --n) f = polar(f, n, {a, b, 1 - a - b});
    return f[0];
  }
  const auto reduce = [](Real2* line, int n, const Real& t) {
    for (int level = n; level > 0; --level)
      for (int k = 0; k < level; ++k) line[k] = (1 - t) * line[k] + t * line[k + 1];
    return line[0];
  };
  std::vector<Real2> column;
  for (int i = 0; i <= degrees.m; ++i) column.push_back(reduce(&f[degrees.at(i, 0)], degrees.n, b));
  return reduce(column.data(), degrees.m, a);
}

Real PolynomialPair::change(int edge) const {
  Real most = 0;
  for (const auto& line : degrees.lines(edge))
    for (std::size_t k = 1; k < line.size(); ++k) most = std::max(most, size_of(c[line[k]] - c[line[k - 1]]));
  return most;
}

Jet jet(const PolynomialPair& f, const Real& a, const Real& b) {
  const PolynomialPair da = f.derivative(0), db = f.derivative(1);
  return {
      f(a, b), da(a, b), db(a, b), da.derivative(0)(a, b), da.derivative(1)(a, b), db.derivative(1)(a, b)};
}

}  // namespace rondure::oracle
