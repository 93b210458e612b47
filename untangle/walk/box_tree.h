// Spatial index over boxes that come in spatial order, as those of a mesh's faces do.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"

namespace kinemesh {

// An R-tree packed in the order given: each node holds the bounding boxes of `fan` neighbours of the level
// below and meets a query with all of them at once. Built in O(n), without sorting; any order is right, a
// spatial one quick.
class BoxTree {
 public:
  // Keeps its memory from one build to the next.
  void build(std::span<const Box> boxes);

  // True if hit(i) holds for a box i. Asks, in ascending order, for those that meet the query, borders
  // included, and for some that only come close.
  template <class Hit>
  bool any(const Box& query, const Hit& hit) const {
    return n_levels_ > 0 && any_below(n_levels_ - 1, 0, rounded(query), hit);
  }

 private:
  static constexpr int fan = 8;
  static constexpr int lanes = 4;  // that any machine compares at once
  using Floats = float __attribute__((vector_size(lanes * sizeof(float))));

  struct RoundedBox {
    float x0, y0, x1, y1;
  };
  struct Node {
    std::array<Floats, fan / lanes> x0, y0, x1, y1;  // of its children; not a number where there is none
  };

  // Bit i: child i meets the query.
  static unsigned meeting(const Node& node, const RoundedBox& query) {
    unsigned children = 0;
    for (int i = 0; i < fan / lanes; ++i) {
      const auto meets = (node.x0[i] <= query.x1) & (node.x1[i] >= query.x0) & (node.y0[i] <= query.y1) &
                         (node.y1[i] >= query.y0);
      children |= bits_of(meets) << (i * lanes);
    }
    return children;
  }
  template <class Mask>
  static unsigned bits_of(const Mask& mask) {
    const auto bits = std::bit_cast<std::array<std::uint64_t, 2>>(mask & Mask{1, 2, 4, 8});
    const std::uint64_t both = bits[0] | bits[1];
    return static_cast<unsigned>(both | both >> 32);
  }

  template <class Hit>
  bool any_below(int level, std::size_t node, const RoundedBox& query, const Hit& hit) const {
    for (unsigned children = meeting(levels_[level][node], query); children != 0; children &= children - 1) {
      const std::size_t child = node * fan + static_cast<std::size_t>(std::countr_zero(children));
      if (level == 0 ? hit(static_cast<int>(child)) : any_below(level - 1, child, query, hit)) return true;
    }
    return false;
  }

  void place(std::span<const Box> boxes);
  void add_level();
  static Node node_of(std::span<const RoundedBox> children);
  static RoundedBox bounds_of(std::span<const RoundedBox> boxes);

  // Coordinates become floats by a map that keeps their order, so that what meets before meets afterwards.
  RoundedBox rounded(const Box& box) const {
    return {rounded(box.low.x, origin_.x), rounded(box.low.y, origin_.y), rounded(box.high.x, origin_.x),
            rounded(box.high.y, origin_.y)};
  }
  float rounded(double value, double origin) const { return static_cast<float>((value - origin) * scale_); }

  Point origin_{0.0, 0.0};
  double scale_ = 1.0;
  int n_levels_ = 0;
  std::vector<std::vector<Node>> levels_;  // from the boxes up to a single node; memory behind them
  std::vector<RoundedBox> children_;       // of the level that is being built
};

}  // namespace kinemesh
