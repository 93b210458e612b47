// Bodies: borders and solid parts that move exactly as told.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinemesh/field.h"
#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"

namespace kinemesh {

// x(t) = c + R(angle)(X - c) + shift + displacements, a function of the initial position X and the time
// alone: what the fields say at t, less what they say at 0. Fields with a pose (kinemesh/field.h) add up
// to angle and shift; they turn about one centre, which travels with the body. Rounded once, from more digits
// than a double has, so that a border is exact after any number of steps, and the same bits whatever their
// length. Other velocity fields are integrated at its vertices, and then "exact" does not apply.
class Body {
 public:
  // initial: the mesh at the start of the run. Throws ParameterError: key "on" for a name the mesh does not
  // have or no part at all, "motion" for noise, two centres, or a record that does not hold the body's
  // vertices.
  Body(const Mesh& initial, const BodySpec& spec);

  const std::string& name() const { return name_; }                  // its parts; several in quotes
  std::span<const std::string> markers() const { return markers_; }  // that it names
  std::span<const Vertex> vertices() const { return vertices_; }     // the mesh's numbers, ascending
  bool is_exact() const { return velocities_.empty(); }

  // Where its vertices go in a step from t0 to t1, dt long: x1 of each is written, x0 read where it is not
  // exact.
  void move(std::span<const Point> initial, std::span<const Point> x0, double t0, double t1, double dt,
            Integrator integrator, std::span<Point> x1) const;

  // Who made the vertex non-finite at t1: the field's name.
  std::string culprit(const Point& initial, const Point& x0, double t0, double t1, double dt,
                      Integrator integrator) const;

 private:
  struct Placement {  // at one time
    long double cos = 1.0L, sin = 0.0L;
    Pose pose;
  };
  Placement placement(double t) const;
  Point place(const Placement& at, const Point& initial, double t) const;
  Point integrated(const Point& x0, double t0, double dt, Integrator integrator) const;

  std::string name_;
  std::vector<std::string> markers_;
  std::vector<Vertex> vertices_;
  Point center_{0.0, 0.0};
  std::vector<std::shared_ptr<const RigidPath>> paths_;
  std::vector<std::shared_ptr<const DisplacementField>> displacements_;
  std::vector<std::shared_ptr<const VelocityField>> velocities_;
};

}  // namespace kinemesh
