#include "untangle/fill/region_mesher.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "core/base/ascending.h"
#include "core/base/sort_distinct.h"
#include "core/mesh/frame.h"
#include "core/mesh/winding.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
RegionMesher::Result RegionMesher::run(const Mesh& mesh, const Hole& hole) {
  if (small_.run(mesh, hole)) {
    std::swap(new_faces_, small_.new_faces());
    return Result::Done;
  }
  return run_generally(mesh, hole);
}

RegionMesher::Result RegionMesher::run_generally(const Mesh& mesh, const Hole& hole) {
  mesh_ = &mesh;
  hole_ = &hole;
  collect();
  if (const auto contact = triangulator_.triangulate(points_, edges_, triangulation_)) {
    if (auto defect = verdict(*contact)) {
      defect_ = std::move(*defect);
      return Result::NoMesh;
    }
  } else if (select_inside()) {
    convert();
    return Result::Done;
  }
  return find_lost_vertex() || find_taken_edge() ? Result::NoMesh : Result::NotSimple;
}

// --- what goes into the triangulation ---

void RegionMesher::collect() {
  add_vertices();
  edges_.clear();
  for (const auto& side : hole_->border) edges_.push_back({local_of_[side.from], local_of_[side.to]});
  for (const Side side : hole_->inner_constraints)
    edges_.push_back({local_of_[mesh_->from(side)], local_of_[mesh_->to(side)]});
}

void RegionMesher::add_vertices() {
  for (const Vertex v : vertices_) local_of_[v] = none;
  vertices_.clear();
  if (static_cast<int>(local_of_.size()) < mesh_->n_vertices()) local_of_.resize(mesh_->n_vertices(), none);
  for (const Face face : hole_->faces) {
    for (const Vertex v : mesh_->triangles()[face]) {
      if (local_of_[v] != none) continue;
      vertices_.push_back(v);
      local_of_[v] = 0;
    }
  }
  sort_distinct(vertices_, mesh_->n_vertices());
  points_.clear();
  for (int i = 0; i < static_cast<int>(vertices_.size()); ++i) {
    local_of_[vertices_[i]] = i;
    points_.push_back(mesh_->position(vertices_[i]));
  }
}

bool RegionMesher::is_constrained(int edge) const {
  if (edge >= border_edges()) return true;
  return mesh_->has_constraint(hole_->border[edge].side);
}

// --- what the triangulation says ---

// Nothing where a larger region may help: what touches need not be an edge of the new mesh. At a corner of
// the frame, which users do not know, a vertex has left the domain.
std::optional<Defect> RegionMesher::verdict(const Contact& contact) const {
  Defect defect{.where = contact.where};
  switch (contact.kind) {
    case Contact::Kind::CoincidentPoints:
      for (const int i : {contact.first, contact.second})
        if (user(i) == none) return left_domain(i == contact.first ? contact.second : contact.first);
      defect.kind = DefectKind::CoincidentVertices;
      defect.vertices = {user(contact.first), user(contact.second)};
      break;
    case Contact::Kind::CrossingEdges:
      if (!is_constrained(contact.first) || !is_constrained(contact.second)) return std::nullopt;
      defect.kind = DefectKind::CrossingEdges;
      defect.edges = {user_edge(contact.first), user_edge(contact.second)};
      break;
    case Contact::Kind::PointOnEdge:
      if (!is_constrained(contact.second)) return std::nullopt;
      defect.kind = DefectKind::VertexOnEdge;
      defect.vertices = {user(contact.first)};
      defect.edges = {user_edge(contact.second)};
      break;
  }
  defect.detail = lines_of(*mesh_, defect);
  return defect;
}

// Inside are the triangles the border goes around once. False if it is not simple, or if a constrained edge
// is not inside.
bool RegionMesher::select_inside() {
  const std::span border(edges_.data(), hole_->border.size());
  const auto winding = winding_numbers(triangulation_, border);
  inside_.clear();
  std::size_t constrained_sides = 0;
  for (int t = 0; t < static_cast<int>(winding.size()); ++t) {
    if (winding[t] == 0) continue;
    if (winding[t] != 1) return false;
    inside_.push_back(t);
    const auto& edges = triangulation_.edges[t];
    constrained_sides +=
        std::count_if(edges.begin(), edges.end(), [&](int e) { return e >= border_edges(); });
  }
  return inside_.size() == hole_->faces.size() && constrained_sides == 2 * hole_->inner_constraints.size();
}

Defect RegionMesher::left_domain(int local) const {
  return {.kind = DefectKind::LeftDomain, .vertices = {user(local)}, .where = points_[local]};
}

// A vertex beyond the border of the whole mesh is in no face of the region.
bool RegionMesher::find_lost_vertex() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_outside_hull(*mesh_, points_[i])) continue;
    defect_ = left_domain(static_cast<int>(i));
    return true;
  }
  return false;
}

// A constrained edge of the domain with the same ends as an edge of the padding's convex border.
bool RegionMesher::find_taken_edge() {
  std::vector<Edge> taken;
  for (int i = 0; i < border_edges(); ++i) {
    if (mesh_->face_across(hole_->border[i].side) == none) taken.push_back(ascending(edges_[i]));
  }
  std::sort(taken.begin(), taken.end());
  for (int i = border_edges(); i < static_cast<int>(edges_.size()); ++i) {
    if (!std::binary_search(taken.begin(), taken.end(), ascending(edges_[i]))) continue;
    defect_ = Defect{.kind = DefectKind::MissingEdge,
                     .edges = {user_edge(i)},
                     .where = points_[edges_[i][0]],
                     .detail = "its place is outside the domain"};
    return true;
  }
  return false;
}

void RegionMesher::convert() {
  number_.assign(triangulation_.triangles.size(), none);
  for (std::size_t i = 0; i < inside_.size(); ++i) number_[inside_[i]] = static_cast<int>(i);
  new_faces_.clear();
  for (const int t : inside_) {
    MeshTriangle corners;
    Triangle neighbours, constraints{none, none, none};
    for (int k = 0; k < 3; ++k) {
      const int edge = triangulation_.edges[t][k];
      const bool on_border = edge != none && edge < border_edges();
      corners[k] = vertices_[triangulation_.triangles[t][k]];
      neighbours[k] = on_border ? ~hole_->border[edge].side : number_[triangulation_.neighbours[t][k]];
      if (edge != none && !on_border)
        constraints[k] = mesh_->constraint_of(hole_->inner_constraints[edge - border_edges()]);
    }
    new_faces_.add(corners, neighbours, constraints);
  }
}

}  // namespace kinemesh
