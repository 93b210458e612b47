// Fields that are linear in the position, and discs that turn as a whole.
#pragma once

#include "kinemesh/field.h"

namespace kinemesh {

// v = rate (-(y - cy), x - cx): the plane turns rigidly about `center`, counter-clockwise for rate > 0.
class Rotation : public VelocityField, public RigidPath {
 public:
  Rotation(const Point& center, double rate) : center_(center), rate_(rate) {}  // rate: radians per time
  std::string_view name() const override { return "rotation"; }
  Point velocity(const Point& x, double t) const override;
  Pose pose(double t) const override { return {.angle = static_cast<long double>(rate_) * t}; }
  std::optional<Point> center() const override { return center_; }

 private:
  Point center_;
  double rate_;
};

// Zalesak's rotation: u = (2 pi / period) (1/2 - y), v = (2 pi / period) (x - 1/2), one turn of the unit
// square about its centre per period; period 628 on his grid of 100 x 100 [Zalesak 1979].
class ZalesakRotation final : public Rotation {
 public:
  explicit ZalesakRotation(double period);  // > 0
  std::string_view name() const override { return "zalesak"; }
};

// v = velocity, everywhere and always.
class Translation final : public VelocityField, public RigidPath {
 public:
  explicit Translation(const Point& velocity) : velocity_(velocity) {}
  std::string_view name() const override { return "translate"; }
  Point velocity(const Point& x, double t) const override;
  Pose pose(double t) const override {
    return {.x = static_cast<long double>(velocity_.x) * t, .y = static_cast<long double>(velocity_.y) * t};
  }
  std::optional<Point> center() const override { return std::nullopt; }

 private:
  Point velocity_;
};

// Plane Couette flow: u = rate (y - cy), v = 0. Every integrator is exact.
class Shear final : public VelocityField {
 public:
  Shear(const Point& center, double rate) : center_(center), rate_(rate) {}  // rate: 1 per time
  std::string_view name() const override { return "shear"; }
  Point velocity(const Point& x, double t) const override;

 private:
  Point center_;
  double rate_;
};

// A rigid disc turning in a still mesh: d = (R(rate t) - 1)(X - c) where |X - c| <= radius, 0 elsewhere. The
// mesh slips along the disc's rim, and tangles there in every step. A displacement, not a velocity: the
// stages of an integrator would step over the rim and leave the outermost vertices of the disc behind.
class Rotor final : public DisplacementField {
 public:
  Rotor(const Point& center, double radius, double rate) : center_(center), radius_(radius), rate_(rate) {}
  std::string_view name() const override { return "rotor"; }
  Point displacement(const Point& initial, double t) const override;

 private:
  Point center_;
  double radius_;  // length
  double rate_;    // radians per time, counter-clockwise
};

// (R(angle) - 1) r, without cancellation for small angles: cos(a) - 1 = -2 sin^2(a/2).
Point turned_minus_self(const Point& r, double angle);

}  // namespace kinemesh
