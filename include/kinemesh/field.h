// Where vertices want to go: pure functions of position and time, or of vertex and step for noise.
//
// A field owns no time, no mesh and no integrator; kinemesh/motion.h puts them together. Derive from one of
// the three to add a field, and register it (kinemesh/registry.h) to use it by name. Fields are immutable:
// every const member may be called from several threads at once. Lengths and times are the user's units,
// angles are radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// v(x, t), integrated in time (motion/integrator.h).
class VelocityField {
 public:
  virtual ~VelocityField() = default;
  virtual std::string_view name() const = 0;                   // as in the registry; for messages
  virtual Point velocity(const Point& x, double t) const = 0;  // length per time

  // Of many points at one time; v: as many. The same bits as one by one.
  virtual void velocities(std::span<const Point> x, double t, std::span<Point> v) const {
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = velocity(x[i], t);
  }
};

// d(X, t) from the initial position X, exact in time: a step adds d(X, t + dt) - d(X, t), so that d(X, 0)
// need not be 0.
class DisplacementField {
 public:
  virtual ~DisplacementField() = default;
  virtual std::string_view name() const = 0;
  virtual Point displacement(const Point& initial, double t) const = 0;  // length

  // As velocities.
  virtual void displacements(std::span<const Point> initial, double t, std::span<Point> d) const {
    for (std::size_t i = 0; i < initial.size(); ++i) d[i] = displacement(initial[i], t);
  }
};

// A random vector for one vertex in one step; the same for the same arguments, whoever asks and when.
class NoiseField {
 public:
  virtual ~NoiseField() = default;
  virtual std::string_view name() const = 0;

  // vertex: the user's number; step: number of the step, from 0; dt: its length; spacing: mean_spacing of the
  // initial mesh (kinemesh/measure.h).
  virtual Point kick(std::uint64_t vertex, std::uint64_t step, double dt, double spacing) const = 0;

  // Likewise, of many vertices in one step.
  virtual void kicks(std::span<const std::uint64_t> vertices, std::uint64_t step, double dt, double spacing,
                     std::span<Point> ways) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) ways[i] = kick(vertices[i], step, dt, spacing);
  }
};

// Where a rigid body is, whatever the length of a step: x = c + R(angle)(X - c) + shift. More digits than a
// double has: a body's border is rounded once, at the end.
struct Pose {
  long double angle = 0.0L;  // radians, counter-clockwise
  long double x = 0.0L, y = 0.0L;

  Pose operator+(const Pose& other) const { return {angle + other.angle, x + other.x, y + other.y}; }
  Pose operator-(const Pose& other) const { return {angle - other.angle, x - other.x, y - other.y}; }
};

// What a VelocityField or DisplacementField derives from as well if it turns and shifts all points alike. The
// pose may be anything at t = 0: bodies take the difference.
class RigidPath {
 public:
  virtual ~RigidPath() = default;
  virtual Pose pose(double t) const = 0;
  virtual std::optional<Point> center() const = 0;  // of turning, at the start; nothing if it does not turn
};

using AnyField = std::variant<std::shared_ptr<const VelocityField>, std::shared_ptr<const DisplacementField>,
                              std::shared_ptr<const NoiseField>>;

inline std::string_view name_of(const AnyField& field) {
  return std::visit([](const auto& f) { return f->name(); }, field);
}

}  // namespace kinemesh
#pragma GCC visibility pop
