#include "untangle/strategies/optimize.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "core/base/stopwatch.h"
#include "core/exact/compare_areas.h"
#include "core/mesh/around.h"
#include "untangle/fill/records.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/stuck.h"

namespace kinemesh {
namespace {

using Corners3 = std::array<Point, 3>;

// Shorter moves, of the distance to the farthest neighbour, are made only if faces become upright by them:
// otherwise gains go on for ever and to nothing.
constexpr double least_move = 1e-3;

constexpr double share_of_way = 0.9;  // to a place that does not untangle

Corners3 triangle(const Point& x, const LinkEdge& edge) {
  return {x, edge[0], edge[1]};
}

Corners3 smallest(std::span<const LinkEdge> link, const Point& x) {
  Corners3 worst = triangle(x, link.front());
  for (const auto& edge : link.subspan(1)) {
    if (compare_areas(triangle(x, edge), worst) < 0) worst = triangle(x, edge);
  }
  return worst;
}

bool all_larger(std::span<const LinkEdge> link, const Point& x, const Corners3& bound) {
  return std::all_of(link.begin(), link.end(),
                     [&](const LinkEdge& edge) { return compare_areas(triangle(x, edge), bound) > 0; });
}

auto count_upright(std::span<const LinkEdge> link, const Point& x) {
  return std::count_if(link.begin(), link.end(), [&](const LinkEdge& edge) {
    return orientation(x, edge[0], edge[1]) == Orientation::CounterClockwise;
  });
}

double reach(std::span<const LinkEdge> link, const Point& x) {
  double farthest = 0.0;
  for (const auto& edge : link) farthest = std::max(farthest, glm::distance(x, edge[0]));
  return farthest;
}

template <class Number>
void sort_unique(std::vector<Number>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<Face> all_of(const Tangles& tangles) {
  auto all = tangles.inverted;
  all.insert(all.end(), tangles.flat.begin(), tangles.flat.end());
  return all;
}

}  // namespace

// Puts the vertices back when it goes out of scope, unless they are kept.
class VertexOptimization::Run {
 public:
  Run(VertexOptimization& own, Mesh& mesh, const Tangles& tangles)
      : own_(own), mesh_(mesh), left_(tangles), is_restless_(mesh.n_vertices(), true) {
    own_.moved_.clear();
    own_.is_moved_.assign(mesh.n_vertices(), false);
    own_.sweeps_ = 0;
  }
  ~Run() {
    if (kept_) return;
    for (const auto& [v, from] : own_.moved_) mesh_.positions()[v] = from;
    own_.moved_.clear();
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  void keep() { kept_ = true; }

  // Returns what is left.
  const Tangles& sweep_all() {
    std::size_t fewest = all_of(left_).size();
    for (int rings = 0; fewest > 0 && rings < max_rings; ++own_.sweeps_) {
      sweep(within(rings));
      const auto now = all_of(left_).size();
      rings = now < fewest ? 0 : rings + 1;
      fewest = std::min(fewest, now);
    }
    return left_;
  }

 private:
  // Free vertices so many edges or fewer from a face that is left, ascending.
  std::vector<Vertex> within(int rings) const {
    std::vector<Vertex> vertices;
    for (const Face face : all_of(left_))
      vertices.insert(vertices.end(), mesh_.triangles()[face].begin(), mesh_.triangles()[face].end());
    for (int ring = 0; ring < rings; ++ring) {
      sort_unique(vertices);
      for (std::size_t i = 0, n = vertices.size(); i < n; ++i)
        for_each_neighbour(mesh_, vertices[i], [&](Vertex w, Side) { vertices.push_back(w); });
    }
    sort_unique(vertices);
    std::erase_if(vertices, [&](Vertex v) { return !is_movable(mesh_, v); });
    return vertices;
  }

  void sweep(const std::vector<Vertex>& vertices) {
    auto faces = all_of(left_);
    for (const Vertex v : vertices) {
      if (!is_restless_[v] || !visit(v)) continue;
      for_each_side_from(mesh_, v, [&](Side side) { faces.push_back(Mesh::face_of(side)); });
    }
    sort_unique(faces);
    left_ = tangles_among(mesh_, faces);
  }

  bool visit(Vertex v) {
    is_restless_[v] = false;
    auto& link = own_.link_;
    link.clear();
    for_each_side_from(mesh_, v, [&](Side side) {
      link.push_back({mesh_.position(mesh_.to(side)), mesh_.position(mesh_.apex(side))});
    });
    const auto place = place_of(link, mesh_.position(v));
    if (!place || !is_better(link, mesh_.position(v), *place)) return false;
    move(v, *place);
    return true;
  }

  // Where the best place leaves a face that is not upright, it often lies on another vertex, and faces
  // between two such vertices stay flat for good. Short of it is better too: the smallest area is concave.
  std::optional<Point> place_of(std::span<const LinkEdge> link, const Point& from) {
    const auto best = own_.max_min_area_(link);
    if (!best || count_upright(link, *best) == std::ssize(link)) return best;
    return from + share_of_way * (*best - from);
  }

  static bool is_better(std::span<const LinkEdge> link, const Point& from, const Point& to) {
    const bool is_worth_it = glm::distance(from, to) >= least_move * reach(link, from) ||
                             count_upright(link, to) > count_upright(link, from);
    return is_worth_it && all_larger(link, to, smallest(link, from));
  }

  void move(Vertex v, const Point& place) {
    if (!own_.is_moved_[v]) own_.moved_.emplace_back(v, mesh_.position(v));
    own_.is_moved_[v] = true;
    mesh_.positions()[v] = place;
    for_each_neighbour(mesh_, v, [&](Vertex w, Side) { is_restless_[w] = true; });
  }

  VertexOptimization& own_;
  Mesh& mesh_;
  Tangles left_;
  std::vector<char> is_restless_;  // per vertex: something around it has changed since it was visited
  bool kept_ = false;
};

RepairOutcome VertexOptimization::repair(Mesh& mesh, const Move& move) {
  RepairOutcome outcome;
  auto& record = outcome.record;
  const auto tangles = detect(mesh, move, record);
  record.components = inverted_components(mesh, tangles.inverted).count;

  const Stopwatch sweeping;
  if (tangles.empty()) {
    sweeps_ = 0;
    moved_.clear();
  } else {
    Run run(*this, mesh, tangles);
    const auto& left = run.sweep_all();
    if (left.empty())
      run.keep();
    else
      outcome.defect = stuck_defect(mesh, left, "moves of vertices");
  }
  record.explore_ms = sweeping.milliseconds();
  if (!outcome.defect) record.escaped = count_escaped(mesh, move.options());
  return outcome;
}

}  // namespace kinemesh
