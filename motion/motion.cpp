#include "motion/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/measure.h"
#include "core/parallel.h"
#include "motion/noise_cut.h"

namespace kinemesh {
namespace {

constexpr int grain = 4096;  // vertices that are worth a task

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

// Adding 0 would turn -0 into +0.
double moved(double x, double way) {
  return way == 0.0 ? x : x + way;
}
Point moved(const Point& x, const Point& way) {
  return {moved(x.x, way.x), moved(x.y, way.y)};
}

std::string text(const Point& p) {
  return fmt::format("({}, {})", p.x, p.y);
}

// A marker that a term names is moving unless `border` says otherwise.
BorderConditions completed(const Mesh& mesh, BorderConditions border, const std::vector<MotionTerm>& terms) {
  const auto& names = mesh.marker_names();
  for (const auto& term : terms)
    if (const auto* on = std::get_if<OnMarker>(&term.where.on))
      if (std::find(names.begin(), names.end(), on->name) != names.end())  // or weights() refuses it
        border.by_marker.emplace(on->name, BorderCondition::Moving);
  return border;
}

std::vector<double> weights_of_term(const Mesh& mesh, const std::vector<MotionTerm>& terms, std::size_t i) {
  try {
    return weights(mesh, terms[i].where);
  } catch (const ParameterError& error) {
    throw ParameterError(fmt::format("motion.{}.{}", i, error.key()), error.what());
  }
}

}  // namespace

Motion::Motion(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border,
               Integrator integrator)
    : freedom_(mesh, completed(mesh, std::move(border), terms)),
      integrator_(integrator),
      initial_(mesh.positions().begin(), mesh.positions().end()),
      user_vertex_(mesh.n_vertices()),
      constrained_vertex_(mesh.n_vertices()),
      spacing_(mean_spacing(mesh)) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto add = [&](auto& all, const auto& field) {
      all.push_back({field, weights_of_term(mesh, terms, i)});
    };
    if (const auto* v = std::get_if<0>(&terms[i].field)) add(velocities_, *v);
    if (const auto* d = std::get_if<1>(&terms[i].field)) add(displacements_, *d);
    if (const auto* n = std::get_if<2>(&terms[i].field)) add(noises_, *n);
  }
  for (const Constraint& c : mesh.constraints()) constrained_.push_back({c.from, c.to});
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    user_vertex_[v] = mesh.user_vertex(v);
    constrained_vertex_[v] = mesh.is_constrained(v);
  }
}

void Motion::advance(std::span<const Point> x0, double t, double dt, std::uint64_t step,
                     std::span<Point> x1) const {
  const int n = static_cast<int>(x0.size());
  if (noises_.empty()) {
    parallel_parts(n, grain, [&](int, int begin, int end) {
      for (int v = begin; v < end; ++v) x1[v] = moved(x0[v], smooth_way(v, x0[v], t, dt));
    });
    return;
  }
  const NoiseCut cut(x0, constrained_, fill_noise(dt, step, x1), 1e-3 * spacing_);
  parallel_parts(n, grain, [&](int, int begin, int end) {
    for (int v = begin; v < end; ++v) x1[v] = moved(x0[v], smooth_way(v, x0[v], t, dt) + cut(x0[v], x1[v]));
  });
}

Point Motion::smooth_way(int vertex, const Point& x0, double t, double dt) const {
  if (freedom_.of(vertex) == BorderCondition::Fixed) return {0.0, 0.0};
  Point way = freedom_.allowed(vertex, displacement(vertex, t, dt));
  if (acts(velocities_, vertex))
    way += integrate(
        integrator_, [&](const Point& x, double s) { return velocity(vertex, x, s); }, x0, t, dt);
  return way;
}

Point Motion::velocity(int vertex, const Point& x, double t) const {
  Point sum(0.0, 0.0);
  for (const auto& term : velocities_)
    if (const double w = term.weight(vertex); w != 0.0) sum += w * term.field->velocity(x, t);
  return freedom_.allowed(vertex, sum);
}

Point Motion::displacement(int vertex, double t, double dt) const {
  const Point& initial = initial_[vertex];
  Point sum(0.0, 0.0);
  for (const auto& term : displacements_)
    if (const double w = term.weight(vertex); w != 0.0)
      sum += w * (term.field->displacement(initial, t + dt) - term.field->displacement(initial, t));
  return sum;
}

Point Motion::noise(int vertex, std::uint64_t step, double dt) const {
  Point sum(0.0, 0.0);
  if (constrained_vertex_[vertex] || freedom_.of(vertex) != BorderCondition::Moving) return sum;
  for (const auto& term : noises_)
    if (const double w = term.weight(vertex); w != 0.0)
      sum += w * term.field->kick(static_cast<std::uint64_t>(user_vertex_[vertex]), step, dt, spacing_);
  return sum;
}

double Motion::fill_noise(double dt, std::uint64_t step, std::span<Point> noises) const {
  std::array<double, most_parts> longest{};
  parallel_parts(static_cast<int>(noises.size()), grain, [&](int part, int begin, int end) {
    for (int v = begin; v < end; ++v) {
      noises[v] = noise(v, step, dt);
      longest[part] = std::max(longest[part], glm::length(noises[v]));
    }
  });
  return *std::max_element(longest.begin(), longest.end());
}

std::string Motion::describe_non_finite(int vertex, std::span<const Point> x0, double t, double dt,
                                        std::uint64_t step) const {
  const std::string place = fmt::format("at {}, time {}", text(x0[vertex]), t);
  const auto blame = [&](const auto& field, const Point& value) {
    return fmt::format("field \"{}\" gives {} {}", field->name(), text(value), place);
  };
  for (const auto& term : velocities_) {
    if (term.weight(vertex) == 0.0) continue;
    const auto v = [&](const Point& x, double s) { return term.field->velocity(x, s); };
    for (const Point& value : {v(x0[vertex], t), integrate(integrator_, v, x0[vertex], t, dt)})
      if (!is_finite(value)) return blame(term.field, value);
  }
  for (const auto& term : displacements_)
    for (const double s : {t, t + dt})
      if (const Point d = term.field->displacement(initial_[vertex], s);
          term.weight(vertex) != 0.0 && !is_finite(d))
        return blame(term.field, d);
  for (const auto& term : noises_)
    if (const Point kick = term.field->kick(user_vertex_[vertex], step, dt, spacing_);
        term.weight(vertex) != 0.0 && !is_finite(kick))
      return blame(term.field, kick);
  return "the motions add up to it " + place;
}

}  // namespace kinemesh
