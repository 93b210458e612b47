// The kinetic mesh: positions, and a corner table.
//
// A side is one face's share of an edge: side 4 f + k runs along face f from its corner k to the next one.
// The table holds three corners per face and, per side, the side of another face on the same edge. Two sides
// may have the same ends and be of different edges.
//
// The domain the user gave is embedded in padding: faces that fill its holes and the space up to its convex
// hull or to a rectangular frame, so that the whole is a disc with convex border [Agarwal 2008, §1, boundary
// assumption]. Vertices and faces are renumbered along a Hilbert curve; user_vertex, user_face and their
// inverses translate. Build one with build_mesh (kinemesh/build.h).
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/detail/side_numbers.h"
#include "kinemesh/mesh_data.h"
#include "kinemesh/types.h"

// Details.
namespace kinemesh {
struct Patch;       // core/mesh/patch.h
class MeshBuilder;  // core/mesh/build.cpp
class MeshParts;    // core/mesh/mesh_state.cpp
}  // namespace kinemesh

#pragma GCC visibility push(default)
namespace kinemesh {

// An edge that has to exist again after every repair: border, interface between two labels, marker.
struct Constraint {
  Vertex from, to;
  // Labels of the faces on either side of from -> to; padding_label outside the domain.
  int left = 0, right = 0;
  int marker = none;  // number in marker_names(), the first that holds this edge

  bool is_border() const { return (left == padding_label) != (right == padding_label); }
};

// A face of a mesh as it was: Mesh::save.
struct FaceState {
  Face face;
  int label = 0;
  MeshTriangle corners{};
  Triangle across{}, constraints{};
};

class Mesh {
 public:
  // Sizes, padding included, and all vertices, all faces.
  int n_vertices() const { return static_cast<int>(positions_.size()); }
  int n_faces() const { return static_cast<int>(triangles_.size()); }
  Numbers<Vertex> vertices() const { return Numbers<Vertex>(n_vertices()); }
  Numbers<Face> faces() const { return Numbers<Face>(n_faces()); }
  int n_edges() const { return (3 * n_faces() + static_cast<int>(hull_.size())) / 2; }

  // Sizes of what the user gave; faces of the domain become more or fewer only when vertices escape.
  int n_user_vertices() const { return n_user_vertices_; }
  int n_user_faces() const { return n_user_faces_; }

  // Geometry. Moving vertices is the caller's business; connectivity does not follow by itself.
  std::span<const Point> positions() const { return positions_; }
  std::span<Point> positions() { return positions_; }
  const Point& position(Vertex vertex) const { return positions_[vertex]; }
  void swap_positions(std::vector<Point>& positions) noexcept { positions_.swap(positions); }

