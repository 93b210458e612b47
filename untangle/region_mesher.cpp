#include "untangle/region_mesher.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "core/frame.h"
#include "core/predicates.h"
#include "core/winding.h"

namespace kinemesh {

RegionMesher::Result RegionMesher::run(const Mesh& mesh, const RepairOptions& options, const FaceSets& sets,
                                       int set) {
  mesh_ = &mesh;
  options_ = options;
  collect(sets, set);
  if (const auto contact = triangulator_.triangulate(points_, edges_, triangulation_)) {
    auto defect = verdict(*contact);
    return defect ? fail(std::move(*defect)) : Result::NotSimple;
  }
  if (!select_inside(static_cast<int>(sets.faces(set).size()))) {
    return find_lost_vertex() ? Result::NoMesh : Result::NotSimple;
  }
  if (!flood_labels() || !count_escaped()) return Result::NoMesh;
  order_new_faces();
  assign_slots(sets.faces(set));
  connect();
  certify();
  return Result::Done;
}

RegionMesher::Result RegionMesher::fail(Defect defect) {
  defect_ = std::move(defect);
  return Result::NoMesh;
}

Point RegionMesher::centre() const {
  Point low = points_.front(), high = low;
  for (const auto& p : points_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return low + 0.5 * (high - low);
}

// --- what goes into the triangulation ---

void RegionMesher::collect(const FaceSets& sets, int set) {
  add_vertices(sets, set);
  edges_.clear();
  border_halfedges_.clear();
  inner_constraints_.clear();
  patch_.edges.clear();
  for (const int face : sets.faces(set)) {
    for (const int side : mesh_->sides(face)) {
      const int across = mesh_->face_of(Mesh::opposite(side));
      if (across == none || sets.set_of(across) != set)
        border_halfedges_.push_back(side);
      else if (side < Mesh::opposite(side))
        patch_.edges.push_back(Mesh::edge_of(side));
    }
  }
  std::sort(patch_.edges.begin(), patch_.edges.end());
  for (const int side : border_halfedges_) add_edge(side);
  for (const int edge : patch_.edges) {
    if (mesh_->constraint_of(edge) == none) continue;
    inner_constraints_.push_back(mesh_->constraint_of(edge));
    add_edge(2 * edge);
  }
}

void RegionMesher::add_vertices(const FaceSets& sets, int set) {
  for (const int v : vertices_) local_of_[v] = none;
  vertices_.clear();
  if (static_cast<int>(local_of_.size()) < mesh_->n_vertices()) local_of_.resize(mesh_->n_vertices(), none);
  for (const int face : sets.faces(set)) {
    for (const int v : mesh_->triangles()[face]) {
      if (local_of_[v] != none) continue;
      vertices_.push_back(v);
      local_of_[v] = 0;
    }
  }
  std::sort(vertices_.begin(), vertices_.end());
  points_.clear();
  for (int i = 0; i < static_cast<int>(vertices_.size()); ++i) {
    local_of_[vertices_[i]] = i;
    points_.push_back(mesh_->position(vertices_[i]));
  }
}

void RegionMesher::add_edge(int halfedge) {
  edges_.push_back({local_of_[mesh_->from(halfedge)], local_of_[mesh_->to(halfedge)]});
}

bool RegionMesher::is_constrained(int edge) const {
  if (edge >= border_edges()) return true;
  return mesh_->constraint_of(Mesh::edge_of(border_halfedges_[edge])) != none;
}

// --- what the triangulation says ---

// Nothing where a larger region may help: what touches need not be an edge of the new mesh.
std::optional<Defect> RegionMesher::verdict(const Contact& contact) const {
  Defect defect{.where = contact.where};
  switch (contact.kind) {
    case Contact::Kind::CoincidentPoints:
      defect.kind = DefectKind::CoincidentVertices;
      defect.vertices = {user(contact.first), user(contact.second)};
      return defect;
    case Contact::Kind::CrossingEdges:
      if (!is_constrained(contact.first) || !is_constrained(contact.second)) return std::nullopt;
      defect.kind = DefectKind::CrossingEdges;
      defect.edges = {user_edge(contact.first), user_edge(contact.second)};
      return defect;
    case Contact::Kind::PointOnEdge:
      if (!is_constrained(contact.second)) return std::nullopt;
      defect.kind = DefectKind::VertexOnEdge;
      defect.vertices = {user(contact.first)};
      defect.edges = {user_edge(contact.second)};
      return defect;
  }
  return std::nullopt;
}

// Inside are the triangles the border goes around once. False if it is not simple.
bool RegionMesher::select_inside(int n_expected) {
  const std::span border(edges_.data(), border_halfedges_.size());
  const auto winding = winding_numbers(triangulation_, border);
  inside_.clear();
  for (int t = 0; t < static_cast<int>(winding.size()); ++t) {
    if (winding[t] == 1)
      inside_.push_back(t);
    else if (winding[t] != 0)
      return false;
  }
  return static_cast<int>(inside_.size()) == n_expected;
}

// A vertex beyond the border of the whole mesh is in no face of the region.
bool RegionMesher::find_lost_vertex() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_outside_hull(*mesh_, points_[i])) continue;
    fail({.kind = DefectKind::LeftDomain, .vertices = {user(static_cast<int>(i))}, .where = points_[i]});
    return true;
  }
  return false;
}

