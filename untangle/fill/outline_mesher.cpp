#include "untangle/fill/outline_mesher.h"

#include <numeric>

namespace kinemesh {

int Outline::add_vertex(int v) {
  const auto [it, fresh] = places.try_emplace(v, static_cast<int>(vertices.size()));
  if (fresh) vertices.push_back(v);
  return it->second;
}

void Outline::add_sub_segment(int number, const SubSegment& sub) {
  const int from = add_vertex(sub.from), to = add_vertex(sub.to);
  edges.push_back({from, to});
  subs.push_back(number);
}

void Outline::add_constraint(int number, int a, int b) {
  const int from = add_vertex(a), to = add_vertex(b);
  edges.push_back({from, to});
  constraints.push_back(number);
}

std::optional<PlanePart> OutlineMesher::run(const Outline& outline, Keep keep) {
  outline_ = &outline;
  keep_ = keep;
  if (!triangulate() || !flood()) return std::nullopt;
  return kept_faces();
}

bool OutlineMesher::triangulate() {
  std::vector<int> order(outline_->vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto point_at = [&](int i) -> const ExactPoint& { return border_.points[outline_->vertices[i]]; };
  return cgal_.insert_points(order, point_at) && cgal_.insert_edges(outline_->edges) &&
         cgal_.extract(triangulation_);
}

// False if it comes to the other side of a sub-segment.
bool OutlineMesher::flood() {
  start();
  while (!pending_.empty()) {
    const int t = pending_.back();
    pending_.pop_back();
    for (int k = 0; k < 3; ++k) {
      if (!spread(t, k)) return false;
    }
  }
  return true;
}

void OutlineMesher::start() {
  reached_.assign(triangulation_.triangles.size(), false);
  pending_.clear();
  for (int t = 0; t < n_triangles(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (sub_on(t, k) != none && is_on_kept_side(t, k)) reach(t);
    }
  }
}

bool OutlineMesher::spread(int t, int k) {
  if (sub_on(t, k) != none) return is_on_kept_side(t, k);
  reach(triangulation_.neighbours[t][k]);
  return true;
}

void OutlineMesher::reach(int t) {
  if (t == none || reached_[t]) return;
  reached_[t] = true;
  pending_.push_back(t);
}

int OutlineMesher::sub_on(int t, int k) const {
  const int edge = triangulation_.edges[t][k];
  return edge != none && edge < static_cast<int>(outline_->subs.size()) ? outline_->subs[edge] : none;
}

// Pre: a sub-segment is on the side.
bool OutlineMesher::is_on_kept_side(int t, int k) const {
  const int start = outline_->vertices[triangulation_.triangles[t][k]];
  return (start == border_.subs[sub_on(t, k)].from) == (keep_ == Keep::Left);
}

PlanePart OutlineMesher::kept_faces() const {
  const auto number = numbers();
  PlanePart part;
  for (int t = 0; t < n_triangles(); ++t) {
    if (!reached_[t]) continue;
    auto& face = part.emplace_back();
    for (int k = 0; k < 3; ++k) {
      face.corners[k] = outline_->vertices[triangulation_.triangles[t][k]];
      face.sides[k] = side_of(t, k, number);
    }
  }
  return part;
}

// Per triangle: among those reached, or none.
std::vector<int> OutlineMesher::numbers() const {
  std::vector<int> number(n_triangles(), none);
  int n = 0;
  for (int t = 0; t < n_triangles(); ++t) {
    if (reached_[t]) number[t] = n++;
  }
  return number;
}

PlaneSide OutlineMesher::side_of(int t, int k, const std::vector<int>& number) const {
  const int edge = triangulation_.edges[t][k], across = triangulation_.neighbours[t][k];
  const int n_subs = static_cast<int>(outline_->subs.size());
  PlaneSide side;
  side.sub = sub_on(t, k);
  if (side.sub == none && across != none) side.face = number[across];
  if (edge >= n_subs) side.constraint = outline_->constraints[edge - n_subs];
  return side;
}

}  // namespace kinemesh
