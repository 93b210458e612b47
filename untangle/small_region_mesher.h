// New upright faces for a handful of faces: what nearly every region of a step is.
#pragma once

#include <array>
#include <vector>

#include "core/mesh.h"
#include "untangle/hole.h"
#include "untangle/new_faces.h"

namespace kinemesh {

// The constrained Delaunay triangulation of a simple polygon and the vertices inside it: ears are clipped,
// vertices inserted, edges flipped, all with exact signs and within fixed arrays. Quadratic, but over so few
// edges that this takes a fraction of the time a general triangulator needs.
class SmallRegionMesher {
 public:
  // False where RegionMesher has to look: more than max_faces faces, a border that is not one loop or touches
  // itself, a constrained edge inside, a vertex on the border or outside. Otherwise new_faces() holds the
  // faces RegionMesher would find, up to the choice among cocircular vertices. Deterministic.
  [[nodiscard]] bool run(const Mesh& mesh, const Hole& hole);

  NewFaces& new_faces() { return new_faces_; }  // of the last region

  static constexpr int max_faces = 30;

 private:
  static constexpr int max_vertices = max_faces + 2;  // of a disc

  // Numbers of vertices and triangles are local. Across side k, from corner k to corner k + 1: a triangle, or
  // ~v where the border leaves v.
  struct Face {
    std::array<int, 3> corners;
    std::array<int, 3> neighbours;
  };

  bool collect(const Mesh& mesh, const Hole& hole);
  void number_vertices(const Mesh& mesh, const Hole& hole);
  int local(int vertex) const;
  bool trace_border();
  bool is_border_simple() const;
  bool is_counter_clockwise() const;

  void clip_ears();
  bool is_ear(int before, int tip, int after) const;
  void clip(std::size_t i);
  bool insert_inner_vertices();
  bool insert(int vertex);
  void split_face(int face, int vertex);
  bool split_side(int face, int side, int vertex);
  void flip_to_delaunay();
  void flip_if_better(int face, int side);

  int add(const std::array<int, 3>& corners, const std::array<int, 3>& neighbours);
  void relink(int neighbour, int from, int to);
  int side_towards(int face, int neighbour) const;
  void convert();

  int n_faces_ = 0, n_vertices_ = 0;             // of the region
  std::array<int, max_vertices> vertices_;       // of the mesh, ascending
  std::array<Point, max_vertices> points_;       // theirs
  std::array<int, max_vertices> halfedge_from_;  // of the border, by where it leaves; none inside
  std::array<int, max_vertices> border_next_;    // the vertex it goes to

  // What is left to clip: vertex i and what lies across the side from it to the next.
  std::vector<int> loop_, across_;
  std::vector<Face> faces_;
  std::vector<std::array<int, 2>> suspects_;  // face and side
  NewFaces new_faces_;
};

}  // namespace kinemesh
