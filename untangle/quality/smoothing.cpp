#include "untangle/quality/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/measure.h"
#include "untangle/local.h"
#include "untangle/quality/around.h"
#include "untangle/quality/optimal_point.h"

namespace kinemesh {
namespace {

bool is_free(const Mesh& mesh, int v) {
  return mesh.user_vertex(v) != none && !mesh.is_isolated(v) && !mesh.is_constrained(v) && !mesh.is_fixed(v);
}

class Smoother {
 public:
  Smoother(Mesh& mesh, const SmoothingOptions& options)
      : mesh_(mesh),
        options_(options),
        restless_(mesh.n_vertices(), false),
        moved_(mesh.n_vertices(), false) {}

  SmoothingOutcome run() {
    outcome_.min_angle_before_deg = measure(mesh_).min_angle_deg;
    if (untangle()) sweep_until_quiet();
    outcome_.moved = static_cast<int>(std::count(moved_.begin(), moved_.end(), true));
    outcome_.min_angle_after_deg = measure(mesh_).min_angle_deg;
    return outcome_;
  }

 private:
  bool untangle();
  int tangled_face_at(int vertex) const;
  bool untangle_from(int face);

  void sweep_until_quiet();
  bool visit(int vertex);
  void look_around(int vertex);
  bool move_towards_mean(int vertex);
  bool try_place(int vertex, const Point& place);
  double worst_tangent() const;

  Mesh& mesh_;
  const SmoothingOptions& options_;
  SmoothingOutcome outcome_;
  LocalUntangling untangler_;
  std::vector<char> restless_;  // per vertex: free, and something around it has changed since it was visited
  std::vector<char> moved_;     // per vertex

  // Around the vertex at hand.
  std::vector<int> faces_, neighbours_;
  std::vector<LinkEdge> link_;
  double least_distance_ = 0.0;  // a move has to go
  double tangent_ = 0.0;         // of the smallest angle
};

// --- tangles ---

bool Smoother::untangle() {
  for (int v = 0; v < mesh_.n_vertices(); ++v) {
    for (int face = tangled_face_at(v); face != none; face = tangled_face_at(v)) {
      if (!untangle_from(face)) return false;
    }
  }
  return true;
}

int Smoother::tangled_face_at(int vertex) const {
  int tangled = none;
  for_each_outgoing(mesh_, vertex, [&](int h) {
    const int face = mesh_.face_of(h);
    if (face != none && !is_upright(mesh_, face)) tangled = face;
  });
  return tangled;
}

bool Smoother::untangle_from(int face) {
  auto repaired = untangler_.repair_seeds(mesh_, std::array{face}, options_.repair);
  outcome_.untangled += static_cast<int>(repaired.record.regions.size());
  outcome_.replaced += repaired.record.replaced;
  outcome_.defect = std::move(repaired.defect);
  return !outcome_.defect;
}

// --- moves ---

void Smoother::sweep_until_quiet() {
  for (int v = 0; v < mesh_.n_vertices(); ++v) restless_[v] = is_free(mesh_, v);
  for (int moves = 1; moves > 0 && outcome_.sweeps < options_.max_sweeps; ++outcome_.sweeps) {
    moves = 0;
    for (int v = 0; v < mesh_.n_vertices(); ++v) moves += restless_[v] && visit(v);
    outcome_.moves += moves;
  }
}

bool Smoother::visit(int v) {
  restless_[v] = false;
  look_around(v);
  const bool moves = options_.method == SmoothingMethod::Laplacian
                         ? move_towards_mean(v)
                         : try_place(v, optimal_point(link_, mesh_.position(v)));
  if (!moves) return false;
  moved_[v] = restless_[v] = true;
  for (const int neighbour : neighbours_) restless_[neighbour] = is_free(mesh_, neighbour);
  return true;
}

void Smoother::look_around(int v) {
  faces_.clear();
  neighbours_.clear();
  link_.clear();
  double nearest = std::numeric_limits<double>::infinity();
  for_each_outgoing(mesh_, v, [&](int h) {
    const int p = mesh_.to(h), q = mesh_.to(mesh_.next(h));
    faces_.push_back(mesh_.face_of(h));
    neighbours_.push_back(p);
    link_.push_back({mesh_.position(p), mesh_.position(q)});
    nearest = std::min(nearest, glm::distance(mesh_.position(v), mesh_.position(p)));
  });
  least_distance_ = options_.least_move * nearest;
  tangent_ = worst_tangent();
}

bool Smoother::move_towards_mean(int v) {
  Point sum{0.0, 0.0};
  for (const auto& edge : link_) sum += edge[0];
  const Point place = mesh_.position(v), mean = sum / static_cast<double>(link_.size());
  for (const double share : {1.0, 0.5, 0.25}) {
    if (try_place(v, place + share * (mean - place))) return true;
  }
  return false;
}

// Moves the vertex there, or not at all.
bool Smoother::try_place(int v, const Point& place) {
  Point& position = mesh_.positions()[v];
  const Point before = position;
  if (!(glm::distance(before, place) >= least_distance_) || place == before) return false;
  position = place;
  const bool upright = std::all_of(faces_.begin(), faces_.end(), [&](int f) { return is_upright(mesh_, f); });
  if (upright && worst_tangent() > tangent_) return true;
  position = before;
  return false;
}

// As measure has it, to the last bit: corners in the same order.
double Smoother::worst_tangent() const {
  double worst = std::numeric_limits<double>::infinity();
  for (const int face : faces_) worst = std::min(worst, tangent_of_smallest_angle(mesh_.corners(face)));
  return worst;
}

}  // namespace

SmoothingOutcome smooth(Mesh& mesh, const SmoothingOptions& options) {
  if (options.max_sweeps < 0) throw InputError("max_sweeps must be 0 or more");
  if (!(options.least_move >= 0.0)) throw InputError("least_move must be 0 or more");
  return Smoother(mesh, options).run();
}

}  // namespace kinemesh
