#include "renderer/bezier/legendre_profile.h"

#include <algorithm>
#include <limits>

namespace rondure {

Series series(const Grid& values, int m, int n, const GaussRule& in_u, const GaussRule& in_v) {
  const int nu = in_u.count, nv = in_v.count;
  Series out{m, n, Grid(static_cast<std::size_t>((m + 1) * (n + 1))), 0.0};
  Grid row(static_cast<std::size_t>(nv));
  for (int k = 0; k <= m; ++k) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int i = 0; i < nu; ++i) {
      const double p = in_u.project[grid_index(k, nu, i)];
      for (int j = 0; j < nv; ++j) row[static_cast<std::size_t>(j)] += p * values[grid_index(i, nv, j)];
    }
    for (int l = 0; l <= n; ++l) {
      double sum = 0.0;
      for (int j = 0; j < nv; ++j)
        sum += in_v.project[grid_index(l, nv, j)] * row[static_cast<std::size_t>(j)];
      out.coefficients[grid_index(k, n + 1, l)] = sum;
    }
  }
  for (const double v : values) out.error = std::max(out.error, std::abs(v));
  out.error *= std::numeric_limits<double>::epsilon() * static_cast<double>(8 * (nu + nv));
  return out;
}

Profile profile(const Series& s) {
  Profile out;
  out.middle = s.coefficients[0];
  out.in_u.assign(static_cast<std::size_t>(s.m) + 1, 0.0);
  out.in_v.assign(static_cast<std::size_t>(s.n) + 1, 0.0);
  for (int k = 0; k <= s.m; ++k) {
    for (int l = 0; l <= s.n; ++l) {
      const double c = std::abs(s.coefficients[grid_index(k, s.n + 1, l)]) +
                       s.error * static_cast<double>((2 * k + 1) * (2 * l + 1));
      out.in_u[static_cast<std::size_t>(k)] += c;
      out.in_v[static_cast<std::size_t>(l)] += c;
    }
  }
  return out;
}

}  // namespace rondure
