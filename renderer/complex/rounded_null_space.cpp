#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/complex/null_space.h"

namespace rondure {
namespace {

using Dense = Eigen::MatrixXd;

// Columns in the order of elimination, every row's largest entry 1 in size.
Dense dense_of(const std::vector<SparseRow>& rows, const std::vector<int>& order) {
  std::vector<Eigen::Index> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<Eigen::Index>(k);
  Dense m = Dense::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(order.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    for (const auto& [unknown, c] : rows[r]) m(row, place[static_cast<std::size_t>(unknown)]) = rounded(c);
    const double largest = m.row(row).cwiseAbs().maxCoeff();
    if (largest > 0.0) m.row(row) /= largest;
  }
  return m;
}

// The rank, and the fall of the singular values behind it.
struct Rank {
  Eigen::Index rank = 0;
  double gap = 0.0, least = 0.0;
};

Rank rank_of(const Dense& m) {
  const Eigen::BDCSVD<Dense> svd(m);
  const Eigen::VectorXd& s = svd.singularValues();
  Rank best;
  for (Eigen::Index k = 0; k < s.size() && s(k) > 1e-6 * s(0); ++k) {
    // A singular value that is all rounding counts as that rounding.
    const double floor = 1e-16 * s(0) * std::sqrt(static_cast<double>(m.cols()));
    const double next = k + 1 < s.size() ? std::max(s(k + 1), floor) : floor;
    if (next <= 1e-6 * s(0) && s(k) / next > best.gap) best = {k + 1, s(k) / next, s(k)};
  }
  return best;
}

}  // namespace

NullSpace rounded_null_space(const std::vector<SparseRow>& rows, const std::vector<int>& order) {
  Dense m = dense_of(rows, order);
  NullSpace out;
  out.exact = false;
  Rank rank;
  if (m.rows() > 0) {
    rank = rank_of(m);
    out.gap = rank.gap;
    if (!(rank.gap >= 1e3))
      throw std::runtime_error(
          fmt::format("the rank of the continuity conditions is not clear: singular values fall by a factor "
                      "of {:.3g} only where they should vanish",
                      rank.gap));
  }
  // Gauss-Jordan elimination, column by column, with the largest entry left as the pivot.
  std::vector<Eigen::Index> pivot_row(order.size(), -1);
  Eigen::Index used = 0;
  const double negligible = 1e-3 * rank.least;
  for (Eigen::Index c = 0; c < m.cols() && used < m.rows(); ++c) {
    Eigen::Index best = used;
    const double size = m.col(c).tail(m.rows() - used).cwiseAbs().maxCoeff(&best);
    if (!(size > negligible)) continue;
    m.row(used).swap(m.row(used + best));
    m.row(used) /= m(used, c);
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      if (r != used && m(r, c) != 0.0) m.row(r) -= m(r, c) * m.row(used);
    }
    pivot_row[static_cast<std::size_t>(c)] = used++;
  }
  if (used != rank.rank)
    throw std::runtime_error(
        fmt::format("the rank of the continuity conditions is not clear: {} by their singular values, {} by "
                    "elimination",
                    rank.rank, used));
  out.rank = static_cast<int>(rank.rank);
  for (std::size_t f = 0; f < order.size(); ++f) {
    if (pivot_row[f] >= 0) continue;
    SparseRow vector{{order[f], Exact(1)}};
    for (std::size_t c = 0; c < order.size(); ++c) {
      if (pivot_row[c] < 0) continue;
      const double x = -m(pivot_row[c], static_cast<Eigen::Index>(f));
      // Rounding of entries that cancel, relative to 1.
      if (std::abs(x) > 1e-12) vector.emplace_back(order[c], exact_of(x));
    }
    std::sort(vector.begin(), vector.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    out.free.push_back(order[f]);
    out.basis.push_back(std::move(vector));
  }
  return out;
}

double largest_entry(const NullSpace& space) {
  double largest = 0.0;
  for (const SparseRow& row : space.basis) {
    for (const auto& entry : row) largest = std::max(largest, std::abs(rounded(entry.second)));
  }
  return largest;
}

}  // namespace rondure
