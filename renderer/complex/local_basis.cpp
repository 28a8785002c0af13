#include "renderer/complex/local_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "renderer/bezier/index.h"
#include "renderer/bezier/least_squares.h"
#include "renderer/complex/modular.h"

namespace rondure {
namespace {

using Region = std::vector<int>;  // polygons, in order

Region united(const std::vector<Region>& around, const std::vector<int>& of) {
  std::set<int> all;
  for (const int k : of) all.insert(around[index(k)].begin(), around[index(k)].end());
  return {all.begin(), all.end()};
}

class LocalBasis {
 public:
  LocalBasis(const SurfaceComplex& complex, int n)
      : space_{n, coefficient_offsets(complex, n), {}, {}},
        rows_(gc1_conditions(complex, n, {})),
        order_(elimination_order(complex, n)),
        place_(order_.size()),
        found_(order_.size()) {
    // The last in the order of elimination first: what is free where there is a choice.
    for (std::size_t k = 0; k < order_.size(); ++k)
      place_[index(order_[k])] = static_cast<int>(order_.size() - 1 - k);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      for (const auto& entry : rows_[r]) {
        std::vector<std::size_t>& list = rows_of_[polygon_of(entry.first)];
        if (list.empty() || list.back() != r) list.push_back(r);
      }
    }
  }

  SplineSpace run(const std::vector<std::vector<Region>>& stages) {
    Region all(space_.offsets.size() - 1);
    std::iota(all.begin(), all.end(), 0);
    const std::size_t dimension = modular_dimension(all, rows_in(all));
    for (const std::vector<Region>& stage : stages) {
      for (const Region& region : stage) {
        if (found_.rank() == dimension) break;
        search(region);
      }
    }
    name();
    return std::move(space_);
  }

 private:
  SplineSpace space_;
  std::vector<SparseRow> rows_;
  std::vector<int> order_;
  std::vector<int> place_;  // of an unknown in found_
  std::map<int, std::vector<std::size_t>> rows_of_;
  ModularEchelon found_;
  struct Function {
    SparseRow values;
    int made_from;
  };
  std::vector<Function> functions_;
  std::vector<Region> supports_;  // of the functions

  int polygon_of(int unknown) const {
    const auto after = std::upper_bound(space_.offsets.begin(), space_.offsets.end(), unknown);
    return static_cast<int>(after - space_.offsets.begin()) - 1;
  }

  bool holds(const Region& region, int unknown) const {
    return std::binary_search(region.begin(), region.end(), polygon_of(unknown));
  }

  // The conditions on functions that vanish outside the region.
  std::vector<SparseRow> rows_in(const Region& region) {
    std::set<std::size_t> numbers;
    for (const int p : region) numbers.insert(rows_of_[p].begin(), rows_of_[p].end());
    std::vector<SparseRow> out;
    for (const std::size_t r : numbers) {
      SparseRow row;
      for (const auto& entry : rows_[r]) {
        if (holds(region, entry.first)) row.push_back(entry);
      }
      if (!row.empty()) out.push_back(std::move(row));
    }
    return out;
  }

  std::size_t modular_dimension(const Region& region, const std::vector<SparseRow>& rows) const {
    ModularEchelon echelon(order_.size());
    // Eliminated as the rows are: the places run the other way.
    std::vector<int> places(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) places[index(order_[k])] = static_cast<int>(k);
    for (const SparseRow& row : rows) echelon.add(modular_row(row, places));
    std::size_t unknowns = 0;
    for (const int p : region) unknowns += index(space_.offsets[index(p) + 1] - space_.offsets[index(p)]);
    return unknowns - echelon.rank();
  }

  // Adds functions of the region until those found span all that it has.
  void search(const Region& region) {
    const std::vector<SparseRow> rows = rows_in(region);
    auto known = static_cast<std::size_t>(
        std::count_if(supports_.begin(), supports_.end(), [&](const Region& support) {
          return std::includes(region.begin(), region.end(), support.begin(), support.end());
        }));
    const std::size_t dimension = modular_dimension(region, rows);
    if (known >= dimension) return;
    std::vector<int> order;
    for (const int unknown : order_) {
      if (holds(region, unknown)) order.push_back(unknown);
    }
    NullSpace local = exact_null_space(rows, order);
    for (std::size_t k = 0; k < local.basis.size() && known < dimension; ++k) {
      SparseRow& function = local.basis[k];
      if (!found_.add(modular_row(function, place_))) continue;
      ++known;
      reduce(function, region);
      std::set<int> support;
      for (const auto& entry : function) support.insert(polygon_of(entry.first));
      supports_.emplace_back(support.begin(), support.end());
      functions_.push_back({std::move(function), local.free[k]});
    }
  }

