// New upright faces for up to 128 faces: what nearly every region of a step is.
#pragma once

#include <array>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/predicates.h"
#include "untangle/fill/hole.h"
#include "untangle/fill/new_faces.h"

namespace kinemesh {

// The constrained Delaunay triangulation of a simple polygon and the vertices inside it: ears are clipped,
// vertices inserted, edges flipped, all with exact signs and within fixed arrays. Quadratic, cubic at
// worst, but in tests of a few instructions each, so that this takes a fraction of the time a general
// triangulator needs.
class SmallRegionMesher {
 public:
  // False where RegionMesher has to look: more than max_faces faces, a border that is not one loop or touches
  // itself, a constrained edge inside, a vertex on the border or outside. Otherwise new_faces() holds the
  // faces RegionMesher would find, up to the choice among cocircular vertices. Deterministic.
  [[nodiscard]] bool run(const Mesh& mesh, const Hole& hole);

  NewFaces& new_faces() { return new_faces_; }  // of the last region

  static constexpr int max_faces = 128;

 private:
  static constexpr int max_vertices = max_faces + 2;  // of a disc

  // A vertex of the border of what is left to clip.
  struct Tip {
    int vertex;
    int across;  // beyond the side from it to the next tip, as in across_
    Orientation turn;
  };

  bool collect(const Mesh& mesh, const Hole& hole);
  void number_vertices(const Mesh& mesh, const Hole& hole);
  int local(Vertex vertex) const;
  bool trace_border();
  bool is_border_simple() const;
  bool is_counter_clockwise() const;

  void clip_ears();
  bool is_ear(std::size_t i) const;
  void clip(std::size_t i);
  void find_turn(std::size_t i);
  std::size_t before(std::size_t i) const { return (i == 0 ? loop_.size() : i) - 1; }
  std::size_t after(std::size_t i) const { return i + 1 == loop_.size() ? 0 : i + 1; }

  bool insert_inner_vertices();
  bool insert(int vertex);
  int walk_towards(const Point& p) const;
  int side_away_from(const Point& p, int face) const;
  void split_face(int face, int vertex);
  bool split_side(int side, int vertex);
  void flip_to_delaunay();
  void flip_if_better(int side);

  int add(const Triangle& corners, const Triangle& across);
  void set(int face, const Triangle& corners, const Triangle& across);
  void convert();

  int n_faces_ = 0, n_vertices_ = 0;           // of the region
  std::array<Vertex, max_vertices> vertices_;  // of the mesh, ascending
  std::array<Point, max_vertices> points_;     // theirs
  std::array<Side, max_vertices> side_from_;   // of the border, by where it leaves; none inside
  std::array<int, max_vertices> border_next_;  // the vertex it goes to

  std::vector<Tip> loop_;

  // Side 3f + k of the first n_new_ faces runs from corner k of face f to corner k + 1. Vertices are local.
  int n_new_ = 0;
  std::array<int, 3 * max_faces> start_;   // the vertex it runs from
  std::array<int, 3 * max_faces> across_;  // the side that runs back, or ~v where the border leaves v
  std::vector<int> suspects_;              // sides
  NewFaces new_faces_;
};

}  // namespace kinemesh
