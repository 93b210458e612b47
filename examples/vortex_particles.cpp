// A vortex method: each vertex is a vortex that carries circulation. It moves in the velocity of all
// others, and viscosity passes circulation on between Delaunay neighbours. kinemesh keeps the triangulation
// Delaunay while the vortices turn around each other; the interaction list follows by what changed.
//
// Between neighbours i and j goes nu (cot alpha + cot beta) / 2 (w_j - w_i) per time, where alpha and beta
// are the angles opposite to their edge, w = circulation / area of the Voronoi cell. In a Delaunay
// triangulation no such weight is negative, so that vorticity makes no new extremes; circulation is conserved
// to rounding, and the angular impulse sum G |x|^2 grows by 4 nu sum G per time, as it does in a viscous
// fluid.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include "core/cdt/triangulator.h"
#include "kinemesh/build.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"

namespace {

using namespace kinemesh;
using std::numbers::pi;

constexpr double viscosity = 1e-3, circulation = 1.0;
constexpr double core_radius = 0.2;  // of the vorticity, a Gaussian
constexpr double blur = 0.03;        // of a single vortex; about the distance between two

// Of neighbours in one of the two triangles they share.
struct Pair {
  int i, j;
  double half_cot;
};

class Vortices {
 public:
  explicit Vortices(const MeshData& mesh)
      : stepper_(build_mesh(mesh), {.quality = "delaunay"}),
        triangles_(mesh.triangles),
        on_border_(mesh.n_vertices(), false),
        x_(mesh.points) {
    for (const auto& marker : mesh.markers)
      for (const auto& [a, b] : marker.edges) on_border_[a] = on_border_[b] = true;
    stepper_.observe([this](const StepChanges& changes) { changed_ = changes.patches; });
    weigh_pairs();
    for (std::size_t v = 0; v < x_.size(); ++v) {
      const double gaussian = std::exp(-dot(x_[v], x_[v]) / (core_radius * core_radius));
      strength_.push_back(on_border_[v] ? 0.0 : gaussian * area_[v]);
    }
    const double scale = circulation / total();
    for (double& strength : strength_) strength *= scale;
  }

  Vortices(const Vortices&) = delete;  // the stepper's observer knows where it is
  Vortices& operator=(const Vortices&) = delete;

  void step(double dt) {
    convect(dt);
    const auto outcome = stepper_.step(x_, dt);
    if (!outcome) throw std::runtime_error(outcome.defect->message());
    for (const auto& patch : changed_)
      for (const auto& change : patch.faces) {
        triangles_[change.face] = kinemesh::numbers_of(change.after);
      }
    regions += static_cast<int>(outcome.record.repair.regions.size());
    flips += outcome.record.repair.quality_flips;
    weigh_pairs();
    diffuse(dt);
  }

  double total() const {
    double sum = 0.0;
    for (const double strength : strength_) sum += strength;
    return sum;
  }
  double impulse() const {
    double sum = 0.0;
    for (std::size_t v = 0; v < x_.size(); ++v) sum += strength_[v] * dot(x_[v], x_[v]);
    return sum;
  }
  double smallest_weight() const { return smallest_weight_; }

  // The interaction list is that of a Delaunay triangulation from scratch; pairs that tie with others apart.
  bool has_delaunay_neighbours() const {
    Triangulation fresh;
    std::vector<Edge> border;
    for (const auto& marker : stepper_.mesh().markers())
      border.insert(border.end(), marker.edges.begin(), marker.edges.end());
    if (Triangulator().triangulate(x_, border, fresh)) return false;
    return edges_of(fresh.triangles) == edges_of(triangles_);
  }

  int regions = 0, flips = 0;

 private:
  static std::set<Edge> edges_of(const std::vector<Triangle>& triangles) {
    std::set<Edge> edges;
    for (const auto& t : triangles)
      for (int k = 0; k < 3; ++k)
        edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    return edges;
  }

  // The law of Biot and Savart, summed directly.
  std::vector<Point> velocity(const std::vector<Point>& x) const {
    std::vector<Point> v(x.size(), Point(0.0));
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (on_border_[i]) continue;
      for (std::size_t j = 0; j < x.size(); ++j) {
        const Point arm = x[i] - x[j];
        v[i] += strength_[j] / (2 * pi * (dot(arm, arm) + blur * blur)) * Point(-arm.y, arm.x);
      }
    }
    return v;
  }

