// The motion of a mesh: fields, where they act, what the border does, and how it is integrated in time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "motion/border.h"
#include "motion/field.h"
#include "motion/integrator.h"
#include "motion/restriction.h"

namespace kinemesh {

struct MotionTerm {
  AnyField field;
  Restriction where;
};

class Motion {
 public:
  // mesh: as it is at the start of the whole run, also when a run is resumed: initial positions, weights and
  // spacing are taken from it. A marker that some term names is moving unless `border` says otherwise.
  // Throws ParameterError where terms or border do not fit the mesh; its key is "motion.N.on" or
  // "motion.N.blend", N the number of the term, or a marker's name as in Freedom.
  Motion(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border = {},
         Integrator integrator = Integrator::Rk4);

  // One step: x1 = x0 + d(X, t + dt) - d(X, t) + the integrated velocities + noise, each term by its weight
  // at the vertex. Velocities are summed and integrated together. Noise is cut to half the distance to the
  // nearest constrained edge at x0, and left out where it would bring the vertex nearer to one than a
  // thousandth of the spacing: alone it never leaves the domain. What has weight 0 and what does not
  // move keeps its position bit by bit. Pre: x0 and x1 have the mesh's number of vertices and do not overlap.
  // step: from 0, it keys the noise. In parallel (TBB); the same bits whatever the number of threads. x1 may
  // be non-finite: the caller checks.
  void advance(std::span<const Point> x0, double t, double dt, std::uint64_t step, std::span<Point> x1) const;

  // Who made the vertex non-finite in the step from x0: a clause that names field, value, place and time.
  std::string describe_non_finite(int vertex, std::span<const Point> x0, double t, double dt,
                                  std::uint64_t step) const;

  double spacing() const { return spacing_; }
  std::span<const Point> initial_positions() const { return initial_; }

 private:
  template <class Field>
  struct Weighted {
    std::shared_ptr<const Field> field;
    std::vector<double> weights;  // empty: 1 everywhere
    double weight(int vertex) const { return weights.empty() ? 1.0 : weights[vertex]; }
  };

  template <class Field>
  static bool acts(const std::vector<Weighted<Field>>& terms, int vertex) {
    return std::any_of(terms.begin(), terms.end(),
                       [&](const auto& term) { return term.weight(vertex) != 0.0; });
  }
  Point velocity(int vertex, const Point& x, double t) const;
  Point displacement(int vertex, double t, double dt) const;
  Point noise(int vertex, std::uint64_t step, double dt) const;
  Point smooth_way(int vertex, const Point& x0, double t, double dt) const;
  double fill_noise(double dt, std::uint64_t step, std::span<Point> noises) const;  // returns the longest

  std::vector<Weighted<VelocityField>> velocities_;
  std::vector<Weighted<DisplacementField>> displacements_;
  std::vector<Weighted<NoiseField>> noises_;
  Freedom freedom_;
  Integrator integrator_;
  std::vector<Point> initial_;
  std::vector<int> user_vertex_;
  std::vector<char> constrained_vertex_;
  std::vector<Edge> constrained_;  // ends never change, whatever is repaired
  double spacing_;
};

}  // namespace kinemesh
