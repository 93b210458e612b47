// Which vertices follow something: the unknowns of the interior's equations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

enum class Role : std::uint8_t;

// Vertices that are not Known fall into parts: two of a face of the domain belong to the same. A part moves
// if a Known vertex of one of its faces does.
class MovingParts {
 public:
  // O(n) but for a slowly growing factor.
  void find(const Mesh& mesh, std::span<const Role> roles, std::span<const Point> increments);

  const std::vector<char>& moves() const { return moves_; }  // per vertex; not Known ones
  bool any_moves() const { return any_moves_; }

 private:
  Vertex part_of(Vertex vertex);
  Vertex unite(Vertex a, Vertex b);

  std::vector<Vertex> parent_;  // per vertex, not above it
  std::vector<char> moves_;     // of parts by their lowest vertex first, then of all
  bool any_moves_ = false;
};

}  // namespace kinemesh
