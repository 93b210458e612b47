#include "untangle/walk/box_tree.h"

#include <cmath>
#include <limits>

namespace kinemesh {

void BoxTree::build(std::span<const Box> boxes) {
  place(boxes);
  children_.clear();
  for (const Box& box : boxes) children_.push_back(rounded(box));
  n_levels_ = 0;
  while (children_.size() > (n_levels_ == 0 ? 0 : 1)) add_level();
}

// The boxes' corner at the origin and their extent of size one, so that floats tell small boxes apart.
void BoxTree::place(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  Box all = boxes.front();
  for (const Box& box : boxes) all = hull_of(all, box);
  origin_ = all.low;
  scale_ = 1.0 / std::max(all.high.x - all.low.x, all.high.y - all.low.y);
  if (!std::isnormal(scale_)) scale_ = 1.0;
}

// Nodes around the children, whose own bounds are the next children.
void BoxTree::add_level() {
  if (n_levels_ == static_cast<int>(levels_.size())) levels_.emplace_back();
  auto& nodes = levels_[n_levels_++];
  nodes.clear();
  for (std::size_t first = 0; first < children_.size(); first += fan) {
    const std::size_t n = std::min<std::size_t>(fan, children_.size() - first);
    const std::span some(children_.data() + first, n);
    nodes.push_back(node_of(some));
    children_[first / fan] = bounds_of(some);  // no longer needed
  }
  children_.resize(nodes.size());
}

BoxTree::Node BoxTree::node_of(std::span<const RoundedBox> children) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Node node;
  for (int i = 0; i < fan; ++i) {
    const auto [x0, y0, x1, y1] =
        i < static_cast<int>(children.size()) ? children[i] : RoundedBox{nan, nan, nan, nan};
    node.x0[i / lanes][i % lanes] = x0;
    node.y0[i / lanes][i % lanes] = y0;
    node.x1[i / lanes][i % lanes] = x1;
    node.y1[i / lanes][i % lanes] = y1;
  }
  return node;
}

BoxTree::RoundedBox BoxTree::bounds_of(std::span<const RoundedBox> boxes) {
  RoundedBox all = boxes.front();
  for (const auto& [x0, y0, x1, y1] : boxes)
    all = {std::min(all.x0, x0), std::min(all.y0, y0), std::max(all.x1, x1), std::max(all.y1, y1)};
  return all;
}

}  // namespace kinemesh
