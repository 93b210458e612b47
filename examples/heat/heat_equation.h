// The heat equation on a square with a turning body, by linear finite elements whose mesh is kinemesh's.
//
//   du/dt + v . grad u = laplace u + f,   v: the velocity of the body inside it, 0 outside
//
// The body's vertices move with it, the others rest, so that the left-hand side is the rate of a vertex's own
// value: BDF2 on the values at the vertices, wherever these are and whatever faces are between them. Values
// of vertices need no transfer when faces are replaced. Only between the body and the medium faces move
// otherwise than what is in them, with a velocity w in a medium at rest: there w . grad u is added to the
// right-hand side, extrapolated from the steps before (ALE).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "examples/heat/linear_solver.h"
#include "examples/heat/p1_matrices.h"
#include "examples/heat/turning_body.h"
#include "kinemesh/stepper.h"

namespace heat {

struct Problem {
  TurningBody shape;
  std::function<double(const Point& x, double t)> border;             // u there, and everywhere at time 0
  std::function<double(const Point& x, double t, int label)> source;  // f
};

class HeatEquation {
 public:
  HeatEquation(const Problem& problem, double h);
  HeatEquation(const HeatEquation&) = delete;  // the stepper's observer knows where it is
  HeatEquation& operator=(const HeatEquation&) = delete;

  // One step of length dt, always the same one. Throws std::runtime_error where the mesh cannot follow.
  void step(double dt);

  const std::vector<double>& u() const { return u_; }  // at the vertices
  const std::vector<Point>& x() const { return x_; }
  const P1Matrices& matrices() const { return matrices_; }
  const kinemesh::Stepper& stepper() const { return stepper_; }
  double error() const;  // L2 norm of u minus what `border` says, now

  long regions() const { return regions_; }
  long faces_replaced() const { return faces_replaced_; }
  int factorizations() const { return factorizations_; }

 private:
  void move(double t, double dt);
  std::vector<int> reshaped_faces() const;
  void number_unknowns();
  void factorize(double weight);
  std::vector<double> loads(double t) const;
  void add_drift(std::vector<double>& loads) const;
  double source_at(const Triangle& corners, double t, int label, int corner) const;

  Problem problem_;
  MeshData start_;
  std::vector<int> body_vertices_;
  std::vector<char> in_body_;  // per vertex
  kinemesh::Stepper stepper_;
  std::vector<FaceChange> changed_;  // in the last step
  P1Matrices matrices_;
  std::unique_ptr<LinearSolver> solver_;
  std::vector<Point> x_;
  std::vector<double> u_, u_before_;
  std::vector<int> labels_;   // per face
  std::vector<int> unknown_;  // per vertex: its number, or none on the border
  int n_unknowns_ = 0;
  double time_ = 0.0, factorized_for_ = 0.0;
  long regions_ = 0, faces_replaced_ = 0;
  int factorizations_ = 0;
};

}  // namespace heat
