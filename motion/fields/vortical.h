// Vortices: point vortices, and such that live in a box. On the unit square they are as published; a box of
// another size maps to it, and velocities grow with the box, so that the same times give the same motion
// relative to the box.
#pragma once

#include <vector>

#include "kinemesh/field.h"

namespace kinemesh {

struct VortexBox {
  Point center{0.5, 0.5};
  Point size{1.0, 1.0};  // width and height, > 0

  Point to_unit(const Point& x) const { return (x - center) / size + 0.5; }  // the box becomes [0,1]^2
  Point to_user(const Point& velocity) const { return velocity * size; }
};

// LeVeque's swirl: u = -sin^2(pi x) sin(2 pi y) cos(pi t/T), v = sin^2(pi y) sin(2 pi x) cos(pi t/T) [LeVeque
// 1996, §9.5]. Free of divergence, 0 on the box's border and outside; stretches up to t = T/2, is back at t =
// T.
class Swirl final : public VelocityField {
 public:
  Swirl(const VortexBox& box, double period) : box_(box), period_(period) {}  // period T > 0
  std::string_view name() const override { return "swirl"; }
  Point velocity(const Point& x, double t) const override;

 private:
  VortexBox box_;
  double period_;
};

// Taylor and Green's vortex without viscosity: u = sin(pi x) cos(pi y), v = -cos(pi x) sin(pi y) [Taylor
// 1937, §2]. Free of divergence, steady; tangential on the box's border, and periodic beyond it.
class TaylorGreen final : public VelocityField {
 public:
  explicit TaylorGreen(const VortexBox& box) : box_(box) {}
  std::string_view name() const override { return "taylor-green"; }
  Point velocity(const Point& x, double t) const override;

 private:
  VortexBox box_;
};

// Gresho's vortex, counter-clockwise about the centre: speed 5r for r <= 0.2, 2 - 5r for r <= 0.4, 0 beyond
// [Gresho 1990]. Free of divergence, steady, with kinks in the speed.
class Gresho final : public VelocityField {
 public:
  explicit Gresho(const VortexBox& box) : box_(box) {}
  std::string_view name() const override { return "gresho"; }
  Point velocity(const Point& x, double t) const override;

 private:
  VortexBox box_;
};

// Twisting rotation: v = rate d cos(pi t/T) (-Y, X) half box sizes, d = [(1 - X^2)(1 - Y^2)]^2, where X, Y
// run from -1 to 1 across the box; 0 outside. The centre turns by rate T/pi up to t = T/2, the border stays,
// and all is back at t = T.
class Twist final : public VelocityField {
 public:
  Twist(const VortexBox& box, double rate, double period) : box_(box), rate_(rate), period_(period) {}
  std::string_view name() const override { return "twist"; }
  Point velocity(const Point& x, double t) const override;

 private:
  VortexBox box_;
  double rate_;    // radians per time, at the centre and t = 0
  double period_;  // T > 0
};

// Point vortices that stay where they are, smoothed by a core: v = sum of s_i / (2 pi) (-(y - y_i), x - x_i)
// / (|x - p_i|^2 + core^2) [Krasny 1987]. Counter-clockwise for s > 0; fastest, s / (4 pi core), at the
// distance `core`; that of s / (2 pi r) far away. Free of divergence, steady.
class PointVortices final : public VelocityField {
 public:
  // strengths: circulations, length^2 per time; core: length, > 0. Pre: points and strengths are as many.
  PointVortices(std::vector<Point> points, std::vector<double> strengths, double core)
      : points_(std::move(points)), strengths_(std::move(strengths)), core_(core) {}
  std::string_view name() const override { return "vortices"; }
  Point velocity(const Point& x, double t) const override;  // O(number of vortices)

 private:
  std::vector<Point> points_;
  std::vector<double> strengths_;
  double core_;
};

}  // namespace kinemesh
