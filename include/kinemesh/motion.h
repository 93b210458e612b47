// The motion of a mesh: fields, where they act, what the border does, and how it is integrated in time.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemesh/field.h"
#include "kinemesh/interior.h"
#include "kinemesh/mesh.h"
#include "kinemesh/parameters.h"

// Details.
namespace kinemesh {
class Body;                      // motion/body.h
class Freedom;                   // motion/border.h
enum class Role : std::uint8_t;  // motion/interior/interior.h
}  // namespace kinemesh

#pragma GCC visibility push(default)
namespace kinemesh {

struct OnAll {};
struct OnMarker {  // the ends of the marker's edges
  std::string name;
};
struct OnLabel {  // the corners of the faces with that label
  int label;
};
struct OnDisc {  // |x - center| <= radius
  Point center;
  double radius;
};

// Fades the motion out over the distance to the marker's edges, to the border of the label's faces, or to the
// disc: 1 up to `full`, 1 - s^2 (3 - 2 s) between, s from 0 to 1, and 0 from `zero` on; 1 inside the label's
// faces and the disc.
struct Blend {
  double full, zero;  // lengths, 0 <= full < zero
};

struct Restriction {
  std::variant<OnAll, OnMarker, OnLabel, OnDisc> on = OnAll{};
  std::optional<Blend> blend;  // nothing: 1 there and 0 elsewhere
};

// on: "all", "marker:NAME", "label:N" or "disc:[x,y,r]"; blend: [full, zero]. Throws ParameterError with key
// "on" or "blend".
Restriction parse_restriction(std::string_view on, std::optional<std::array<double, 2>> blend = std::nullopt);

struct MotionTerm {
  AnyField field;
  Restriction where = {};
  std::vector<Restriction> also = {};  // more parts it acts on; a vertex in several of them moves once
};

// By strictness: of two conditions that meet in a vertex the later one holds.
enum class BorderCondition : std::uint8_t { Moving, Slide, Fixed };

struct BorderConditions {
  // For markers not named here and border edges without a marker.
  BorderCondition otherwise = BorderCondition::Fixed;
  std::map<std::string, BorderCondition> by_marker;  // inner lines, too, where named
};

// Order of convergence 1, 2 and 4 [Hairer 1993, §II.1].
enum class Integrator { Euler, Heun, Rk4 };

// A body: borders and solid parts that move exactly as told.
struct BodySpec {
  std::vector<std::string> on;  // "marker:NAME", "label:N" (a solid part with all its vertices); one at least
  std::vector<AnyField> motion;  // no noise; empty: it stays where it is
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
  // move keeps its position bit by bit. Bodies are where their fields say. Pre: x0 and x1 have the
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
  std::span<const Role> roles() const;
  const Freedom& freedom() const;
  const InteriorOptions& interior() const;

  // Who made the vertex non-finite in the step from x0: a clause that names field, value, place and time.
  std::string describe_non_finite(Vertex vertex, std::span<const Point> x0, const TimeStep& step) const;

  double spacing() const;  // mean_spacing at the start
  std::span<const Point> initial_positions() const;
  std::span<const Body> bodies() const;
  int body_of(Vertex vertex) const;               // number of its body, or none
  const std::vector<std::string>& notes() const;  // what a user may not expect

 private:
  class Parts;
  std::shared_ptr<const Parts> parts_;  // never changes
};

}  // namespace kinemesh
#pragma GCC visibility pop
