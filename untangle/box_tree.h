// Spatial index over boxes that come in spatial order, as those of a mesh's faces do.
#pragma once

#include <span>
#include <vector>

#include "untangle/box.h"

namespace kinemesh {

// An R-tree packed in the order given: each node is the bounding box of `fan` neighbours of the level below.
// Built in O(n), without sorting; any order is right, a spatial one quick.
class BoxTree {
 public:
  // Keeps its memory from one build to the next.
  void build(std::span<const Box> boxes);

  // True if hit(i) holds for a box i that meets the query, borders included. Asks in ascending order.
  template <class Hit>
  bool any(const Box& query, const Hit& hit) const {
    return !levels_.empty() && any_below(static_cast<int>(levels_.size()) - 1, 0, query, hit);
  }

 private:
  static constexpr std::size_t fan = 8;

  // Among the children, on a level, of the node with this number.
  template <class Hit>
  bool any_below(int level, std::size_t node, const Box& query, const Hit& hit) const {
    const std::vector<Box>& boxes = levels_[level];
    const std::size_t end = std::min((node + 1) * fan, boxes.size());
    for (std::size_t i = node * fan; i < end; ++i) {
      if (!meet(boxes[i], query)) continue;
      if (level == 0 ? hit(static_cast<int>(i)) : any_below(level - 1, i, query, hit)) return true;
    }
    return false;
  }

  std::vector<std::vector<Box>> levels_;  // from the boxes up to a level of at most `fan`
};

}  // namespace kinemesh
