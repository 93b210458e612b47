// Which vertices a quality pass may move besides what the mesh itself says.
#pragma once

#include <unordered_map>
#include <vector>

#include "kinemesh/detail/polyline.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// By the mesh's numbers. Without it, vertices on no constrained edge that are not fixed move freely, and all
// others stay (is_movable in core/mesh/around.h).
struct VertexFreedom {
  std::vector<char>
      held;  // per vertex: stays although it could move, inside a solid body say; empty: none does

  // Vertices of sliding borders may move along these, either way, though they are on constrained edges. They
  // stay strictly between the two ends of these edges; a vertex that is on another number of them than two,
  // or fixed, does not move.
  // On straight lines: the unit vectors along them.
  std::unordered_map<int, Point> tangents = {};
  // On curved ones: the numbers of the curves. On the convex hull of the mesh they stay.
  std::unordered_map<int, int> curve_of = {};
  std::vector<Polyline> curves = {};
};

}  // namespace kinemesh
#pragma GCC visibility pop
