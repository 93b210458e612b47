// New upright faces for a set of faces with an embedded border.
#pragma once

#include <optional>
#include <vector>

#include "core/defect.h"
#include "core/mesh.h"
#include "core/triangulator.h"
#include "untangle/face_sets.h"
#include "untangle/strategy.h"

namespace kinemesh {

// Border edges, vertices and constrained edges of the region go into one constrained Delaunay triangulation;
// winding numbers, flooded from outside, tell which of its triangles lie in the region. Nothing is assumed of
// the border, which may have holes and pinches: any winding number but 0 and 1, or another number of
// triangles than were removed, means that it is not simple. Labels flood from the border over the new faces,
// changing at constrained edges only.
class RegionMesher {
 public:
  enum class Result {
    Done,       // patch() holds the new faces, each upright (certified)
    NotSimple,  // the border touches itself or something else; a larger region may do
    NoMesh      // defect() says why no region helps
  };

  // Pre: sets.faces(set) ascending. Deterministic. Keeps scratch memory for the next region.
  [[nodiscard]] Result run(const Mesh& mesh, const RepairOptions& options, const FaceSets& sets, int set);

  Patch& patch() { return patch_; }
  const Defect& defect() const { return defect_; }
  int escaped() const { return escaped_; }  // vertices, of the last region
  int border_edges() const { return static_cast<int>(border_halfedges_.size()); }  // of the last region
  Point centre() const;                                                    // of the last region's vertices
  double triangulator_ms() const { return triangulator_.milliseconds(); }  // over all regions

 private:
  struct NewFace {
    Triangle corners;  // of the mesh, the smallest first
    int triangle;      // of the triangulation
    int shift;         // corner 0 is that corner of the triangle
    int label;
  };

  void collect(const FaceSets& sets, int set);
  void add_vertices(const FaceSets& sets, int set);
  void add_edge(int halfedge);
  std::optional<Defect> verdict(const Contact& contact) const;
  bool select_inside(int n_expected);
  bool find_lost_vertex();
  bool flood_labels();
  bool spread_label(int triangle, int side);
  bool set_label(int triangle, int label, int source);
  bool count_escaped();
  void order_new_faces();
  void assign_slots(const std::vector<int>& faces);
  void connect();
  void certify() const;

  bool is_constrained(int edge) const;
  int user(int local) const { return mesh_->user_vertex(vertices_[local]); }
  Edge user_edge(int edge) const { return {user(edges_[edge][0]), user(edges_[edge][1])}; }
  Result fail(Defect defect);

  const Mesh* mesh_ = nullptr;
  RepairOptions options_;
  Triangulator triangulator_;
  Triangulation triangulation_;

  std::vector<int> local_of_;  // per vertex of the mesh, or none
  std::vector<int> vertices_;  // the region's, ascending
  std::vector<Point> points_;  // theirs
  std::vector<Edge>
      edges_;  // local: first the border, the region to the left, then the constrained inner ones
  std::vector<int> border_halfedges_;   // edge i of the border
  std::vector<int> inner_constraints_;  // constraint of the edges behind the border

  std::vector<int> inside_;    // triangles of the region
  std::vector<int> new_face_;  // per triangle: number of its new face, or none
  std::vector<int> label_;     // per triangle
  std::vector<int> source_;    // per triangle: the edge its label came from, or none while it has none
  std::vector<int> pending_;
  std::vector<NewFace> new_faces_;
  Patch patch_;
  Defect defect_;
  int escaped_ = 0;
};

}  // namespace kinemesh
