// Which vertices a quality pass may move besides what the mesh itself says.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/types.h"

namespace kinemesh {

// By the mesh's numbers. Without it, vertices on no constrained edge that are not fixed move freely, and all
// others stay (is_movable in untangle/quality/around.h).
struct VertexFreedom {
  std::vector<char>
      held;  // per vertex: stays although it could move, inside a solid body say; empty: none does

  // Vertices of sliding borders, and the unit vectors along which they may move, either way, though they are
  // on constrained edges. They stay strictly between the two ends of these edges; a vertex that is on another
  // number of them than two, or fixed, does not move.
  std::unordered_map<int, Point> tangents = {};
};

}  // namespace kinemesh
