#include "examples/heat/heat_equation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "kinemesh/build.h"

namespace heat {
namespace {

using kinemesh::none;

// Weights of the corners at the three points of a rule that is exact for quadratic polynomials.
double weight(int point, int corner) {
  return point == corner ? 2.0 / 3 : 1.0 / 6;
}

Point rule_point(const std::vector<Point>& x, const Triangle& t, int point) {
  Point at(0.0);
  for (int k = 0; k < 3; ++k) at += weight(point, k) * x[t[k]];
  return at;
}

}  // namespace

HeatEquation::HeatEquation(const Problem& problem, double h)
    : problem_(problem),
      start_(square_with_body(problem.shape, h)),
      body_vertices_(body_vertices(start_)),
      in_body_(start_.n_vertices(), false),
      stepper_(kinemesh::build_mesh(start_), {.quality = "delaunay"}),
      matrices_(start_),
      solver_(make_solver()),
      x_(start_.points),
      labels_(start_.labels) {
  // Copied here, used once the step is taken: so nothing of ours has changed if it is not.
  stepper_.observe([this](const kinemesh::StepChanges& changes) {
    changed_.clear();
    for (const auto& patch : changes.patches)
      changed_.insert(changed_.end(), patch.faces.begin(), patch.faces.end());
  });
  for (const Point& p : x_) u_.push_back(problem_.border(p, 0.0));
  for (const int v : body_vertices_) in_body_[v] = true;
  number_unknowns();
}

void HeatEquation::number_unknowns() {
  for (const Point& p : x_) {
    const bool on_border = p.x == 0 || p.x == 1 || p.y == 0 || p.y == 1;
    unknown_.push_back(on_border ? none : n_unknowns_++);
  }
}

// The mesh follows the material.
void HeatEquation::move(double t, double dt) {
  for (const int v : body_vertices_) x_[v] = problem_.shape.turned(start_.points[v], t);
  const auto outcome = stepper_.step(x_, dt);
  if (!outcome) throw std::runtime_error(outcome.defect->message());
  for (const auto& change : changed_) labels_[change.face] = change.label_after;
  matrices_.rewire(changed_);
  matrices_.measure(reshaped_faces(), x_);
  regions_ += static_cast<long>(outcome.record.repair.regions.size());
  faces_replaced_ += static_cast<long>(changed_.size());
}

// Those with other corners, and those between the body and the medium: all others have moved rigidly or not
// at all.
std::vector<int> HeatEquation::reshaped_faces() const {
  std::vector<int> faces;
  for (const auto& change : changed_) faces.push_back(change.face);
  for (const int v : body_vertices_)
    for (const int f : matrices_.faces_at(v))
      if (labels_[f] == medium) faces.push_back(f);
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// The first step is one of backward Euler, all others are BDF2:
//   (w M + K) u = M (w' u(n) - w'' u(n-1)) + F,   w = 1.5 / dt, w' = 2 / dt, w'' = 0.5 / dt
void HeatEquation::step(double dt) {
  const bool is_first = u_before_.empty();
  time_ += dt;
  move(time_, dt);
  const double w = (is_first ? 1.0 : 1.5) / dt;
  if (w != factorized_for_ || problem_.shape.rate != 0) factorize(w);

  std::vector<double> history(u_.size()), next(u_.size());
  for (std::size_t v = 0; v < u_.size(); ++v) {
    history[v] = is_first ? u_[v] / dt : (2 * u_[v] - 0.5 * u_before_[v]) / dt;
    if (unknown_[v] == none) next[v] = problem_.border(x_[v], time_);
  }
  auto load = loads(time_);
  if (!is_first) add_drift(load);
  std::vector<double> right(n_unknowns_);
  for (std::size_t v = 0; v < u_.size(); ++v) {
    if (unknown_[v] == none) continue;
    double sum = load[v];
    for (const auto& entry : matrices_.row(static_cast<int>(v))) {
      sum += entry.mass * history[entry.column];
      if (unknown_[entry.column] == none) sum -= (w * entry.mass + entry.stiffness) * next[entry.column];
    }
    right[unknown_[v]] = sum;
  }
  const auto solution = solver_->solve(right);
  for (std::size_t v = 0; v < u_.size(); ++v)
    if (unknown_[v] != none) next[v] = solution[unknown_[v]];
  u_before_ = std::exchange(u_, std::move(next));
}

void HeatEquation::factorize(double weight_of_mass) {
  SparseMatrix matrix;
  for (int v = 0; v < matrices_.n_vertices(); ++v) {
    if (unknown_[v] == none) continue;
    for (const auto& entry : matrices_.row(v)) {
      if (unknown_[entry.column] == none) continue;
      matrix.column.push_back(unknown_[entry.column]);
      matrix.value.push_back(weight_of_mass * entry.mass + entry.stiffness);
    }
    matrix.start.push_back(static_cast<int>(matrix.column.size()));
  }
  solver_->factorize(matrix);
  factorized_for_ = weight_of_mass;
  ++factorizations_;
}

// Integrals of f phi.
std::vector<double> HeatEquation::loads(double t) const {
  std::vector<double> all(x_.size(), 0.0);
  const auto triangles = matrices_.triangles();
  for (int f = 0; f < static_cast<int>(triangles.size()); ++f)
    for (int point = 0; point < 3; ++point) {
      const double value = problem_.source(rule_point(x_, triangles[f], point), t, labels_[f]);
      for (int k = 0; k < 3; ++k) all[triangles[f][k]] += matrices_.area(f) / 3 * weight(point, k) * value;
    }
  return all;
}

// Integrals of w . grad u phi over the faces between body and medium; u from the last two steps.
void HeatEquation::add_drift(std::vector<double>& loads) const {
  for (const int f : reshaped_faces()) {
    const Triangle& t = matrices_.triangles()[f];
    if (labels_[f] != medium) continue;
    Point slope(0.0);
    std::array<Point, 3> w;
    for (int k = 0; k < 3; ++k) {
      const Point side = x_[t[(k + 2) % 3]] - x_[t[(k + 1) % 3]];
      slope += (2 * u_[t[k]] - u_before_[t[k]]) / (2 * matrices_.area(f)) * Point(-side.y, side.x);
      w[k] = in_body_[t[k]] ? problem_.shape.velocity(x_[t[k]], body) : Point(0.0);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        loads[t[i]] += matrices_.area(f) / (i == j ? 6 : 12) * glm::dot(w[j], slope);
  }
}

double HeatEquation::error() const {
  double sum = 0.0;
  const auto triangles = matrices_.triangles();
  for (int f = 0; f < static_cast<int>(triangles.size()); ++f)
    for (int point = 0; point < 3; ++point) {
      double difference = -problem_.border(rule_point(x_, triangles[f], point), time_);
      for (int k = 0; k < 3; ++k) difference += weight(point, k) * u_[triangles[f][k]];
      sum += matrices_.area(f) / 3 * difference * difference;
    }
  return std::sqrt(sum);
}

}  // namespace heat
