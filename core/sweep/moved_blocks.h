// Which vertices a move has moved, to the block: enough to leave alone what lies still.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

// Vertices 64 b to 64 b + 63 are block b; along the mesh's Hilbert curve they lie together.
class MovedBlocks {
 public:
  static int block_of(Vertex vertex) { return vertex / block_vertices; }

  // Where positions differ, in all threads. Pre: as many before as now.
  void find(std::span<const Point> before, std::span<const Point> now);
  void add(Vertex vertex) { is_moved_[block_of(vertex)] = true; }

  bool contains(int block) const { return is_moved_[block]; }
  bool contain_all() const;

 private:
  static constexpr int block_vertices = 64;

  std::vector<char> is_moved_;  // per block; not bool, whose neighbours share a byte
};

}  // namespace kinemesh
