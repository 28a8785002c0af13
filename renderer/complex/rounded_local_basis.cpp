#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "renderer/bezier/index.h"
#include "renderer/complex/local_basis.h"

namespace rondure {
namespace {

using Dense = Eigen::MatrixXd;
using Eigen::Index;

// Orthonormal columns that span the null space, and by how much the factor's diagonal falls behind the rank.
struct Null {
  Dense basis;
  double gap = 0.0;
};

// By Householder's factorisation of the transpose with column pivots (Businger and Golub 1965).
Null null_space_of(const Dense& m) {
  if (m.rows() == 0) return {Dense::Identity(m.cols(), m.cols()), std::numeric_limits<double>::infinity()};
  const Eigen::ColPivHouseholderQR<Dense> qr(m.transpose());
  const Dense& r = qr.matrixR();
  const Index most = std::min(r.rows(), r.cols());
  const double first = std::abs(r(0, 0));
  Index rank = 0;
  while (rank < most && std::abs(r(rank, rank)) > 1e-10 * first) ++rank;
  Null out;
  const double next = rank < most ? std::abs(r(rank, rank)) : 0.0;
  out.gap = rank > 0 ? std::abs(r(rank - 1, rank - 1)) / std::max(next, 1e-16 * first) : 0.0;
  out.basis = Dense::Zero(m.cols(), m.cols() - rank);
  out.basis.bottomRows(m.cols() - rank).setIdentity();
  out.basis.applyOnTheLeft(qr.householderQ());
  return out;
}

class RoundedLocalBasis {
 public:
  RoundedLocalBasis(const SurfaceComplex& complex, int n)
      : space_{n, coefficient_offsets(complex, n), {}, {}}, unknowns_(space_.offsets.back()) {
    const std::vector<SparseRow> rows = gc1_conditions(complex, n, {});
    conditions_ = Dense::Zero(static_cast<Index>(rows.size()), unknowns_);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto row = static_cast<Index>(r);
      for (const auto& [unknown, c] : rows[r]) conditions_(row, unknown) = rounded(c);
      const double largest = conditions_.row(row).cwiseAbs().maxCoeff();
      if (largest > 0.0) conditions_.row(row) /= largest;
    }
    space_.solutions.exact = false;
  }

  SplineSpace run(const std::vector<std::vector<std::vector<int>>>& stages) {
    const Null all = null_space_of(conditions_);
    space_.solutions.gap = all.gap;
    if (!(all.gap >= least_gap))
      throw std::runtime_error(
          fmt::format("the rank of the continuity conditions is not clear: pivots fall by a factor of {:.3g} "
                      "only where they should vanish",
                      all.gap));
    dimension_ = all.basis.cols();
    functions_ = spanned_ = Dense::Zero(unknowns_, dimension_);
    for (const auto& stage : stages) {
      for (const std::vector<int>& region : stage) search(region);
    }
    std::vector<int> everywhere;
    for (int k = 0; k < unknowns_; ++k) everywhere.push_back(k);
    add(all.basis, everywhere, 0.5);
    if (found_ != dimension_)
      throw std::runtime_error(
          fmt::format("{} functions were found in a space of dimension {}", found_, dimension_));
    name();
    return std::move(space_);
  }

 private:
  static constexpr double least_gap = 1e3;
  // Of a function of length 1, what must be outside the span of those before it.
  static constexpr double least_share = 0.1;
  // Of coefficients on a region: wider ones take long, and local is what they are not.
  static constexpr std::size_t most_unknowns = 320;

  SplineSpace space_;
  int unknowns_;
  Dense conditions_;
  Index dimension_ = 0, found_ = 0;
  Dense functions_, spanned_;  // those found; an orthonormal basis of what they span

