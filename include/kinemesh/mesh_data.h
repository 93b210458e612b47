// A triangulation as plain arrays in the user's numbering: what a file holds, what a solver hands over, and
// what comes back. No invariant but the index ranges; kinemesh/mesh.h is the structure that is kept
// consistent.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Named edges: a piece of the border, or an interior line that must stay in the mesh.
struct Marker {
  std::string name;
  std::vector<Edge> edges;
};

// Of vertices, and of faces with their padding: a word of the mesh holds twice a side's number 4 f + k, and
// one more.
inline constexpr int most_items = (1 << 28) - 1;

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

// Throws InputError where n is more than most_items. `what` there are, in plural: "faces".
void check_size(std::size_t n, const std::string& what);

}  // namespace kinemesh
#pragma GCC visibility pop