  // Takes from a function with large values, as elimination on wide regions makes them, what functions known
  // before have in common with it: the best multiples in the sum of squares, rounded to short numbers, so
  // that what is left is exact.
  void reduce(SparseRow& function, const Region& region) const {
    constexpr int most_rounds = 6;
    for (int round = 0; round < most_rounds && size_of(function) > 16.0; ++round) {
      std::vector<std::size_t> inside;
      for (std::size_t k = 0; k < functions_.size(); ++k) {
        if (std::includes(region.begin(), region.end(), supports_[k].begin(), supports_[k].end()))
          inside.push_back(k);
      }
      std::map<int, std::size_t> rows;  // by unknown
      const auto note = [&](const SparseRow& values) {
        for (const auto& entry : values) rows.emplace(entry.first, rows.size());
      };
      note(function);
      for (const std::size_t k : inside) note(functions_[k].values);
      if (inside.empty() || rows.size() < inside.size()) return;
      Matrix a(rows.size(), inside.size());
      std::vector<std::vector<double>> right(1, std::vector<double>(rows.size(), 0.0));
      for (const auto& [unknown, c] : function) right[0][rows.at(unknown)] = rounded(c);
      for (std::size_t k = 0; k < inside.size(); ++k) {
        for (const auto& [unknown, c] : functions_[inside[k]].values) a.at(rows.at(unknown), k) = rounded(c);
      }
      const std::vector<double> factors = least_squares(std::move(a), std::move(right))[0];
      std::map<int, Exact> left(function.begin(), function.end());
      for (std::size_t k = 0; k < inside.size(); ++k) {
        const double factor = std::nearbyint(factors[k] * 64.0) / 64.0;
        if (!(std::isfinite(factor) && factor != 0.0)) continue;
        for (const auto& [unknown, c] : functions_[inside[k]].values) left[unknown] -= exact_of(factor) * c;
      }
      SparseRow next;
      for (const auto& [unknown, c] : left) {
        if (c != 0) next.emplace_back(unknown, c);
      }
      if (!(size_of(next) < 0.5 * size_of(function))) return;
      function = std::move(next);
    }
  }

  static double size_of(const SparseRow& function) {
    double size = 0.0;
    for (const auto& entry : function) size = std::max(size, std::abs(rounded(entry.second)));
    return size;
  }

  // Gives every function an unknown of its own at which it is not 0, one of the pivots: since the matrix of
  // the functions' values at those is regular, some product along a permutation is not 0. Augmenting paths.
  void name() {
    std::vector<int> owner(order_.size(), -1);
    std::vector<bool> tried;
    const std::function<bool(std::size_t)> assign = [&](std::size_t k) {
      for (const bool taken : {false, true}) {
        for (const int unknown : choices(k)) {
          if (tried[index(unknown)] || (owner[index(unknown)] >= 0) != taken) continue;
          tried[index(unknown)] = true;
          if (taken && !assign(index(owner[index(unknown)]))) continue;
          owner[index(unknown)] = static_cast<int>(k);
          return true;
        }
      }
      return false;
    };
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      tried.assign(order_.size(), false);
      assign(k);
    }
    NullSpace& out = space_.solutions;
    for (std::size_t unknown = 0; unknown < owner.size(); ++unknown) {
      if (owner[unknown] < 0) continue;
      SparseRow& function = functions_[index(owner[unknown])].values;
      const auto at = std::find_if(function.begin(), function.end(),
                                   [&](const auto& entry) { return index(entry.first) == unknown; });
      const Exact size = at->second;
      for (auto& entry : function) entry.second /= size;
      out.basis.push_back(std::move(function));
      out.free.push_back(static_cast<int>(unknown));
    }
    out.rank = static_cast<int>(order_.size() - out.basis.size());
  }

  // The pivots among a function's unknowns: those where it is largest first, and before them the one that it
  // was made from, unless that is much less.
  std::vector<int> choices(std::size_t k) const {
    std::vector<std::pair<double, int>> sizes;
    const Function& f = functions_[k];
    for (const auto& [unknown, c] : f.values) {
      const double size = std::abs(rounded(c)) * (unknown == f.made_from ? 4.0 : 1.0);
      if (found_.is_pivot(index(place_[index(unknown)]))) sizes.emplace_back(-size, unknown);
    }
    std::sort(sizes.begin(), sizes.end());
    std::vector<int> out;
    for (const auto& [size, unknown] : sizes) out.push_back(unknown);
    return out;
  }
};

}  // namespace

std::vector<std::vector<std::vector<int>>> support_stages(const SurfaceComplex& complex) {
  const int polygons = static_cast<int>(complex.sides.size());
  std::vector<std::set<Region>> stages(5);
  std::vector<Region> around_vertex;
  const std::vector<VertexFan> fans = vertex_fans(complex);
  const std::vector<std::vector<int>> fan_at = fan_of_corner(complex, fans);
  for (const VertexFan& fan : fans) {
    std::set<int> all;
    for (const Corner& c : fan.corners) all.insert(c.polygon);
    around_vertex.emplace_back(all.begin(), all.end());
    stages[2].insert(around_vertex.back());
  }
  std::vector<Region> ring;
  for (int p = 0; p < polygons; ++p) {
    stages[0].insert({p});
    ring.push_back(united(around_vertex, fan_at[index(p)]));
    stages[4].insert(ring.back());
  }
  for (const EdgeJoin& join : complex.joins) {
    stages[1].insert({std::min(join.p.polygon, join.q.polygon), std::max(join.p.polygon, join.q.polygon)});
    const std::vector<int>& corners = fan_at[index(join.p.polygon)];
    const std::size_t end = index((join.p.edge + 1) % static_cast<int>(corners.size()));
    stages[3].insert(united(around_vertex, {corners[index(join.p.edge)], corners[end]}));
  }
  // Wider rings, until they grow no more.
  std::vector<Region> wide = ring;
  for (bool grew = true; grew;) {
    grew = false;
    for (Region& region : wide) {
      Region next = united(ring, region);
      grew = grew || next.size() > region.size();
      region = std::move(next);
    }
    if (grew) stages.emplace_back(wide.begin(), wide.end());
  }
  std::vector<std::vector<Region>> out;
  for (const std::set<Region>& stage : stages) out.emplace_back(stage.begin(), stage.end());
  return out;
}

SplineSpace local_spline_space(const SurfaceComplex& complex, int n) {
  return LocalBasis(complex, n).run(support_stages(complex));
}

}  // namespace rondure
