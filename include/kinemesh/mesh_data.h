// A triangulation as plain arrays in the user's numbering: what a file holds, what a solver hands over, and what comes
// back. No invariant but the index ranges; kinemesh/mesh.h is the structure that is kept consistent.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

// Named edges: a piece of the border, or an interior line that must stay in the mesh.
struct Marker {
  std::string name;
  std::vector<Edge> edges;
};

struct MeshData {
  std::vector<Point> points;               // a vertex in no triangle keeps its number
  std::vector<Triangle> triangles;         // vertex numbers from 0
  std::vector<int> labels;                 // one per triangle; empty: all 0
  std::vector<Marker> markers;             // in the file's order
  std::map<int, std::string> label_names;  // where the format names them (Gmsh physical surfaces)

  int n_vertices() const { return static_cast<int>(points.size()); }
  int n_faces() const { return static_cast<int>(triangles.size()); }
  int label(int face) const { return labels.empty() ? 0 : labels[face]; }
};

}  // namespace kinemesh
