#include "renderer/inverse_spherical/spherical_triangle.h"

#include <glm/geometric.hpp>

#include "renderer/bezier/index.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

// |u^(l)_ijk| for every step l = 0..n of the algorithm.
std::vector<std::vector<double>> lengths_of_steps(const Iss& s, double u, double v) {
  std::vector<dvec3> work = s.u;
  std::vector<std::vector<double>> lengths;
  for (int left = s.n;; --left) {
    std::vector<double>& row = lengths.emplace_back();
    for (std::size_t k = 0; k < static_cast<std::size_t>(triangle_size(left)); ++k) {
      row.push_back(glm::length(work[k]));
    }
    if (left == 0) return lengths;
    detail::triangle_step(work.data(), left, dvec2(u, v));
  }
}

// From coefficient (i, j) of the step that leaves degree n - step, on to the end: the product of the factors
// alpha (equation 9) of every further step, summed over the ways there.
double paths_from(const std::vector<std::vector<double>>& lengths, const dvec3& tau, int n, int i, int j) {
  if (n == 0) return 1.0;
  const std::size_t step = lengths.size() - 1 - static_cast<std::size_t>(n);
  const double here = lengths[step][index(triangle_index(n, i, j))];
  const int exponents[3] = {i, j, n - i - j};
  double sum = 0.0;
  for (int m = 0; m < 3; ++m) {
    if (exponents[m] == 0) continue;
    const int ni = i - (m == 0 ? 1 : 0), nj = j - (m == 1 ? 1 : 0);
    const double alpha = tau[m] * here / lengths[step + 1][index(triangle_index(n - 1, ni, nj))];
    sum += alpha * paths_from(lengths, tau, n - 1, ni, nj);
  }
  return sum;
}

}  // namespace

double orientation(const dvec3& a, const dvec3& b, const dvec3& c) { return glm::dot(a, glm::cross(b, c)); }

dvec3 spherical_barycentric(const std::array<dvec3, 3>& corners, const dvec3& v) {
  dvec3 beta;
  for (int i = 0; i < 3; ++i) {
    // A scaled normal of P_i; the scale cancels in the ratio of the sines.
    const dvec3 normal = glm::cross(corners[static_cast<std::size_t>((i + 1) % 3)],
                                    corners[static_cast<std::size_t>((i + 2) % 3)]);
    beta[i] = glm::dot(v, normal) / glm::dot(corners[static_cast<std::size_t>(i)], normal);
  }
  return beta;
}

dvec3 domain_coordinates(const std::array<dvec3, 3>& corners, const dvec3& v) {
  // With the moduli left in the corners, beta_i / |u_i| comes out at once; t = 1 / sum.
  const dvec3 beta = spherical_barycentric(corners, v);
  const double sum = beta.x + beta.y + beta.z;
  return sum == 0.0 ? dvec3(0.0) : beta / sum;
}

std::vector<double> spherical_basis_by_paths(const Iss& s, double u, double v) {
  const std::vector<std::vector<double>> lengths = lengths_of_steps(s, u, v);
  const dvec3 tau(u, v, 1.0 - u - v);
  std::vector<double> basis;
  for (int i = 0; i <= s.n; ++i) {
    for (int j = 0; j <= s.n - i; ++j) basis.push_back(paths_from(lengths, tau, s.n, i, j));
  }
  return basis;
}

std::vector<double> spherical_basis(const Iss& s, double u, double v) {
  const detail::TriangleBasis<dynamic> bernstein(s.n, u, v);
  const double length = glm::length(triangle_value(s.u.data(), s.n, u, v));
  std::vector<double> basis(s.u.size());
  for (std::size_t k = 0; k < basis.size(); ++k) basis[k] = glm::length(s.u[k]) / length * bernstein.b[k];
  return basis;
}

}  // namespace rondure
