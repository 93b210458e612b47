// Distance to the nearest of many segments.
#pragma once

#include <memory>
#include <span>

#include "kinemesh/types.h"

namespace kinemesh {

// Of p to the closed segment a, b, which may be a point. Rounded.
double distance_to_segment(const Point& p, const Point& a, const Point& b);

// R-tree over segments. Built in O(n log n), asked in about O(log n), from several threads at once.
class SegmentIndex {
 public:
  // Copies the end points. Pre: finite.
  SegmentIndex(std::span<const Point> points, std::span<const Edge> edges);
  ~SegmentIndex();

  double distance(const Point& p) const;                  // infinity without segments
  bool maybe_within(const Point& p, double reach) const;  // false: farther than reach from all; constant time

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  Point low_, high_;  // box around all segments
};

}  // namespace kinemesh
