#include "kinemesh/mesh.h"

#include <algorithm>

namespace kinemesh {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

std::vector<int> Mesh::faces_in_user_order() const {
  // Numbers of padding faces lie behind the user's unless faces have changed sides; bucket, then close the
  // gaps.
  std::vector<int> by_number(triangles_.size(), none);
  for (int f = 0; f < n_faces(); ++f) {
    if (!is_padding(f)) by_number[user_face_[f]] = f;
  }
  std::erase(by_number, none);
  return by_number;
}

std::vector<Point> Mesh::in_user_order(std::span<const Point> positions) const {
  std::vector<Point> points(n_user_vertices_);
  for (int u = 0; u < n_user_vertices_; ++u) points[u] = positions[vertex_of_user_[u]];
  return points;
}

MeshData Mesh::domain() const {
  MeshData data;
  data.points = user_positions();
  data.markers = markers_;
  data.label_names = label_names_;
  const auto faces = faces_in_user_order();
  data.triangles.reserve(faces.size());
  for (const int f : faces) {
    const auto& t = triangles_[f];
    data.triangles.push_back({user_vertex_[t[0]], user_vertex_[t[1]], user_vertex_[t[2]]});
  }
  if (std::any_of(faces.begin(), faces.end(), [&](int f) { return labels_[f] != 0; })) {
    for (const int f : faces) data.labels.push_back(labels_[f]);
  }
  return data;
}

void Mesh::splice(const Patch& patch) noexcept {
  for (std::size_t j = 0; j < patch.edges.size(); ++j)
    edge_constraint_[patch.edges[j]] = patch.constraints[j];
  for (std::size_t i = 0; i < patch.faces.size(); ++i) {
    const int face = patch.faces[i];
    n_user_faces_ += (patch.labels[i] != padding_label) - !is_padding(face);
    labels_[face] = patch.labels[i];
    rewrite(face, patch.triangles[i], patch.halfedges[i]);
  }
  for (const auto& [vertex, halfedge] : patch.outgoing)
    topology_.set_halfedge_handle(VertexHandle(vertex), HalfedgeHandle(halfedge));
}

void Mesh::flip(int edge) noexcept {
  const bool is_lower = face_of(2 * edge) < face_of(2 * edge + 1);
  const int h = is_lower ? 2 * edge : 2 * edge + 1, o = opposite(h), left = face_of(h), right = face_of(o);
  const int bc = next(h), ca = prev(h), ad = next(o), db = prev(o);
  const int a = to(ca), b = to(db), c = to(bc), d = to(ad);
  rewrite_from_lowest(left, {d, b, c}, {db, bc, h});
  rewrite_from_lowest(right, {c, a, d}, {ca, ad, o});
}

void Mesh::rewrite_from_lowest(int face, Triangle corners, Triangle sides) noexcept {
  const auto lowest = std::min_element(corners.begin(), corners.end()) - corners.begin();
  std::rotate(corners.begin(), corners.begin() + lowest, corners.end());
  std::rotate(sides.begin(), sides.begin() + lowest, sides.end());
  rewrite(face, corners, sides);
}

void Mesh::rewrite(int face, const Triangle& corners, const Triangle& sides) noexcept {
  triangles_[face] = corners;
  topology_.set_halfedge_handle(FaceHandle(face), HalfedgeHandle(sides[0]));
  for (int k = 0; k < 3; ++k) {
    const HalfedgeHandle side(sides[k]);
    topology_.set_face_handle(side, FaceHandle(face));
    topology_.set_vertex_handle(side, VertexHandle(corners[(k + 1) % 3]));
    topology_.set_next_halfedge_handle(side, HalfedgeHandle(sides[(k + 1) % 3]));
    // A vertex of the mesh's border keeps pointing along it, as OpenMesh expects.
    const VertexHandle corner(corners[k]);
    if (face_of(outgoing(corner.idx())) != none) topology_.set_halfedge_handle(corner, side);
  }
}

Patch Mesh::inverse_of(const Patch& patch) const {
  Patch inverse{.faces = patch.faces,
                .triangles = {},
                .labels = {},
                .halfedges = {},
                .edges = patch.edges,
                .constraints = {}};
  for (const int face : patch.faces) {
    inverse.triangles.push_back(triangles_[face]);
    inverse.labels.push_back(labels_[face]);
    inverse.halfedges.push_back(sides(face));
    for (const int v : triangles_[face]) inverse.outgoing.push_back({v, outgoing(v)});
  }
  for (const int edge : patch.edges) inverse.constraints.push_back(edge_constraint_[edge]);
  return inverse;
}

}  // namespace kinemesh