// --- labels ---

bool RegionMesher::set_label(int triangle, int label, int source) {
  if (source_[triangle] != none) {
    if (label_[triangle] == label) return true;
    const auto& corner = points_[triangulation_.triangles[triangle][0]];
    fail({.kind = DefectKind::LabelsMeet,
          .edges = {user_edge(source_[triangle]), user_edge(source)},
          .where = corner});
    return false;
  }
  label_[triangle] = label;
  source_[triangle] = source;
  pending_.push_back(triangle);
  return true;
}

// Across side `side`, into the next triangle of the region.
bool RegionMesher::spread_label(int triangle, int side) {
  const int edge = triangulation_.edges[triangle][side];
  const int across = triangulation_.neighbours[triangle][side];
  if (edge == none) return set_label(across, label_[triangle], source_[triangle]);
  if (edge < border_edges()) return true;
  const auto& constraint = mesh_->constraints()[inner_constraints_[edge - border_edges()]];
  const bool on_left = vertices_[triangulation_.triangles[triangle][side]] == constraint.from;
  return set_label(triangle, on_left ? constraint.left : constraint.right, edge) &&
         set_label(across, on_left ? constraint.right : constraint.left, edge);
}

bool RegionMesher::flood_labels() {
  label_.resize(triangulation_.triangles.size());
  source_.assign(triangulation_.triangles.size(), none);
  pending_.clear();
  for (const int t : inside_) {
    for (const int edge : triangulation_.edges[t]) {
      if (edge == none || edge >= border_edges()) continue;
      if (!set_label(t, mesh_->label(mesh_->face_of(border_halfedges_[edge])), edge)) return false;
    }
  }
  while (!pending_.empty()) {
    const int t = pending_.back();
    pending_.pop_back();
    for (int k = 0; k < 3; ++k) {
      if (!spread_label(t, k)) return false;
    }
  }
  return true;
}

bool RegionMesher::count_escaped() {
  std::vector<bool> away(points_.size(), false);
  for (const int t : inside_) {
    for (const int i : triangulation_.triangles[t]) {
      const int v = vertices_[i];
      away[i] = !mesh_->is_constrained(v) && mesh_->home_label(v) != label_[t];
    }
  }
  escaped_ = static_cast<int>(std::count(away.begin(), away.end(), true));
  if (escaped_ == 0 || options_.allow_escaped) return true;
  const auto first = std::find(away.begin(), away.end(), true) - away.begin();
  fail({.kind = DefectKind::Escaped, .vertices = {user(static_cast<int>(first))}, .where = points_[first]});
  return false;
}

// --- the patch ---

