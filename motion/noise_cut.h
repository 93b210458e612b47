// Keeps noise inside the domain.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/segment_index.h"

namespace kinemesh {

// Shortens random vectors to half the distance from their vertex to the nearest edge. Built for the positions
// at the start of a step; a coarse grid of the cells near an edge spares most vertices the search.
class NoiseCut {
 public:
  // longest: no vector will be longer; closest: vectors that would bring a vertex nearer to an edge than this
  // become 0. Without it vertices beside an edge, cut again and again, would gather on it. Pre: finite
  // positions.
  NoiseCut(std::span<const Point> points, std::span<const Edge> edges, double longest, double closest = 0.0);

  // From several threads at once.
  Point operator()(const Point& x, const Point& noise) const;

 private:
  void mark(const Point& a, const Point& b, double reach);
  bool is_near(const Point& x) const;
  int column(double x) const;
  int row(double y) const;

  SegmentIndex edges_;
  double closest_;
  bool all_near_ = false;
  Point low_{0.0, 0.0};  // corner of the grid
  double cell_ = 1.0;    // side of its square cells
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> near_;  // per cell, row by row
};

}  // namespace kinemesh
