// The mesh cut up by its own shadow: every face over every cell of the subdivision, and how they hang
// together.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "tests/untangle/explore/subdivision.h"

namespace kinemesh::test {

// A lift is the part of one face that lies over one cell: the atom of every set of [Agarwal 2008, §2]. In
// general position the preimage of a union of cells is a union of lifts, and a path may pass from one to the
// next across a segment, never at a vertex.
class Sheets {
 public:
  struct Lift {
    Face face;
    int cell;
  };
  // The neighbour across one segment of the lift's border: in the same face, or across an edge of the mesh,
  // where a crease folds back over the same cell.
  struct Step {
    int lift;     // none beyond the mesh
    int segment;  // of the subdivision
    Side edge;    // of the mesh, the lower side; or none
  };

  // Pre: plane == subdivide(mesh), is_general(mesh, plane).
  Sheets(const Mesh& mesh, Subdivision plane);

  const Mesh& mesh() const { return mesh_; }
  const Subdivision& plane() const { return plane_; }
  int n_cells() const { return plane_.n_cells; }
  int n_lifts() const { return static_cast<int>(lifts_.size()); }
  const Lift& lift(int i) const { return lifts_[i]; }
  std::span<const int> lifts_of_face(Face face) const { return of_face_[face]; }
  std::span<const int> lifts_of_cell(int cell) const { return of_cell_[cell]; }
  std::span<const Step> steps(int lift) const { return steps_[lift]; }

  bool is_inverted(Face face) const { return inverted_[face]; }
  int sign(int lift) const { return inverted_[lifts_[lift].face] ? -1 : 1; }
  bool is_crease(Side edge) const;

  // Classes of inverted faces under "shares an edge with"; of an upright face: none.
  int component(Face face) const { return component_[face]; }
  int n_components() const { return n_components_; }

 private:
  void find_components();
  void cover(Face face);
  std::vector<int> first_cells(Face face) const;
  int inner_cell(const Subdivision::Segment& segment, Side side) const;
  int lift_at(Face face, int cell) const;
  Step step(const Lift& from, int segment) const;

  const Mesh& mesh_;
  Subdivision plane_;
  std::vector<bool> inverted_;
  std::vector<int> component_;
  int n_components_ = 0;
  std::vector<std::vector<int>> segments_of_edge_, segments_of_cell_;
  std::vector<Lift> lifts_;
  std::vector<std::vector<int>> of_face_, of_cell_;  // ascending by cell and by face
  std::vector<std::vector<Step>> steps_;
  std::vector<Face> seen_;  // per cell: the last face that covers it, while covers are built
};

// No flat face, no segment under two edges, no vertex at another's place or on an edge, never three edges
// through one point that is not a vertex.
bool is_general(const Mesh& mesh, const Subdivision& plane);

}  // namespace kinemesh::test
