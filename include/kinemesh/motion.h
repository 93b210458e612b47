// The motion of a mesh: fields, where they act, what the border does, and how it is integrated in time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/body.h"
#include "kinemesh/field.h"
#include "kinemesh/mesh.h"
#include "motion/border.h"
#include "motion/integrator.h"
#include "motion/interior/interior.h"
#include "motion/restriction.h"

namespace kinemesh {

struct MotionTerm {
  AnyField field;
  Restriction where = {};
  std::vector<Restriction> also = {};  // more parts it acts on; a vertex in several of them moves once
};

// From t0 to t1, dt long: times of a run are not added up, so that t1 may be t0 + dt but for rounding.
struct TimeStep {
  double t0 = 0.0, t1 = 0.0, dt = 0.0;
  std::uint64_t number = 0;  // from 0; keys the noise
};

// Who moves a vertex:
//   a fixed vertex, nobody; a vertex of a body, its body; a vertex of a border that terms name by its marker,
//   these terms (of several markers the first that a term names counts); any other vertex, all terms that act
//   there.
class Motion {
 public:
  // mesh: as it is at the start of the whole run, also when a run is resumed: initial positions, weights and
  // spacing are taken from it. A marker that some term or body names is moving unless `border` says
  // otherwise. Throws ParameterError where terms, bodies or border do not fit the mesh; its key is
  // "motion.N.on" or "motion.N.blend", N the number of the term, "body.N.on" or "body.N.motion",
  // "interior.follow" where a term is blended although the interior follows, or a marker's name as in
  // Freedom.
  Motion(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border = {},
         Integrator integrator = Integrator::Rk4, const std::vector<BodySpec>& bodies = {},
         InteriorOptions interior = {.follow = Follow::None});

  // One step: x1 = x0 + d(X, t + dt) - d(X, t) + the integrated velocities + noise, each term by its weight
  // at the vertex. Velocities are summed and integrated together. Noise is cut to half the distance to the
  // nearest constrained edge at x0, and left out where it would bring the vertex nearer to one than a
  // thousandth of the spacing: alone it never leaves the domain. What has weight 0 and what does not
  // move keeps its position bit by bit. Bodies are where they say (kinemesh/body.h). Pre: x0 and x1 have the
  // mesh's number of vertices and do not overlap. In parallel (TBB); the same bits whatever the number of
  // threads. x1 may be non-finite: the caller checks. Throws InputError where bodies say different things of
  // a vertex they share, or a body would leave the line of a sliding border.
  //
  // Without what the interior does to follow the border: motion/following.h.
  void advance(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const;
  void advance(std::span<const Point> x0, double t, double dt, std::uint64_t step,
               std::span<Point> x1) const {
    advance(x0, {t, t + dt, dt, step}, x1);
  }

  // For whoever moves the interior: what of the step x0 -> x1 terms give that act on the interior, at every
  // vertex whoever owns it, without noise. Nothing, and false, where there are none.
  bool ways_inside(std::span<const Point> x0, const TimeStep& step, std::span<Point> ways) const;

  // Per vertex: whether its increment is known, or the interior's to find.
  std::span<const Role> roles() const { return roles_; }
  const Freedom& freedom() const { return freedom_; }
  const InteriorOptions& interior() const { return interior_; }

  // Who made the vertex non-finite in the step from x0: a clause that names field, value, place and time.
  std::string describe_non_finite(int vertex, std::span<const Point> x0, const TimeStep& step) const;

  double spacing() const { return spacing_; }
  std::span<const Point> initial_positions() const { return initial_; }
  std::span<const Body> bodies() const { return bodies_; }
  int body_of(int vertex) const {
    return owner_.empty() ? none : owner_[vertex];
  }                                                                 // number of its body, or none
  const std::vector<std::string>& notes() const { return notes_; }  // what a user may not expect

 private:
  template <class Field>
  struct Weighted {
    std::shared_ptr<const Field> field;
    std::vector<double> weights;  // empty: 1 everywhere
    std::vector<double> raw;      // as if it owned all it reaches; empty: as `weights`
    bool is_inside = false;       // acts on the interior
    double weight(int vertex) const { return weights.empty() ? 1.0 : weights[vertex]; }
    double raw_weight(int vertex) const { return raw.empty() ? weight(vertex) : raw[vertex]; }
  };

  template <class Field>
  static bool acts(const std::vector<Weighted<Field>>& terms, int vertex) {
    return std::any_of(terms.begin(), terms.end(),
                       [&](const auto& term) { return term.weight(vertex) != 0.0; });
  }
  void add_terms(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void own_vertices(const Mesh& mesh);
  void claim_borders(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void give_roles(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void put_on(const SlideLine& line, std::span<const Point> x0, std::span<Point> x1) const;
  void move_bodies(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const;
  Point velocity(int vertex, const Point& x, double t) const;
  Point displacement(int vertex, double t, double dt) const;
  Point noise(int vertex, std::uint64_t step, double dt) const;
  Point smooth_way(int vertex, const Point& x0, double t, double dt) const;
  Point way_inside(int vertex, const Point& x0, double t, double dt) const;
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
  double spacing_, diagonal_;
  std::vector<Body> bodies_;
  std::vector<int> owner_;                     // per vertex: its body, or none; empty without bodies
  std::vector<std::pair<int, int>> shared_;    // a vertex, and a body that has it, too, after its owner
  std::vector<std::pair<int, int>> cornered_;  // a corner of a sliding border, and a body that has it
  std::vector<int> claim_;            // per vertex of the border: number in claimed_, or none; empty without
  std::vector<std::string> claimed_;  // markers that terms name
  InteriorOptions interior_;
  std::vector<Role> roles_;  // empty where nothing follows
  std::vector<std::string> notes_;
};

}  // namespace kinemesh