  // Faces.
  std::span<const MeshTriangle> triangles() const { return triangles_; }
  std::array<Point, 3> corners(Face face) const {
    const auto& t = triangles_[face];
    return {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  }
  int label(Face face) const { return labels_[face]; }
  bool is_padding(Face face) const { return labels_[face] == padding_label; }

  // Sides. The face of none is none.
  static constexpr Side side(Face face, int k) { return Side(face << 2 | k); }
  static constexpr Face face_of(Side side) { return Face(side >> 2); }
  static constexpr int corner_of(Side side) { return side & 3; }
  static constexpr Side next(Side side) { return Side((side & 3) == 2 ? side - 2 : side + 1); }
  static constexpr Side prev(Side side) { return Side((side & 3) == 0 ? side + 2 : side - 1); }
  static constexpr Sides sides(Face face) { return {side(face, 0), side(face, 1), side(face, 2)}; }
  Side opposite(Side side) const {  // none on the hull
    return Side(across_[face_of(side)][corner_of(side)] >> 1);
  }
  Face face_across(Side side) const { return face_of(opposite(side)); }
  Vertex from(Side side) const { return triangles_[face_of(side)][corner_of(side)]; }
  Vertex to(Side side) const { return from(next(side)); }
  Vertex apex(Side side) const { return from(prev(side)); }  // the corner that is not on it
  Side side_from(Vertex vertex) const {
    return side_from_[vertex];
  }  // one that starts there; none if isolated
  bool is_isolated(Vertex vertex) const { return side_from_[vertex] == none; }
  // Of the two sides of an edge the one with the smaller number.
  Side lower(Side side) const {
    const Side across = opposite(side);
    return across != none && across < side ? across : side;
  }
  bool is_lower(Side side) const { return lower(side) == side; }
  // Asks for what the functions above read of a face, ahead of time.
  void fetch(Face face) const {
    __builtin_prefetch(&triangles_[face]);
    __builtin_prefetch(&across_[face]);
  }

  // Constrained edges. constraint_of(side) is a number in constraints(), or none.
  std::span<const Constraint> constraints() const { return constraints_; }
  bool has_constraint(Side side) const { return (across_[face_of(side)][corner_of(side)] & 1) != 0; }
  int constraint_of(Side side) const {
    return has_constraint(side) ? constraint_at_.find(lower(side)) : none;
  }
  bool is_constrained(Vertex vertex) const { return on_constraint_[vertex]; }  // an end of a constrained edge
  // Around a vertex on no constrained edge, when built; 0 for others.
  int home_label(Vertex vertex) const { return home_label_[vertex]; }
  const std::vector<Marker>& markers() const { return markers_; }  // in the user's numbering
  const std::vector<std::string>& marker_names() const { return marker_names_; }

  bool is_fixed(Vertex vertex) const { return fixed_[vertex]; }  // never moved by a motion or by smoothing

  // The convex border of the padded mesh: its vertices, counter-clockwise; collinear ones included.
  std::span<const Vertex> hull() const { return hull_; }
  // Frame: its 4 corners, counter-clockwise from lower left, or nothing.
  std::span<const Vertex> frame() const { return frame_; }
  double frame_margin() const { return frame_margin_; }  // in bounding-box diagonals of the domain

  // The user's numbering. Padding has none: user_vertex(frame corner) and user_face(padding face) are none.
  UserVertex user_vertex(Vertex vertex) const { return user_vertex_[vertex]; }
  Vertex vertex_of_user(UserVertex user) const { return vertex_of_user_[user]; }
  UserFace user_face(Face face) const { return is_padding(face) ? none : user_face_[face]; }
  std::vector<Face> faces_in_user_order() const;  // the domain's faces, ascending by user_face
  std::vector<Point> user_positions() const { return in_user_order(positions_); }
  std::vector<Point> in_user_order(std::span<const Point> positions) const;  // given in the mesh's order
  MeshData domain() const;  // everything the user gave, as it is now

  // An unconstrained edge inside the padded mesh: both its faces have the same label.
  bool is_flippable(Side side) const { return !has_constraint(side) && opposite(side) != none; }

  // Turns an edge between two faces into their other diagonal, within the same two faces. Of side a -> b of
  // the lower face that one becomes dbc; both start at their lowest corner. Nothing else changes. Pre:
  // is_flippable(side), c != d. Returns the lower side of the new edge.
  //      c             c
  //    /   \         / | \       .
  //   a --> b  ->   a  |  b
  //    \   /         \ | /
  //      d             d
  Side flip(Side side) noexcept;

  // Rewrites patch.faces in place; nothing else changes. Uses the patch up. Pre: the patch covers the same
  // vertices and has the same border as its faces. Cost: O(patch). Takes no memory.
  void splice(Patch& patch) noexcept;

  // A face as it is, and back again: all that have changed since they were saved, at once; of a face that was
  // saved more than once the first is what counts. Bit for bit, but for which side side_from names. Takes no
  // memory.
  FaceState save(Face face) const;
  void restore(std::span<const FaceState> saved) noexcept;
  void restore(std::span<const FaceState> saved,
               std::span<const Face> faces) noexcept;  // saved[f] for these f

 private:
  friend class MeshBuilder;
  friend class MeshParts;

  int& word(Side side) { return across_[face_of(side)][corner_of(side)]; }
  void connect(std::span<const int> opposite);
  void trace_hull(std::span<const int> opposite);
  void link(Side side, int word) noexcept;
  void write(Face face, int label, const MeshTriangle& corners, const Triangle& words) noexcept;
  void set_corners(Face face, const MeshTriangle& corners) noexcept;
  Side rewrite_from_lowest(Face face, MeshTriangle corners) noexcept;
  template <class At>
  void restore(std::size_t n, const At& at) noexcept;
  void forget_constraint(int number) noexcept;
  void remember_constraint(int number, Side side) noexcept;

  std::vector<Point> positions_;
  std::vector<MeshTriangle> triangles_;
  std::vector<Triangle>
      across_;                   // per side: 2 s for the side s on the same edge, plus 1 if it is constrained
  std::vector<Side> side_from_;  // per vertex
  std::vector<int> labels_;      // per face
  std::vector<UserFace>
      user_face_;  // per face; padding faces have numbers from the number of the user's faces on
  std::vector<UserVertex> user_vertex_;  // per vertex
  std::vector<Vertex> vertex_of_user_;
  std::vector<Constraint> constraints_;
  std::vector<Side> side_of_constraint_;  // the lower one
  SideNumbers constraint_at_;             // and back
  std::vector<bool> on_constraint_;       // per vertex
  std::vector<bool> fixed_;               // per vertex
  std::vector<int> home_label_;           // per vertex
  std::vector<Vertex> hull_;
  std::vector<Vertex> frame_;
  double frame_margin_ = 0.0;
  std::vector<Marker> markers_;
  std::vector<std::string> marker_names_;
  std::map<int, std::string> label_names_;
  int n_user_vertices_ = 0;
  int n_user_faces_ = 0;
};

}  // namespace kinemesh
#pragma GCC visibility pop