// Sorted by label and corners: independent of how the triangulation was found, and close to memory order.
void RegionMesher::order_new_faces() {
  new_faces_.clear();
  for (const int t : inside_) {
    const auto& local = triangulation_.triangles[t];
    const int shift = static_cast<int>(std::min_element(local.begin(), local.end()) - local.begin());
    Triangle corners;
    for (int k = 0; k < 3; ++k) corners[k] = vertices_[local[(k + shift) % 3]];
    new_faces_.push_back({corners, t, shift, label_[t]});
  }
  std::sort(new_faces_.begin(), new_faces_.end(), [](const NewFace& a, const NewFace& b) {
    return std::tie(a.label, a.corners) < std::tie(b.label, b.corners);
  });
  new_face_.assign(triangulation_.triangles.size(), none);
  for (int i = 0; i < static_cast<int>(new_faces_.size()); ++i) new_face_[new_faces_[i].triangle] = i;
}

// A new face takes the place of one with its label, so that the numbers of the user's faces stay where they
// are. Only when vertices have escaped are some left over, and these change their label.
void RegionMesher::assign_slots(const std::vector<int>& faces) {
  std::vector<int> slots = faces;
  std::sort(slots.begin(), slots.end(),
            [&](int f, int g) { return std::pair(mesh_->label(f), f) < std::pair(mesh_->label(g), g); });
  const int n = static_cast<int>(slots.size());
  std::vector<int> spare_slots, spare_faces;
  patch_.faces.assign(n, none);
  for (int i = 0, j = 0; i < n || j < n;) {
    if (j == n || (i < n && mesh_->label(slots[i]) < new_faces_[j].label))
      spare_slots.push_back(slots[i++]);
    else if (i == n || new_faces_[j].label < mesh_->label(slots[i]))
      spare_faces.push_back(j++);
    else
      patch_.faces[j++] = slots[i++];
  }
  for (std::size_t i = 0; i < spare_faces.size(); ++i) patch_.faces[spare_faces[i]] = spare_slots[i];
}

// Every side gets its half-edge: on the border the one that stays, inside the next of the edges set free.
void RegionMesher::connect() {
  const int n = static_cast<int>(new_faces_.size());
  patch_.triangles.clear();
  patch_.labels.clear();
  patch_.constraints.clear();
  patch_.halfedges.assign(n, {none, none, none});
  const auto side_of = [&](int face, int k) -> int& {
    return patch_.halfedges[face][(k - new_faces_[face].shift + 3) % 3];
  };
  for (int i = 0; i < n; ++i) {
    const auto& face = new_faces_[i];
    patch_.triangles.push_back(face.corners);
    patch_.labels.push_back(face.label);
    for (int j = 0; j < 3; ++j) {
      const int k = (j + face.shift) % 3;
      const int edge = triangulation_.edges[face.triangle][k];
      if (side_of(i, k) != none) continue;
      if (edge != none && edge < border_edges()) {
        side_of(i, k) = border_halfedges_[edge];
        continue;
      }
      if (patch_.constraints.size() == patch_.edges.size()) throw std::logic_error("a region gained an edge");
      const int free_edge = patch_.edges[patch_.constraints.size()];
      patch_.constraints.push_back(edge == none ? none : inner_constraints_[edge - border_edges()]);
      const int across = triangulation_.neighbours[face.triangle][k];
      const auto& beyond = triangulation_.neighbours[across];
      const int back =
          static_cast<int>(std::find(beyond.begin(), beyond.end(), face.triangle) - beyond.begin());
      side_of(i, k) = 2 * free_edge;
      side_of(new_face_[across], back) = 2 * free_edge + 1;
    }
  }
  if (patch_.constraints.size() != patch_.edges.size()) throw std::logic_error("a region lost an edge");
}

void RegionMesher::certify() const {
  for (const auto& [a, b, c] : patch_.triangles) {
    if (orientation(mesh_->position(a), mesh_->position(b), mesh_->position(c)) !=
        Orientation::CounterClockwise) {
      throw std::logic_error("a new face is not upright");
    }
  }
}

}  // namespace kinemesh
