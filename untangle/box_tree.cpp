#include "untangle/box_tree.h"

namespace kinemesh {
namespace {

void bound(const std::vector<Box>& boxes, std::size_t fan, std::vector<Box>& nodes) {
  nodes.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % fan == 0)
      nodes.push_back(boxes[i]);
    else
      nodes.back() = hull_of(nodes.back(), boxes[i]);
  }
}

}  // namespace

void BoxTree::build(std::span<const Box> boxes) {
  std::size_t n_levels = 1;
  for (std::size_t n = boxes.size(); n > fan; n = (n + fan - 1) / fan) ++n_levels;
  levels_.resize(n_levels);
  levels_[0].assign(boxes.begin(), boxes.end());
  for (std::size_t level = 1; level < n_levels; ++level) bound(levels_[level - 1], fan, levels_[level]);
}

}  // namespace kinemesh
