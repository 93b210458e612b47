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
  Numbers<Vertex> vertices() const { return Numbers<Vertex>(n_vertices()); }
  int n_slots() const { return start_.back(); }
  int begin(Vertex vertex) const { return start_[vertex]; }
  int end(Vertex vertex) const { return start_[vertex + 1]; }
  bool has_row(Vertex vertex) const { return begin(vertex) != end(vertex); }
  Vertex neighbour(int slot) const { return neighbours_[slot]; }
  Face face(int slot) const { return faces_[slot]; }  // neighbour(slot), the next one and the vertex; or none

 private:
  std::vector<int> start_;          // per vertex, and one more
  std::vector<Vertex> neighbours_;  // per slot
  std::vector<Face> faces_;         // likewise
};

}  // namespace kinemesh
