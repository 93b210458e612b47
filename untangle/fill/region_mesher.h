// New upright faces for a set of faces with an embedded border.
#pragma once

#include <optional>
#include <vector>

#include "core/cdt/triangulator.h"
#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"
#include "untangle/fill/hole.h"
#include "untangle/fill/new_faces.h"
#include "untangle/fill/small_region_mesher.h"

namespace kinemesh {

// Border edges, vertices and constrained edges of the region go into one constrained Delaunay triangulation;
// winding numbers, flooded from outside, tell which of its triangles lie in the region. Nothing is assumed of
// the border, which may have holes and pinches: any winding number but 0 and 1, or another number of
// triangles than were removed, means that it is not simple.
class RegionMesher {
 public:
  enum class Result {
    Done,       // new_faces() holds the new faces
    NotSimple,  // the border touches itself or something else; a larger region may do
    NoMesh      // defect() says why no region helps
  };

  // Reads nothing outside the hole, which stays as it is until the next. Deterministic. Keeps scratch memory.
  [[nodiscard]] Result run(const Mesh& mesh, const Hole& hole);

  // The same without the short cut for small regions.
  [[nodiscard]] Result run_generally(const Mesh& mesh, const Hole& hole);

  // Of the last region.
  NewFaces& new_faces() { return new_faces_; }
  const Defect& defect() const { return defect_; }

  double triangulator_ms() const { return triangulator_.milliseconds(); }  // over all regions

 private:
  void collect();
  void add_vertices();
  std::optional<Defect> verdict(const Contact& contact) const;
  bool select_inside();
  Defect left_domain(int local) const;
  bool find_lost_vertex();
  bool find_taken_edge();
  void convert();

  int border_edges() const { return static_cast<int>(hole_->border.size()); }
  bool is_constrained(int edge) const;
  UserVertex user(int local) const { return mesh_->user_vertex(vertices_[local]); }
  UserEdge user_edge(int edge) const { return {user(edges_[edge][0]), user(edges_[edge][1])}; }

  SmallRegionMesher small_;
  const Mesh* mesh_ = nullptr;
  const Hole* hole_ = nullptr;
  Triangulator triangulator_;
  Triangulation triangulation_;

  std::vector<int> local_of_;     // per vertex of the mesh, or none
  std::vector<Vertex> vertices_;  // the region's, ascending
  std::vector<Point> points_;     // theirs
  std::vector<Edge> edges_;       // local: the border, the region to its left; then constrained inner ones

  std::vector<int> inside_;  // triangles of the region
  std::vector<int> number_;  // per triangle: among those inside
  NewFaces new_faces_;
  Defect defect_;
};

}  // namespace kinemesh
