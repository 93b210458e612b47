#include "untangle/quality/vertex_sweeps.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/mesh/around.h"
#include "kinemesh/measure.h"

namespace kinemesh {
namespace {

double distance_to_nearest_neighbour(const Mesh& mesh, Vertex vertex) {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_neighbour(mesh, vertex, [&](Vertex neighbour, int) {
    nearest = std::min(nearest, glm::distance(mesh.position(vertex), mesh.position(neighbour)));
  });
  return nearest;
}

// Of the smallest angle around the vertex; 0 if one of its faces is not upright, exactly. As measure has it,
// to the last bit: corners in the same order.
double worst_tangent(const Mesh& mesh, Vertex vertex) {
  double worst = std::numeric_limits<double>::infinity();
  for_each_side_from(mesh, vertex, [&](Side side) {
    const Face face = Mesh::face_of(side);
    worst = std::min(worst, is_upright(mesh, face) ? tangent_of_smallest_angle(mesh.corners(face)) : 0.0);
  });
  return worst;
}

// Moves the vertex there, or not at all.
bool try_place(Mesh& mesh, Vertex vertex, const Point& place, const VertexSweeps::Demand& demand) {
  Point& position = mesh.positions()[vertex];
  const Point before = position;
  if (!(glm::distance(before, place) >= demand.least_distance) || place == before) return false;
  position = place;
  if (worst_tangent(mesh, vertex) > demand.tangent) return true;
  position = before;
  return false;
}

}  // namespace

VertexSweeps::Counts VertexSweeps::run(Mesh& mesh, const SmoothingOptions& options,
                                       std::span<const char> stays) {
  stays_ = stays;
  std::fill(is_moved_.begin(), is_moved_.end(), false);
  moved_.clear();
  for (const Vertex v : mesh.vertices()) restless_[v] = may_move(mesh, v);
  Counts counts;
  for (int moves = 1; moves > 0 && counts.sweeps < options.max_sweeps; ++counts.sweeps) {
    moves = 0;
    for (const Vertex v : mesh.vertices()) moves += restless_[v] && visit(mesh, v, options);
    counts.moves += moves;
  }
  counts.moved = static_cast<int>(moved_.size());
  return counts;
}

bool VertexSweeps::may_move(const Mesh& mesh, Vertex vertex) const {
  return is_movable(mesh, vertex) && (held_.empty() || !held_[vertex]) && (stays_.empty() || !stays_[vertex]);
}

bool VertexSweeps::visit(Mesh& mesh, Vertex v, const SmoothingOptions& options) {
  restless_[v] = false;
  const Point before = mesh.position(v);
  const Demand demand{options.least_move * distance_to_nearest_neighbour(mesh, v), worst_tangent(mesh, v)};
  const bool moves = options.method == SmoothingMethod::Laplacian ? move_towards_mean(mesh, v, demand)
                                                                  : move_to_optimum(mesh, v, demand);
  if (!moves) return false;
  if (!std::exchange(is_moved_[v], true)) moved_.push_back({v, before});
  restless_[v] = true;
  for_each_neighbour(mesh, v, [&](Vertex w, int) { restless_[w] = may_move(mesh, w); });
  return true;
}

bool VertexSweeps::move_towards_mean(Mesh& mesh, Vertex v, const Demand& demand) {
  Point sum{0.0, 0.0};
  int neighbours = 0;
  for_each_neighbour(mesh, v, [&](Vertex neighbour, int) {
    sum += mesh.position(neighbour);
    ++neighbours;
  });
  const Point place = mesh.position(v), mean = sum / static_cast<double>(neighbours);
  for (const double share : {1.0, 0.5, 0.25}) {
    if (try_place(mesh, v, place + share * (mean - place), demand)) return true;
  }
  return false;
}

bool VertexSweeps::move_to_optimum(Mesh& mesh, Vertex v, const Demand& demand) {
  link_.clear();
  for_each_side_from(mesh, v, [&](Side side) {
    link_.push_back({mesh.position(mesh.to(side)), mesh.position(mesh.apex(side))});
  });
  return try_place(mesh, v, optimal_point(link_, mesh.position(v)), demand);
}

}  // namespace kinemesh
