// Numbers from 0 united into sets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace rondure {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  // The least of k's set.
  std::size_t first(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void unite(std::size_t a, std::size_t b) {
    a = first(a), b = first(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  // The number of each one's set, in order of their least.
  std::vector<int> numbers() {
    std::vector<int> of_first(parent_.size(), -1), out;
    int count = 0;
    for (std::size_t k = 0; k < parent_.size(); ++k) {
      int& number = of_first[first(k)];
      if (number < 0) number = count++;
      out.push_back(number);
    }
    return out;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace rondure