  static std::vector<Point> ahead(const std::vector<Point>& x, double dt, const std::vector<Point>& v) {
    std::vector<Point> y = x;
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += dt * v[i];
    return y;
  }

  // Classical Runge-Kutta.
  void convect(double dt) {
    const auto a = velocity(x_), b = velocity(ahead(x_, dt / 2, a)), c = velocity(ahead(x_, dt / 2, b)),
               d = velocity(ahead(x_, dt, c));
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += dt / 6 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }

  // Half cotangents of the angles opposite to each side, and the areas of the Voronoi cells made of them.
  void weigh_pairs() {
    pairs_.clear();
    area_.assign(x_.size(), 0.0);
    for (const auto& t : triangles_)
      for (int k = 0; k < 3; ++k) {
        const int i = t[k], j = t[(k + 1) % 3];
        const Point u = x_[i] - x_[t[(k + 2) % 3]], v = x_[j] - x_[t[(k + 2) % 3]];
        pairs_.push_back({i, j, dot(u, v) / (2 * cross(u, v))});
        for (const int end : {i, j})
          area_[end] += dot(x_[i] - x_[j], x_[i] - x_[j]) * pairs_.back().half_cot / 4;
      }
    join_pairs();
  }

  // One entry for each two neighbours, none with the border.
  void join_pairs() {
    std::erase_if(pairs_, [&](const Pair& p) { return on_border_[p.i] || on_border_[p.j]; });
    for (auto& p : pairs_)
      if (p.i > p.j) std::swap(p.i, p.j);
    std::ranges::sort(pairs_, {}, [](const Pair& p) { return Edge{p.i, p.j}; });
    std::vector<Pair> joined;
    for (const auto& p : pairs_) {
      if (!joined.empty() && joined.back().i == p.i && joined.back().j == p.j)
        joined.back().half_cot += p.half_cot;
      else
        joined.push_back(p);
    }
    pairs_.swap(joined);
    for (const auto& p : pairs_) smallest_weight_ = std::min(smallest_weight_, p.half_cot);
  }

  // In as many parts as no vortex may give more than half of what it has in one.
  void diffuse(double dt) {
    std::vector<double> rate(x_.size(), 0.0);
    for (const auto& [i, j, weight] : pairs_) {
      rate[i] += viscosity * weight / area_[i];
      rate[j] += viscosity * weight / area_[j];
    }
    const int parts = 1 + static_cast<int>(2 * dt * *std::ranges::max_element(rate));
    for (int n = 0; n < parts; ++n) pass_on(dt / parts);
  }

  void pass_on(double dt) {
    std::vector<double> gained(x_.size(), 0.0);
    for (const auto& [i, j, weight] : pairs_) {
      const double passed = dt * viscosity * weight * (strength_[j] / area_[j] - strength_[i] / area_[i]);
      gained[i] += passed;
      gained[j] -= passed;
    }
    for (std::size_t v = 0; v < x_.size(); ++v) strength_[v] += gained[v];
  }

  Stepper stepper_;
  std::vector<Triangle> triangles_;  // ours, kept up by what changed
  std::vector<ChangedPatch> changed_;
  std::vector<char> on_border_;
  std::vector<Point> x_;
  std::vector<double> strength_;  // circulation
  std::vector<double> area_;
  std::vector<Pair> pairs_;
  double smallest_weight_ = HUGE_VAL;
};

}  // namespace

int main() {
  Vortices vortices(make_disk(1200));
  const double impulse = vortices.impulse(), dt = 0.3;
  constexpr int steps = 30;
  bool is_delaunay = true;
  for (int n = 0; n < steps; ++n) {
    vortices.step(dt);
    is_delaunay = is_delaunay && vortices.has_delaunay_neighbours();
  }
  const double grown = vortices.impulse() - impulse, expected = 4 * viscosity * circulation * steps * dt;
  const double lost = vortices.total() - circulation;
  std::printf("%d steps, %d regions, %d flips; the neighbours are%s Delaunay's\n", steps, vortices.regions,
              vortices.flips, is_delaunay ? "" : " not");
  std::printf("smallest weight %.1e, circulation off by %.1e\n", vortices.smallest_weight(), lost);
  std::printf("angular impulse grew by %.6f, by 4 nu t it would be %.6f\n", grown, expected);
  const bool is_right = std::abs(grown / expected - 1) < 0.02 && std::abs(lost) < 1e-12;
  return is_right && is_delaunay && vortices.regions > 0 && vortices.smallest_weight() > -1e-9 ? 0 : 1;
}
