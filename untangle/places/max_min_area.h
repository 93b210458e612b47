// Where a vertex has to be for the smallest area around it to be as large as it can.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinemesh/types.h"
#include "untangle/places/optimal_point.h"

namespace kinemesh {

// The signed area of each triangle (x, p, q) is linear in x, so that the largest t that all areas reach is
// the optimum of a linear programme in x, y and t [Freitag & Plassmann 2000]. x is sought in the bounding box
// of the link, where every vertex of a valid mesh is. Solved in expected linear time [Seidel 1991]:
// constraints come in a shuffled order, always the same, and one that the optimum so far violates holds with
// equality at the next, which leaves a programme with one unknown less.
class MaxMinArea {
 public:
  // Rounded; nothing for a link without extent.
  std::optional<Point> operator()(std::span<const LinkEdge> link);

 private:
  // g . x + c
  struct Linear {
    Point g;
    double c;
  };

  Point best_corner(const Point& direction) const;
  Point best_on_face(const Linear& f, std::size_t n);
  Point best_on_line(const Linear& line, const Point& direction, std::size_t n) const;

  std::vector<Linear> areas_;  // of the triangles: f_i(x) >= t
  std::vector<Linear> sides_;  // of the programme with one unknown less: >= 0
  Point half_{0.0, 0.0};       // extent of the box, which is centred
};

}  // namespace kinemesh
