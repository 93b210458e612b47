// A small triangulated surface that is glued together and edited, with vertices in exact coordinates.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_2;

// Side 3f + k runs from corner k of face f to the next. For .cpp files only: CGAL.
struct Surface {
  std::vector<ExactPoint> points;  // by vertex
  std::vector<int> corners;        // by side: the vertex where it starts
  std::vector<int> mates;  // by side: the side it is glued to, or ~s, s a side of the mesh, on the border
  std::vector<int> constraints;  // by side: number of a constraint, or none
  std::vector<bool> alive;       // by face

  int n_faces() const { return static_cast<int>(alive.size()); }
  int add_face(int a, int b, int c);  // returns its first side; nothing is glued yet
  void glue(int side, int mate);      // mate may be ~s

  static int next(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static int prev(int side) { return side % 3 == 0 ? side + 2 : side - 1; }

  // Replaces the star of an inner vertex by upright faces without it. `side` starts there. Two constrained
  // edges through the vertex become one. False if its link has no triangulation with strictly upright faces.
  bool remove_vertex(int side);
};

}  // namespace kinemesh
