// Time stepping: move every vertex, find what tangled, repair it, and tell what was touched.
//
//   kinemesh::Stepper stepper(kinemesh::build_mesh(data));
//   while (...) {
//     auto outcome = stepper.step(my_new_positions, dt);  // in the user's order; or stepper.step(motion, dt)
//     if (!outcome) return report(outcome.message());
//     use(stepper.mesh().domain(), outcome.record);
//   }
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/detail/vertex_freedom.h"
#include "kinemesh/interior.h"
#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"
#include "kinemesh/step_changes.h"
#include "kinemesh/strategy.h"

// A detail.
namespace kinemesh {
struct FollowingState;  // motion/following.h
}  // namespace kinemesh

#pragma GCC visibility push(default)
namespace kinemesh {

struct StepperOptions {
  std::string strategy = "global";  // a name make_strategy knows
  bool allow_escaped = false;       // see RepairOptions
  bool retain = false;              // see RepairOptions
  std::string quality = "none";     // a name make_quality knows
  double angle = 25.0;              // see AngleOptions; of quality "angles", as is
  VertexFreedom freedom = {};       // by the mesh's numbers
  // Above it, the faces of the step's regions over all faces, both with padding, refuse the step. A limit
  // that is finite takes memory for the whole mesh, as observers do.
  double max_region_share = std::numeric_limits<double>::infinity();
  InteriorOptions interior = {};  // of step_border; a Motion brings its own
};

// What one step did; the columns of steps.csv.
struct StepRecord {
  int step = 0;       // its number, from 1
  double time = 0.0;  // at its end
  double dt = 0.0;
  int vertices = 0, faces = 0;  // of the domain
  RepairRecord repair;          // padding included
  double min_angle_deg = 0.0;   // of the domain's faces after the step
  double min_area = 0.0;
  double move_ms = 0.0, total_ms = 0.0;  // move: without the interior
  double interior_ms = 0.0;              // to let it follow the border
  double measure_ms = 0.0;               // of the total, to find the angle and area above; not in steps.csv
  bool accepted = false;
};

// Why a step with a valid mesh was refused.
struct RegionsTooLarge {
  double share = 0.0, limit = 0.0;  // see StepperOptions::max_region_share
};

// Why a step was refused.
enum class Refusal { None, NoValidMesh, RegionsTooLarge };

// A step is a transaction: accepted, the mesh is valid at the new positions; otherwise mesh, positions and
// time are bit for bit what they were, and one of the two says why: too_large only where max_region_share was
// given.
struct StepOutcome {
  StepRecord record;
  std::optional<Defect> defect;
  std::optional<RegionsTooLarge> too_large = std::nullopt;

  explicit operator bool() const { return !defect && !too_large; }

  Refusal reason() const {
    return defect ? Refusal::NoValidMesh : too_large ? Refusal::RegionsTooLarge : Refusal::None;
  }
  std::string message() const;  // the reason in one sentence; empty if the step was accepted
};

class Stepper {
 public:
  // Pre: the mesh is valid (validate(mesh) finds nothing). Throws InputError for an unknown strategy or
  // quality, and for what "angles" refuses.
  // time, steps_done: of an earlier stepper whose work this one goes on with. The first takes the mesh's
  // memory where it can.
  explicit Stepper(Mesh&& mesh, const StepperOptions& options = {}, double time = 0.0, int steps_done = 0);
  explicit Stepper(const Mesh& mesh, const StepperOptions& options = {}, double time = 0.0,
                   int steps_done = 0)
      : Stepper(Mesh(mesh), options, time, steps_done) {}
  ~Stepper();
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;

  // To given positions, one per user's vertex in the user's order; with quality "smooth" or "angles" or
  // strategy "optimize" vertices may be elsewhere afterwards. Throws InputError for another number of them or
  // a dt that is negative or not finite; mesh and time are then as they were, as after any other exception.
  [[nodiscard]] StepOutcome step(std::span<const Point> positions, double dt);

  // By a motion from time() to time() + dt; `motion` was built on this stepper's initial mesh.
  [[nodiscard]] StepOutcome step(const Motion& motion, double dt);

  // Likewise, and set time() to end_time exactly.
  [[nodiscard]] StepOutcome step_to(const Motion& motion, double end_time);
  [[nodiscard]] StepOutcome step_to(std::span<const Point> positions, double end_time);

  // To given positions of the border, or of some of it, one for each of `vertices` (the user's numbers); what
  // of the border is not named stays, and so do fixed vertices that are not named; the interior follows
  // (options.interior). Vertices of the interior may be named, too, and are then where they are asked to be,
  // whatever the quality. Throws InputError for numbers that are no vertex's or come twice, other counts, and
  // an interior that is told to follow nothing.
  [[nodiscard]] StepOutcome step_border(std::span<const UserVertex> vertices,
                                        std::span<const Point> positions, double dt);
  [[nodiscard]] StepOutcome step_border_to(std::span<const UserVertex> vertices,
                                           std::span<const Point> positions, double end_time);

  // Where a motion would have the vertices go, in the mesh's numbering: what step_to repairs.
  std::vector<Point> moved(const Motion& motion, double end_time);

  // What the interior's next step starts from, for checkpoints; to be given to a stepper that goes on before
  // its first step.
  FollowingState following_state() const;
  void set_following_state(FollowingState state);

  // For whoever lets the stepper hold the positions: one per user's vertex in the user's order, to be moved
  // in place and then repaired, as a step of length dt. After any step that returns they are those of the
  // mesh, so that after a refused one the move is taken back.
  std::span<Point> positions();
  [[nodiscard]] StepOutcome repair(double dt = 0.0);

  // From now on called within each step that can be accepted, in the order of registration
  // (kinemesh/step_changes.h). The first one takes memory for the whole mesh; what a step adds to its cost
  // follows what it changes.
  void observe(StepObserver observer);

  const Mesh& mesh() const;
  double time() const;
  int steps_done() const;
  const Strategy& strategy() const;

  // Faces of the mesh, padding included, that flips of the last accepted step rewrote after its repair, each
  // once; of no meaning after a step that an observer has vetoed.
  std::span<const Face> flipped_faces() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinemesh
#pragma GCC visibility pop
