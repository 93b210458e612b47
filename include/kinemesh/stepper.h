// Time stepping: move every vertex, find what tangled, repair it, and tell what was touched.
//
//   kinemesh::Stepper stepper(kinemesh::build_mesh(data));
//   while (...) {
//     auto outcome = stepper.step(my_new_positions, dt);  // in the user's order; or stepper.step(motion, dt)
//     if (!outcome) return report(outcome.defect->message());
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
#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"
#include "kinemesh/step_changes.h"
#include "kinemesh/strategy.h"
#include "motion/following.h"
#include "sim/step/change_tracker.h"
#include "untangle/quality/quality_pass.h"

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

// A step is a transaction: accepted, the mesh is valid at the new positions; otherwise mesh, positions and
// time are bit for bit what they were, and one of the two says why: too_large only where max_region_share was
// given.
struct StepOutcome {
  StepRecord record;
  std::optional<Defect> defect;
  std::optional<RegionsTooLarge> too_large = std::nullopt;

  explicit operator bool() const { return !defect && !too_large; }
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
  [[nodiscard]] StepOutcome step_border(std::span<const int> vertices, std::span<const Point> positions,
                                        double dt);
  [[nodiscard]] StepOutcome step_border_to(std::span<const int> vertices, std::span<const Point> positions,
                                           double end_time);

  // Where a motion would have the vertices go, in the mesh's numbering: what step_to repairs.
  std::vector<Point> moved(const Motion& motion, double end_time);

  // What the interior's next step starts from, for checkpoints; to be given to a stepper that goes on before
  // its first step.
  FollowingState following_state() const { return following_ ? following_->state() : start_; }
  void set_following_state(FollowingState state) { start_ = std::move(state); }

  // For whoever lets the stepper hold the positions: one per user's vertex in the user's order, to be moved
  // in place and then repaired, as a step of length dt. After any step that returns they are those of the
  // mesh, so that after a refused one the move is taken back.
  std::span<Point> positions();
  [[nodiscard]] StepOutcome repair(double dt = 0.0);

  // From now on called within each step that can be accepted, in the order of registration
  // (kinemesh/step_changes.h). The first one takes memory for the whole mesh; what a step adds to its cost
  // follows what it changes.
  void observe(StepObserver observer);

  const Mesh& mesh() const { return mesh_; }
  double time() const { return time_; }
  int steps_done() const { return step_; }
  const Strategy& strategy() const { return *strategy_; }

  // Faces of the mesh, padding included, that flips of the last accepted step rewrote after its repair, each
  // once; of no meaning after a step that an observer has vetoed.
  std::span<const int> flipped_faces() const { return quality_->flipped_faces(); }

 private:
  template <class Move>
  StepOutcome advance(double end_time, double dt, const Move& move);
  StepOutcome step_by(const Motion& motion, double end_time, double dt);
  StepOutcome step_border_by(std::span<const int> vertices, std::span<const Point> positions, double end_time,
                             double dt);
  Following& following(const InteriorOptions& options);
  std::optional<Defect> move(const Motion& motion, const TimeStep& step, std::span<Point> next);
  template <class Solve>
  std::optional<Defect> follow(double end_time, std::span<Point> next, const Solve& solve);
  StepOutcome step_by(std::span<const Point> positions, double end_time, double dt);
  void repair_moved(StepOutcome& outcome);
  std::optional<RegionsTooLarge> excess(const RepairRecord& record) const;
  void outdate_repaired(const RepairRecord& record);
  void improve(RepairRecord& record);
  void outdate_improved();
  void tell_observers(const StepRecord& record);
  std::vector<MovedVertex> moved_by_quality() const;
  void refresh_positions();
  void measure(StepOutcome& outcome);

  Mesh mesh_;
  std::unique_ptr<Strategy> strategy_;
  std::unique_ptr<QualityPass> quality_;
  RepairOptions repair_;
  FaceMinima minima_;
  bool knows_minima_ = false;  // of the mesh as it is
  MovedBlocks moved_;          // by the step
  double max_region_share_;
  std::vector<Point> next_;  // positions after the step, then before it
  InteriorOptions interior_;
  std::optional<Following> following_;  // once something has been followed
  FollowingState start_;                // of its first step
  double interior_ms_ = 0.0;            // of the step at hand
  bool has_followed_ = false;           // likewise
  std::vector<char> named_;       // per vertex: by step_border, and so not quality's; empty in other steps
  std::vector<Point> positions_;  // what positions() hands out; empty before
  std::vector<StepObserver> observers_;
  std::unique_ptr<ChangeTracker> tracker_;  // with observers or a limit only
  double time_;
  int step_;
};

}  // namespace kinemesh
