// R*, the re-meshable set of a locally removable region R, as the construction of Lemma 3.3 reads it.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// A face of R* that lies over the shadow of an inverted face of J, in R.
struct Cell {
  Face face;
  Face inverted;
};

// Its vertices have numbers of their own, from 0, in the mesh's order. Refers to the mesh and the sets.
class RemeshableSet {
 public:
  // The faces of one of the sets. Pre: `cells` are those of R over the inverted faces of J.
  RemeshableSet(const Mesh& mesh, const FaceSets& sets, int set, std::span<const Cell> cells);

  const Mesh& mesh() const { return mesh_; }
  const std::vector<Face>& faces() const { return sets_.faces(set_); }
  bool has(Face face) const { return face != none && sets_.set_of(face) == set_; }  // face may be none

  // The face across is in the set, too. Pre: mesh_side is one of a face of the set.
  bool is_inner(Side mesh_side) const { return has(mesh_.face_across(mesh_side)); }

  int n_vertices() const { return static_cast<int>(vertices_.size()); }
  Vertex vertex(int number) const { return vertices_[number]; }
  int number(Vertex vertex) const;    // pre: of a face of the set
  Triangle corners(Face face) const;  // by number

  // The inverted faces of J, ascending, and the faces of R* over each, itself among them, ascending.
  const std::map<Face, std::vector<Face>>& over() const { return over_; }
  bool is_inverted(Face face) const { return over_.contains(face); }  // of J; face may be none

 private:
  void number_vertices();

  const Mesh& mesh_;
  const FaceSets& sets_;
  int set_;
  std::vector<Vertex> vertices_;  // of the mesh, ascending
  std::map<Face, std::vector<Face>> over_;
};

}  // namespace kinemesh
