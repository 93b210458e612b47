// The kinetic mesh: connectivity (OpenMesh half-edges) apart from positions, and a flat mirror of the faces.
//
// The domain the user gave is embedded in padding: faces that fill its holes and the space up to its convex
// hull or to a rectangular frame, so that the whole is a disc with convex border [Agarwal 2008, §1, boundary
// assumption]. Vertices and faces are renumbered along a Hilbert curve; user_vertex, user_face and their
// inverses translate. Build one with build_mesh (kinemesh/build.h).
#pragma once

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/mesh_data.h"
#include "kinemesh/types.h"

namespace kinemesh {

// An edge that has to exist again after every repair: border, interface between two labels, marker.
struct Constraint {
  int from = none, to = none;  // vertices of the mesh
  // Labels of the faces on either side of from -> to; padding_label outside the domain.
  int left = 0, right = 0;
  int marker = none;  // number in marker_names(), the first that holds this edge

  bool is_border() const { return (left == padding_label) != (right == padding_label); }
};

// New faces for some of a mesh's, ready to take their place (Mesh::splice). Sides run from corner k to corner
// k + 1.
struct Patch {
  std::vector<int> faces;           // the faces to rewrite
  std::vector<Triangle> triangles;  // as many; triangle i is written to faces[i]
  std::vector<int> labels;          // one per triangle
  std::vector<Triangle> halfedges;  // along side k of triangle i, the triangle to its left
  std::vector<int> edges;           // the edges between two of the faces, ascending
  std::vector<int> constraints;     // what becomes of edges[j]: number of a constraint, or none
  std::vector<Edge> outgoing{};     // vertices and the half-edges where their fans are to start; may be empty
};

class Mesh {
 public:
  using Connectivity = OpenMesh::TriConnectivity;

  // Sizes, padding included.
  int n_vertices() const { return static_cast<int>(positions_.size()); }
  int n_faces() const { return static_cast<int>(triangles_.size()); }
  int n_edges() const { return static_cast<int>(edge_constraint_.size()); }

  // Sizes of what the user gave; faces of the domain become more or fewer only when vertices escape.
  int n_user_vertices() const { return n_user_vertices_; }
  int n_user_faces() const { return n_user_faces_; }

  // Geometry. Moving vertices is the caller's business; connectivity does not follow by itself.
  std::span<const Point> positions() const { return positions_; }
  std::span<Point> positions() { return positions_; }
  const Point& position(int vertex) const { return positions_[vertex]; }
  void swap_positions(std::vector<Point>& positions) noexcept { positions_.swap(positions); }

