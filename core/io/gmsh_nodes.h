// From the numbers that a Gmsh file gives its nodes to their places in the file.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh::io {

class NodeNumbers {
 public:
  void add(long long tag) { tags_.push_back(tag); }  // from 1, as Gmsh counts
  std::size_t size() const { return tags_.size(); }

  // To be called after the last add(). Returns a tag that is there twice, if any. Consecutive tags, the
  // common case, need no table.
  std::optional<long long> finish() {
    const auto gap = [](long long a, long long b) { return b - 1 != a; };
    if (std::adjacent_find(tags_.begin(), tags_.end(), gap) == tags_.end()) return std::nullopt;
    for (std::size_t i = 0; i < tags_.size(); ++i) sorted_.emplace_back(tags_[i], static_cast<int>(i));
    std::sort(sorted_.begin(), sorted_.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end(), same);
    if (twice == sorted_.end()) return std::nullopt;
    return twice->first;
  }

  int find(long long tag) const {  // none if there is no such node
    if (sorted_.empty()) {
      const bool exists = !tags_.empty() && tag >= tags_.front() && tag <= tags_.back();
      return exists ? static_cast<int>(tag - tags_.front()) : none;
    }
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{tag, 0});
    return at != sorted_.end() && at->first == tag ? at->second : none;
  }

 private:
  std::vector<long long> tags_;
  std::vector<std::pair<long long, int>> sorted_;  // tag, place; empty where the tags are consecutive
};

}  // namespace kinemesh::io
