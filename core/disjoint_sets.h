// Disjoint sets of the numbers 0 to n - 1, which can be joined.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace kinemesh {

class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int i) {  // the smallest number of its set
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace kinemesh
