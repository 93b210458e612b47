// The faces of the domain around vertices, as flat arrays: the rows of a matrix over the mesh.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

// What row(vertex) has, counter-clockwise: neighbours in faces of the domain, and the face from each to the
// next one, cyclically, or none where there is a gap: padding, or the outside.
class Fans {
 public:
  void reserve(const Mesh& mesh);

  // Of the vertices with has_row; those of others are empty. In all threads.
  void build(const Mesh& mesh, const std::vector<char>& has_row);

  int n_vertices() const { return static_cast<int>(start_.size()) - 1; }
  int n_slots() const { return start_.back(); }
  int begin(int vertex) const { return start_[vertex]; }
  int end(int vertex) const { return start_[vertex + 1]; }
  bool has_row(int vertex) const { return begin(vertex) != end(vertex); }
  int neighbour(int slot) const { return neighbours_[slot]; }
  int face(int slot) const { return faces_[slot]; }  // neighbour(slot), the next one and the vertex; or none

 private:
  std::vector<int> start_;               // per vertex, and one more
  std::vector<int> neighbours_, faces_;  // per slot
};

}  // namespace kinemesh
