// Disjoint sets of the numbers 0 to n - 1.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace kinemesh {

class DisjointSets {
 public:
  explicit DisjointSets(int n) : count_(n), parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int count() const { return count_; }  // of sets

  // The smallest of the set.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    if (low == high) return;
    parent_[high] = low;
    --count_;
  }

 private:
  int count_;
  std::vector<int> parent_;
};

}  // namespace kinemesh
