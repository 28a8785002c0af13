#include <algorithm>
#include <map>
#include <utility>

#include "renderer/bezier/index.h"
#include "renderer/complex/null_space.h"

namespace rondure {
namespace {

// Sorted by column, no zeros; columns are places in the order of elimination.
using Row = std::vector<std::pair<int, Integer>>;

void divide_content(Row& row) {
  Integer common = 0;
  for (const auto& entry : row) {
    common = gcd(common, entry.second);
    if (common == 1) return;
  }
  for (auto& entry : row) entry.second /= common;
}

Row to_integers(const SparseRow& row, const std::vector<int>& place) {
  Integer common = 1;
  for (const auto& entry : row) common = lcm(common, Integer(denominator(entry.second)));
  Row out;
  for (const auto& [unknown, c] : row) {
    out.emplace_back(place[index(unknown)], Integer(numerator(c)) * (common / Integer(denominator(c))));
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  divide_content(out);
  return out;
}

// a row - b pivot without the leading entry, which cancels; divided by the common factor.
Row eliminated(const Row& row, const Row& pivot) {
  const Integer common = gcd(row.front().second, pivot.front().second);
  const Integer a = pivot.front().second / common, b = row.front().second / common;
  Row out;
  auto r = row.begin() + 1;
  auto p = pivot.begin() + 1;
  while (r != row.end() || p != pivot.end()) {
    if (p == pivot.end() || (r != row.end() && r->first < p->first)) {
      out.emplace_back(r->first, a * r->second);
      ++r;
    } else if (r == row.end() || p->first < r->first) {
      out.emplace_back(p->first, -b * p->second);
      ++p;
    } else {
      Integer sum = a * r->second - b * p->second;
      if (sum != 0) out.emplace_back(r->first, std::move(sum));
      ++r, ++p;
    }
  }
  divide_content(out);
  return out;
}

}  // namespace

NullSpace exact_null_space(const std::vector<SparseRow>& rows, const std::vector<int>& order) {
  const int last = order.empty() ? -1 : *std::max_element(order.begin(), order.end());
  std::vector<int> place(index(last + 1));
  for (std::size_t k = 0; k < order.size(); ++k) place[index(order[k])] = static_cast<int>(k);
  std::vector<std::vector<Row>> by_lead(order.size());
  for (const SparseRow& row : rows) {
    if (row.empty()) continue;
    Row made = to_integers(row, place);
    by_lead[index(made.front().first)].push_back(std::move(made));
  }
  std::vector<Row> pivots(order.size());
  for (std::size_t column = 0; column < order.size(); ++column) {
    std::vector<Row> here = std::move(by_lead[column]);
    if (here.empty()) continue;
    const auto shortest = std::min_element(here.begin(), here.end(),
                                           [](const Row& a, const Row& b) { return a.size() < b.size(); });
    std::swap(*shortest, here.back());
    Row pivot = std::move(here.back());
    here.pop_back();
    for (const Row& row : here) {
      Row rest = eliminated(row, pivot);
      if (!rest.empty()) by_lead[index(rest.front().first)].push_back(std::move(rest));
    }
    pivots[column] = std::move(pivot);
  }
  // Every unknown as a combination of the free ones, from the last backwards.
  NullSpace out;
  std::vector<std::map<int, Exact>> value(order.size());
  std::vector<int> number(order.size(), -1);  // of the free unknown at a place
  for (std::size_t column = order.size(); column-- > 0;) {
    if (pivots[column].empty()) {
      number[column] = 0;
      value[column][static_cast<int>(column)] = 1;
      continue;
    }
    ++out.rank;
    const Row& row = pivots[column];
    for (std::size_t k = 1; k < row.size(); ++k) {
      const Exact factor = -Exact(row[k].second) / Exact(row[0].second);
      for (const auto& [at, c] : value[index(row[k].first)]) {
        Exact& sum = value[column][at];
        sum += factor * c;
        if (sum == 0) value[column].erase(at);
      }
    }
  }
  for (std::size_t column = 0; column < order.size(); ++column) {
    if (number[column] < 0) continue;
    number[column] = static_cast<int>(out.free.size());
    out.free.push_back(order[column]);
  }
  out.basis.resize(out.free.size());
  for (std::size_t column = 0; column < order.size(); ++column) {
    for (const auto& [at, c] : value[column]) {
      out.basis[index(number[index(at)])].emplace_back(order[column], c);
    }
  }
  for (SparseRow& row : out.basis) {
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  return out;
}

}  // namespace rondure
