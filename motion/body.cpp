#include "motion/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/fields/recorded.h"
#include "motion/integrator.h"
#include "motion/restriction.h"

namespace kinemesh {
namespace {

[[noreturn]] void refuse(const std::string& body, const std::string& key, const std::string& why) {
  throw ParameterError(key, "body " + body + ": " + why);
}

// Several names in quotes, so that a sentence can go on after them.
std::string joined(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front() : fmt::format("\"{}\"", fmt::join(names, ", "));
}

// Those that the part names have weight 1, others 0.
std::vector<Vertex> vertices_of(const Mesh& mesh, const std::vector<std::string>& on) {
  std::vector<char> is_named(mesh.n_vertices(), 0);
  for (const std::string& part : on) {
    if (part == "marker:" || (!part.starts_with("marker:") && !part.starts_with("label:")))
      throw ParameterError("on", "a body: on = \"" + part + "\", expected marker:NAME or label:N");
    const auto named = weights(mesh, parse_restriction(part));
    for (const Vertex v : mesh.vertices()) is_named[v] |= named[v] != 0.0;
  }
  std::vector<Vertex> vertices;
  for (const Vertex v : mesh.vertices())
    if (is_named[v]) vertices.push_back(v);
  return vertices;
}

std::vector<std::string> markers_of(const std::vector<std::string>& on) {
  std::vector<std::string> markers;
  for (const std::string& part : on)
    if (const auto restriction = parse_restriction(part);
        const auto* marker = std::get_if<OnMarker>(&restriction.on))
      markers.push_back(marker->name);
  return markers;
}

// As a rigid path, if it is one.
template <class Field>
std::shared_ptr<const RigidPath> path_of(const std::shared_ptr<const Field>& field) {
  return std::dynamic_pointer_cast<const RigidPath>(field);
}

}  // namespace

Body::Body(const Mesh& initial, const BodySpec& spec) : name_(joined(spec.on)) {
  if (spec.on.empty()) throw ParameterError("on", "a body: marker:NAME or label:N expected");
  vertices_ = vertices_of(initial, spec.on);
  markers_ = markers_of(spec.on);
  std::optional<Point> center;
  const auto add_path = [&](std::shared_ptr<const RigidPath> path) {
    if (const auto own = path->center()) {
      if (center && *center != *own)
        refuse(name_, "motion",
               fmt::format("turns about two centres, ({}, {}) and ({}, {}); one expected", center->x,
                           center->y, own->x, own->y));
      center = own;
    }
    paths_.push_back(std::move(path));
  };
  for (const AnyField& field : spec.motion) {
    if (std::holds_alternative<std::shared_ptr<const NoiseField>>(field))
      refuse(name_, "motion", "field \"" + std::string(name_of(field)) + "\" is noise, and a body has none");
    if (const auto* velocity = std::get_if<std::shared_ptr<const VelocityField>>(&field)) {
      if (auto path = path_of(*velocity))
        add_path(std::move(path));
      else
        velocities_.push_back(*velocity);
    }
    if (const auto* displacement = std::get_if<std::shared_ptr<const DisplacementField>>(&field)) {
      if (auto path = path_of(*displacement))
        add_path(std::move(path));
      else
        displacements_.push_back(*displacement);
    }
  }
  center_ = center.value_or(Point(0.0, 0.0));
}

Body::Placement Body::placement(double t) const {
  Placement at;
  for (const auto& path : paths_) at.pose = at.pose + (path->pose(t) - path->pose(0.0));
  if (at.pose.angle != 0.0L) {
    at.cos = std::cos(at.pose.angle);
    at.sin = std::sin(at.pose.angle);
  }
  return at;
}

// Without a turn nothing is subtracted and added again: at the start x is X, bit by bit.
Point Body::place(const Placement& at, const Point& initial, double t) const {
  long double x = initial.x, y = initial.y;
  if (at.pose.angle != 0.0L) {
    const long double rx = x - center_.x, ry = y - center_.y;
    x = center_.x + (at.cos * rx - at.sin * ry);
    y = center_.y + (at.sin * rx + at.cos * ry);
  }
  x += at.pose.x;
  y += at.pose.y;
  for (const auto& field : displacements_) {
    const Point now = field->displacement(initial, t), start = field->displacement(initial, 0.0);
    x += static_cast<long double>(now.x) - start.x;
    y += static_cast<long double>(now.y) - start.y;
  }
  return {static_cast<double>(x), static_cast<double>(y)};
}

Point Body::integrated(const Point& x0, double t0, double dt, Integrator integrator) const {
  const auto velocity = [&](const Point& x, double t) {
    Point sum(0.0, 0.0);
    for (const auto& field : velocities_) sum += field->velocity(x, t);
    return sum;
  };
  return integrate(integrator, velocity, x0, t0, dt);
}

void Body::move(std::span<const Point> initial, std::span<const Point> x0, double t0, double t1, double dt,
                Integrator integrator, std::span<Point> x1) const {
  const Placement before = placement(t0), after = placement(t1);
  for (const Vertex v : vertices_) {
    x1[v] = place(after, initial[v], t1);
    if (!is_exact())
      x1[v] = x0[v] + (x1[v] - place(before, initial[v], t0)) + integrated(x0[v], t0, dt, integrator);
  }
}

std::string Body::culprit(const Point& initial, const Point& x0, double t0, double t1, double dt,
                          Integrator integrator) const {
  for (const auto& field : displacements_)
    if (!is_finite(field->displacement(initial, t1))) return std::string(field->name());
  for (const auto& field : velocities_) {
    const auto velocity = [&](const Point& x, double t) { return field->velocity(x, t); };
    if (!is_finite(integrate(integrator, velocity, x0, t0, dt))) return std::string(field->name());
  }
  return "its path";
}

}  // namespace kinemesh
