// What `kinemesh check` finds out about a mesh: counts, extremes, and what keeps it from being valid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

struct MarkerCount {
  std::string name;
  int edges = 0;
};

// All numbers are the file's. Parts and components are connected across edges; a vertex alone joins nothing.
struct CheckReport {
  int vertices = 0;
  int isolated_vertices = 0;  // in no face
  int faces = 0;
  int inverted = 0;             // faces of negative area
  int degenerate = 0;           // faces of no area
  int inverted_components = 0;  // classes of inverted faces
  int connected_parts = 0;
  int border_loops = 0;
  std::vector<MarkerCount> markers;
  double min_angle_deg = 0.0;  // smallest angle of any face, whichever way it is wound; 0 for flat ones
  double min_area = 0.0;       // smallest signed area, in the square of the file's unit; rounded
  bool valid = false;  // the faces triangulate a part of the plane, and every marker's edge is one of theirs
  std::vector<Defect> culprits;  // the first of each kind, at most `culprits_per_kind` of a kind
};

inline constexpr int culprits_per_kind = 5;

// Exact but for the two extremes. Pre: consistent winding, as read_mesh leaves it. O(n log n). Throws
// InputError for no faces at all.
CheckReport check_mesh(const MeshData& data);

// Only the counts of faces that point the wrong way: what a repair report gives before and after.
struct FaceCount {
  int inverted = 0;
  int degenerate = 0;
};
FaceCount count_bad_faces(const MeshData& data);

}  // namespace kinemesh
#pragma GCC visibility pop
