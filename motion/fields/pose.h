// Where a rigid body is: fields that move the plane as a whole say it exactly, whatever the length of a step.
#pragma once

#include <optional>

#include "kinemesh/types.h"

namespace kinemesh {

// x = c + R(angle)(X - c) + shift. More digits than a double has: a body's border is rounded once, at the
// end.
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

}  // namespace kinemesh
