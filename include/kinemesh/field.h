// Where vertices want to go: pure functions of position and time, or of vertex and step for noise.
//
// A field owns no time, no mesh and no integrator; kinemesh/motion.h puts them together. Derive from one of
// the three to add a field, and register it (kinemesh/registry.h) to use it by name. Fields are immutable:
// every const member may be called from several threads at once. Lengths and times are the user's units,
// angles are radians.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

#include "kinemesh/types.h"

namespace kinemesh {

// v(x, t), integrated in time (motion/integrator.h).
class VelocityField {
 public:
  virtual ~VelocityField() = default;
  virtual std::string_view name() const = 0;                   // as in the registry; for messages
  virtual Point velocity(const Point& x, double t) const = 0;  // length per time
};

// d(X, t) from the initial position X, exact in time: a step adds d(X, t + dt) - d(X, t), so that d(X, 0)
// need not be 0.
class DisplacementField {
 public:
  virtual ~DisplacementField() = default;
  virtual std::string_view name() const = 0;
  virtual Point displacement(const Point& initial, double t) const = 0;  // length
};

// A random vector for one vertex in one step; the same for the same arguments, whoever asks and when.
class NoiseField {
 public:
  virtual ~NoiseField() = default;
  virtual std::string_view name() const = 0;

  // vertex: the user's number; step: number of the step, from 0; dt: its length; spacing: mean_spacing of the
  // initial mesh (kinemesh/measure.h).
  virtual Point kick(std::uint64_t vertex, std::uint64_t step, double dt, double spacing) const = 0;
};

using AnyField = std::variant<std::shared_ptr<const VelocityField>, std::shared_ptr<const DisplacementField>,
                              std::shared_ptr<const NoiseField>>;

inline std::string_view name_of(const AnyField& field) {
  return std::visit([](const auto& f) { return f->name(); }, field);
}

}  // namespace kinemesh
