// Rigid oscillation: harmonic pitching and plunging, exact at every time.
#pragma once

#include "kinemesh/field.h"

namespace kinemesh {

// Turns about `center` by alpha(t) = amplitude sin(omega t), counter-clockwise where positive.
class Pitch final : public DisplacementField, public RigidPath {
 public:
  // amplitude: radians; omega: radians per time.
  Pitch(const Point& center, double amplitude, double omega)
      : center_(center), amplitude_(amplitude), omega_(omega) {}
  std::string_view name() const override { return "pitch"; }
  Point displacement(const Point& initial, double t) const override;
  Pose pose(double t) const override;
  std::optional<Point> center() const override { return center_; }

 private:
  Point center_;
  double amplitude_, omega_;
};

// Moves along `direction` by amplitude sin(omega t).
class Plunge final : public DisplacementField, public RigidPath {
 public:
  // direction: any length but 0, only where it points counts; amplitude: length; omega: radians per time.
  Plunge(const Point& direction, double amplitude, double omega);
  std::string_view name() const override { return "plunge"; }
  Point displacement(const Point& initial, double t) const override;
  Pose pose(double t) const override;
  std::optional<Point> center() const override { return std::nullopt; }

 private:
  Point reach_;  // unit direction times amplitude
  double omega_;
};

}  // namespace kinemesh