  // Faces. Corner 0 is where halfedge_of(face) starts.
  std::span<const Triangle> triangles() const { return triangles_; }
  std::array<Point, 3> corners(int face) const {
    const auto& t = triangles_[face];
    return {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  }
  int label(int face) const { return labels_[face]; }
  bool is_padding(int face) const { return labels_[face] == padding_label; }

  // Half-edges: 2e and 2e+1 are the two sides of edge e; the face lies to the left.
  static int opposite(int h) { return h ^ 1; }
  static int edge_of(int h) { return h >> 1; }
  int halfedge_of(int face) const { return topology_.halfedge_handle(OpenMesh::FaceHandle(face)).idx(); }
  int outgoing(int vertex) const {  // or none
    return topology_.halfedge_handle(OpenMesh::VertexHandle(vertex)).idx();
  }
  int next(int h) const { return topology_.next_halfedge_handle(OpenMesh::HalfedgeHandle(h)).idx(); }
  int prev(int h) const { return topology_.prev_halfedge_handle(OpenMesh::HalfedgeHandle(h)).idx(); }
  int face_of(int h) const {  // none outside
    return topology_.face_handle(OpenMesh::HalfedgeHandle(h)).idx();
  }
  int to(int h) const { return topology_.to_vertex_handle(OpenMesh::HalfedgeHandle(h)).idx(); }
  int from(int h) const { return to(opposite(h)); }
  bool is_isolated(int vertex) const { return outgoing(vertex) == none; }
  // The half-edges along the sides of a face, from corner 0 on.
  Triangle sides(int face) const {
    const int h = halfedge_of(face);
    return {h, next(h), prev(h)};
  }
  const Connectivity& connectivity() const { return topology_; }

  // Constrained edges. constraint_of(edge) is a number in constraints(), or none.
  std::span<const Constraint> constraints() const { return constraints_; }
  int constraint_of(int edge) const { return edge_constraint_[edge]; }
  bool is_constrained(int vertex) const { return on_constraint_[vertex]; }  // an end of a constrained edge
  // Around a vertex on no constrained edge, when built.
  int home_label(int vertex) const { return home_label_[vertex]; }
  const std::vector<Marker>& markers() const { return markers_; }  // in the user's numbering
  const std::vector<std::string>& marker_names() const { return marker_names_; }

  bool is_fixed(int vertex) const { return fixed_[vertex]; }  // never moved by a motion or by smoothing

  // The convex border of the padded mesh: its vertices, counter-clockwise; collinear ones included.
  std::span<const int> hull() const { return hull_; }
  // Frame: its 4 corners, counter-clockwise from lower left, or nothing.
  std::span<const int> frame() const { return frame_; }
  double frame_margin() const { return frame_margin_; }  // in bounding-box diagonals of the domain

  // The user's numbering. Padding has none: user_vertex(frame corner) and user_face(padding face) are none.
  int user_vertex(int vertex) const { return user_vertex_[vertex]; }
  int vertex_of_user(int user) const { return vertex_of_user_[user]; }
  int user_face(int face) const { return is_padding(face) ? none : user_face_[face]; }
  std::vector<int> faces_in_user_order() const;  // the domain's faces, ascending by user_face
  std::vector<Point> user_positions() const { return in_user_order(positions_); }
  std::vector<Point> in_user_order(std::span<const Point> positions) const;  // given in the mesh's order
  MeshData domain() const;  // everything the user gave, as it is now

  // Rewrites patch.faces in place, re-using their handles and those of the edges between them; nothing else
  // changes. Pre: the patch covers the same vertices and has the same border as its faces. Cost: O(patch).
  void splice(const Patch& patch) noexcept;

  // The patch that takes this one back, bit for bit: to be asked for before it is spliced.
  Patch inverse_of(const Patch& patch) const;

  // An unconstrained edge inside the padded mesh: both its faces have the same label.
  bool is_flippable(int edge) const {
    return edge_constraint_[edge] == none && face_of(2 * edge) != none && face_of(2 * edge + 1) != none;
  }

  // Turns an edge between two faces into their other diagonal, re-using its handle and theirs. The half-edge along
  // the lower face, here abc, goes from c to d then, with face dbc to its left. Both faces start at their lowest
  // corner. Nothing else changes. Pre: is_flippable(edge), c != d.
  //      c             c
  //    /   \         / | \       .
  //   a --> b  ->   a  |  b
  //    \   /         \ v /
  //      d             d
  void flip(int edge) noexcept;

 private:
  friend class MeshBuilder;

  void rewrite(int face, const Triangle& corners, const Triangle& sides) noexcept;
  void rewrite_from_lowest(int face, Triangle corners, Triangle sides) noexcept;

  Connectivity topology_;
  std::vector<Point> positions_;
  std::vector<Triangle> triangles_;  // mirror of topology_
  std::vector<int> labels_;          // per face
  std::vector<int> user_face_;  // per face; padding faces have numbers from the number of the user's faces on
  std::vector<int> user_vertex_;  // per vertex
  std::vector<int> vertex_of_user_;
  std::vector<Constraint> constraints_;
  std::vector<int> edge_constraint_;  // per edge
  std::vector<bool> on_constraint_;   // per vertex
  std::vector<bool> fixed_;           // per vertex
  std::vector<int> home_label_;       // per vertex
  std::vector<int> hull_;
  std::vector<int> frame_;
  double frame_margin_ = 0.0;
  std::vector<Marker> markers_;
  std::vector<std::string> marker_names_;
  std::map<int, std::string> label_names_;
  int n_user_vertices_ = 0;
  int n_user_faces_ = 0;
};

}  // namespace kinemesh
