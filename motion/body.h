// A rigid body that oscillates: harmonic pitching and plunging, exact at every time.
#pragma once

#include "motion/field.h"

namespace kinemesh {

// Turns about `center` by alpha(t) = amplitude sin(omega t), counter-clockwise where positive.
class Pitch final : public DisplacementField {
 public:
  // amplitude: radians; omega: radians per time.
  Pitch(const Point& center, double amplitude, double omega)
      : center_(center), amplitude_(amplitude), omega_(omega) {}
  std::string_view name() const override { return "pitch"; }
  Point displacement(const Point& initial, double t) const override;

 private:
  Point center_;
  double amplitude_, omega_;
};

// Moves along `direction` by amplitude sin(omega t).
class Plunge final : public DisplacementField {
 public:
  // direction: any length but 0, only where it points counts; amplitude: length; omega: radians per time.
  Plunge(const Point& direction, double amplitude, double omega);
  std::string_view name() const override { return "plunge"; }
  Point displacement(const Point& initial, double t) const override;

 private:
  Point reach_;  // unit direction times amplitude
  double omega_;
};

}  // namespace kinemesh
