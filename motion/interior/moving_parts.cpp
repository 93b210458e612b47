#include "motion/interior/moving_parts.h"

#include <algorithm>
#include <numeric>

#include "motion/interior/interior.h"

namespace kinemesh {

void MovingParts::find(const Mesh& mesh, std::span<const Role> roles, std::span<const Point> increments) {
  parent_.resize(mesh.n_vertices());
  std::iota(parent_.begin(), parent_.end(), Vertex(0));
  moves_.assign(mesh.n_vertices(), false);
  for (const Face f : mesh.faces()) {
    if (mesh.is_padding(f)) continue;
    Vertex member;
    bool is_pulled = false;
    for (const Vertex v : mesh.triangles()[f]) {
      if (roles[v] == Role::Known)
        is_pulled |= increments[v] != Point(0.0, 0.0);
      else
        member = member == none ? part_of(v) : unite(member, v);
    }
    if (member != none && is_pulled) moves_[member] = true;
  }
  any_moves_ = false;
  for (const Vertex v : mesh.vertices()) {
    moves_[v] = moves_[part_of(v)];
    any_moves_ |= moves_[v] != 0;
  }
}

Vertex MovingParts::part_of(Vertex vertex) {
  while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
  return vertex;
}

// The lower root stays one; returns it.
Vertex MovingParts::unite(Vertex a, Vertex b) {
  a = part_of(a);
  b = part_of(b);
  const auto [low, high] = std::minmax(a, b);
  parent_[high] = low;
  moves_[low] |= moves_[high];
  return low;
}

}  // namespace kinemesh