  // Functions that vanish outside the region.
  void search(const std::vector<int>& region) {
    std::vector<int> columns;
    for (const int p : region) {
      for (int k = space_.offsets[index(p)]; k < space_.offsets[index(p) + 1]; ++k) columns.push_back(k);
    }
    if (found_ == dimension_ || columns.size() > most_unknowns ||
        static_cast<int>(columns.size()) == unknowns_)
      return;
    const Dense block = conditions_(Eigen::all, columns);
    std::vector<Index> rows;
    for (Index r = 0; r < block.rows(); ++r) {
      if (!block.row(r).isZero(0.0)) rows.push_back(r);
    }
    const Null null = null_space_of(block(rows, Eigen::all));
    if (!(null.gap >= least_gap) || null.basis.cols() == 0) return;
    if (add(null.basis, columns, least_share))
      space_.solutions.gap = std::min(space_.solutions.gap, null.gap);
  }

  // Of the span of `basis` (rows: the unknowns named by `columns`) the directions whose share outside the
  // span of what is found is at least so large: they are the singular vectors of the projection.
  bool add(const Dense& basis, const std::vector<int>& columns, double share) {
    const Dense inside = spanned_.leftCols(found_)(columns, Eigen::all).transpose() * basis;
    const Dense gram = Dense::Identity(basis.cols(), basis.cols()) - inside.transpose() * inside;
    const Eigen::SelfAdjointEigenSolver<Dense> shares(gram);
    bool any = false;
    for (Index k = basis.cols();
         k-- > 0 && found_ < dimension_ && shares.eigenvalues()(k) >= share * share;) {
      const Eigen::VectorXd values = basis * shares.eigenvectors().col(k);
      Eigen::VectorXd function = Eigen::VectorXd::Zero(unknowns_);
      function(columns) = values;
      functions_.col(found_) = function;
      for (int twice = 0; twice < 2; ++twice) {
        const Eigen::VectorXd shadow = spanned_.leftCols(found_).transpose() * function;
        function -= spanned_.leftCols(found_) * shadow;
      }
      spanned_.col(found_++) = function.normalized();
      any = true;
    }
    return any;
  }

  // Gives every function an unknown of its own, where it becomes 1: one at which it is as large as can be, by
  // augmenting paths along the largest values first, then along less and less.
  void name() {
    std::vector<int> owner(index(unknowns_), -1);
    std::vector<bool> named(static_cast<std::size_t>(dimension_), false), tried;
    double least = 1.0;
    const std::function<bool(Index)> assign = [&](Index k) {
      const double largest = functions_.col(k).cwiseAbs().maxCoeff();
      for (const bool taken : {false, true}) {
        for (int unknown = 0; unknown < unknowns_; ++unknown) {
          if (std::abs(functions_(unknown, k)) < least * largest) continue;
          int& own = owner[index(unknown)];
          if (tried[index(unknown)] || (own >= 0) != taken) continue;
          tried[index(unknown)] = true;
          if (taken && !assign(own)) continue;
          own = static_cast<int>(k);
          return true;
        }
      }
      return false;
    };
    for (; least > 1e-6; least *= 0.75) {
      for (Index k = 0; k < dimension_; ++k) {
        const auto at = static_cast<std::size_t>(k);
        tried.assign(index(unknowns_), false);
        if (!named[at]) named[at] = assign(k);
      }
    }
    NullSpace& out = space_.solutions;
    for (int unknown = 0; unknown < unknowns_; ++unknown) {
      const int k = owner[index(unknown)];
      if (k < 0) continue;
      SparseRow function;
      for (int other = 0; other < unknowns_; ++other) {
        const double value = functions_(other, k) / functions_(unknown, k);
        // Rounding of entries that cancel.
        if (std::abs(value) > 1e-13) function.emplace_back(other, exact_of(value));
      }
      out.basis.push_back(std::move(function));
      out.free.push_back(unknown);
    }
    out.rank = unknowns_ - static_cast<int>(dimension_);
  }
};

}  // namespace

SplineSpace rounded_local_space(const SurfaceComplex& complex, int n) {
  return RoundedLocalBasis(complex, n).run(support_stages(complex));
}

}  // namespace rondure
