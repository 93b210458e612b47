#include "kinemesh/stepper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/shortest_text.h"
#include "core/base/stopwatch.h"
#include "core/mesh/around.h"
#include "core/mesh/frame.h"
#include "core/sweep/face_minima.h"
#include "core/sweep/moved_blocks.h"
#include "kinemesh/error.h"
#include "kinemesh/measure.h"
#include "kinemesh/motion.h"
#include "motion/following.h"
#include "motion/interior/interior.h"
#include "sim/step/change_tracker.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {
namespace {

// Every defect tells the time; what moves vertices, but not the frame, out of this world tells it itself.
void add_time(Defect& defect, double time) {
  if (defect.kind == DefectKind::NonFinitePosition && defect.vertices.front() != none) return;
  if (!defect.detail.empty()) defect.detail += ", ";
  defect.detail += "at time " + shortest_text(time);
}

// describe(vertex) names what moved it.
template <class Describe>
std::optional<Defect> non_finite_defect(const Mesh& mesh, std::span<const Point> next,
                                        const Describe& describe) {
  const Vertex vertex(
      find_first(mesh.n_vertices(), grain::items, [&](int v) { return !is_finite(next[v]); }));
  if (vertex == none) return std::nullopt;
  Defect defect;
  defect.kind = DefectKind::NonFinitePosition;
  defect.vertices = {mesh.user_vertex(vertex)};
  defect.where = mesh.positions()[vertex];
  defect.detail = describe(vertex);
  return defect;
}

// Puts new positions into the mesh and, unless they are kept, takes them out again on every way out of the
// scope.
class PositionsInPlace {
 public:
  PositionsInPlace(Mesh& mesh, std::vector<Point>& next) : mesh_(mesh), next_(next) {
    mesh_.swap_positions(next_);
  }
  ~PositionsInPlace() {
    if (!kept_) mesh_.swap_positions(next_);
  }
  PositionsInPlace(const PositionsInPlace&) = delete;
  PositionsInPlace& operator=(const PositionsInPlace&) = delete;
  void keep() { kept_ = true; }

 private:
  Mesh& mesh_;
  std::vector<Point>& next_;
  bool kept_ = false;
};

// Takes back what was done to faces, too, unless it is kept. Nothing to do without a tracker.
class ChangesInPlace {
 public:
  ChangesInPlace(Mesh& mesh, ChangeTracker* tracker) : mesh_(mesh), tracker_(tracker) {}
  ~ChangesInPlace() {
    if (tracker_) tracker_->take_back(mesh_);
  }
  ChangesInPlace(const ChangesInPlace&) = delete;
  ChangesInPlace& operator=(const ChangesInPlace&) = delete;
  void keep() {
    if (tracker_) tracker_->accept(mesh_);
    tracker_ = nullptr;
  }

 private:
  Mesh& mesh_;
  ChangeTracker* tracker_;
};

// Marks vertices for the length of a scope.
class Named {
 public:
  Named(std::vector<char>& marks, const Mesh& mesh, std::span<const UserVertex> vertices) : marks_(marks) {
    marks_.assign(mesh.n_vertices(), 0);
    for (const UserVertex user : vertices) marks_[mesh.vertex_of_user(user)] = 1;
  }
  ~Named() { marks_.clear(); }
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;

 private:
  std::vector<char>& marks_;
};

// The border and what is fixed is known, all else follows.
std::vector<Role> border_roles(const Mesh& mesh) {
  std::vector<Role> roles(mesh.n_vertices(), Role::Free);
  for (const Constraint& c : mesh.constraints())
    if (c.is_border()) roles[c.from] = roles[c.to] = Role::Known;
  for (const Vertex v : mesh.vertices())
    if (mesh.is_fixed(v)) roles[v] = Role::Known;
  return roles;
}

void require_forward(double dt) {
  if (!std::isfinite(dt) || dt < 0) throw InputError("time step: a finite number, not negative, expected");
}

}  // namespace

class Stepper::Impl {
 public:
  Impl(Mesh&& mesh, const StepperOptions& options, double time, int steps_done);

  // As Stepper's.
  StepOutcome step(std::span<const Point> positions, double dt) { return step_by(positions, time_ + dt, dt); }
  StepOutcome step(const Motion& motion, double dt) { return step_by(motion, time_ + dt, dt); }
  StepOutcome step_to(const Motion& motion, double end_time) {
    return step_by(motion, end_time, end_time - time_);
  }
  StepOutcome step_to(std::span<const Point> positions, double end_time) {
    return step_by(positions, end_time, end_time - time_);
  }
  StepOutcome step_border(std::span<const UserVertex> vertices, std::span<const Point> positions, double dt) {
    return step_border_by(vertices, positions, time_ + dt, dt);
  }
  StepOutcome step_border_to(std::span<const UserVertex> vertices, std::span<const Point> positions,
                             double end_time) {
    return step_border_by(vertices, positions, end_time, end_time - time_);
  }
  std::vector<Point> moved(const Motion& motion, double end_time);
  FollowingState following_state() const { return following_ ? following_->state() : start_; }
  void set_following_state(FollowingState state) { start_ = std::move(state); }
  std::span<Point> positions();
  void observe(StepObserver observer);
  const Mesh& mesh() const { return mesh_; }
  double time() const { return time_; }
  int steps_done() const { return step_; }
  const Strategy& strategy() const { return *strategy_; }
  std::span<const Face> flipped_faces() const { return quality_->flipped_faces(); }

 private:
  template <class Move>
  StepOutcome advance(double end_time, double dt, const Move& move);
  StepOutcome step_by(const Motion& motion, double end_time, double dt);
  StepOutcome step_border_by(std::span<const UserVertex> vertices, std::span<const Point> positions,
                             double end_time, double dt);
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
  std::vector<QualityMove> moved_by_quality() const;
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

Stepper::Impl::Impl(Mesh&& mesh, const StepperOptions& options, double time, int steps_done)
    : mesh_(std::move(mesh)),
      strategy_(make_strategy(options.strategy)),
      quality_(make_quality(options.quality, mesh_, {options.angle, options.freedom})),
      repair_{.allow_escaped = options.allow_escaped, .retain = options.retain},
      max_region_share_(options.max_region_share),
      next_(mesh_.positions().begin(), mesh_.positions().end()),
      interior_(options.interior),
      time_(time),
      step_(steps_done) {
  if (std::isfinite(max_region_share_)) tracker_ = std::make_unique<ChangeTracker>(mesh_);
}

// `move` writes the positions at end_time and names what made one of them not finite. On an exception nothing
// is known of the faces.
template <class Move>
StepOutcome Stepper::Impl::advance(double end_time, double dt, const Move& move) {
  const Stopwatch clock;
  StepOutcome outcome;
  outcome.record.step = step_ + 1;
  outcome.record.time = end_time;
  outcome.record.dt = dt;

  if (!knows_minima_) minima_.reset(mesh_.n_faces());
  knows_minima_ = false;
  interior_ms_ = 0.0;
  has_followed_ = false;
  outcome.defect = move(std::span<Point>(next_));
  if (!outcome.defect) outcome.defect = kinemesh::follow(mesh_, next_);
  if (!outcome.defect) {
    moved_.find(mesh_.positions(), next_);
    outcome.defect = hull_defect(mesh_, next_);
  }
  outcome.record.interior_ms = interior_ms_;
  outcome.record.move_ms = clock.milliseconds() - interior_ms_;

  if (!outcome.defect) repair_moved(outcome);
  if (outcome.defect) add_time(*outcome.defect, end_time);
  if (outcome) {
    time_ = end_time;
    ++step_;
    if (has_followed_) following_->accept();
    outcome.record.accepted = true;
  }
  refresh_positions();
  measure(outcome);
  outcome.record.total_ms = clock.milliseconds();
  return outcome;
}

void Stepper::Impl::repair_moved(StepOutcome& outcome) {
  PositionsInPlace moved(mesh_, next_);
  Move move(repair_, next_);
  move.know(&minima_, &moved_);
  RepairOutcome repaired = strategy_->repair(mesh_, move);
  outcome.record.repair = std::move(repaired.record);
  outcome.defect = std::move(repaired.defect);
  if (outcome.defect) return;
  ChangesInPlace rewritten(mesh_, tracker_.get());
  if ((outcome.too_large = excess(outcome.record.repair))) {
    tracker_->note(outcome.record.repair.regions, {});
    return;
  }
  outdate_repaired(outcome.record.repair);
  improve(outcome.record.repair);
  if (tracker_) tell_observers(outcome.record);
  rewritten.keep();
  moved.keep();
}

// next_ holds the positions before the step. What an observer throws goes through the two guards above.
void Stepper::Impl::tell_observers(const StepRecord& record) {
  tracker_->note(record.repair.regions, quality_->flipped_faces());
  if (observers_.empty()) return;
  const auto patches = tracker_->patches(mesh_, record.repair.regions);
  const auto moved = moved_by_quality();
  const StepChanges changes{.step = record.step,
                            .time = record.time,
                            .dt = record.dt,
                            .mesh = mesh_,
                            .positions_before = next_,
                            .repair = record.repair,
                            .patches = patches,
                            .moved_by_quality = moved};
  for (const auto& observer : observers_) observer(changes);
}

std::vector<QualityMove> Stepper::Impl::moved_by_quality() const {
  const auto moved = quality_->moved_vertices();
  std::vector<QualityMove> by_user;
  by_user.reserve(moved.size());
  for (const auto& [vertex, before] : moved) by_user.push_back({mesh_.user_vertex(vertex), before});
  std::ranges::sort(by_user, {}, &QualityMove::vertex);
  return by_user;
}

std::optional<RegionsTooLarge> Stepper::Impl::excess(const RepairRecord& record) const {
  const double share = static_cast<double>(record.region_faces()) / mesh_.n_faces();
  if (!(share > max_region_share_)) return std::nullopt;
  return RegionsTooLarge{share, max_region_share_};
}

// What detection has measured holds but for what was changed since.
void Stepper::Impl::outdate_repaired(const RepairRecord& record) {
  if (strategy_->moves_vertices()) return minima_.reset(mesh_.n_faces());
  for (const RegionRecord& region : record.regions)
    minima_.outdate({region.faces.data(), region.faces.size()});
}

void Stepper::Impl::outdate_improved() {
  minima_.outdate(quality_->flipped_faces());
  for (const auto& [vertex, before] : quality_->moved_vertices()) {
    for_each_side_from(mesh_, vertex, [&](Side side) {
      const Face face = Mesh::face_of(side);
      minima_.outdate({&face, 1});
    });
  }
}

void Stepper::Impl::measure(StepOutcome& outcome) {
  const Stopwatch clock;
  StepRecord& record = outcome.record;
  if (outcome)
    outdate_improved();
  else
    minima_.reset(mesh_.n_faces());
  const Minima minima = minima_.update(mesh_);
  record.vertices = mesh_.n_user_vertices();
  record.faces = mesh_.n_user_faces();
  record.min_angle_deg = degrees(minima.tangent);
  record.min_area = 0.5 * minima.twice_area;
  knows_minima_ = true;
  record.measure_ms = clock.milliseconds();
}

// Cannot fail, and is undone by observers only. The initial mesh may have any shape, so the first step looks
// at all of it; next_ holds the positions before the step.
void Stepper::Impl::improve(RepairRecord& record) {
  const Stopwatch clock;
  const auto before = step_ == 0 ? std::span<const Point>() : std::span<const Point>(next_);
  const QualityCounts done = quality_->improve(
      mesh_, {.before = before, .replaced = record.regions, .minima = &minima_, .stays = named_});
  record.quality_flips = done.flips;
  record.quality_moves = done.moves;
  record.quality_ms = clock.milliseconds();
}

void Stepper::Impl::observe(StepObserver observer) {
  if (!observer) throw InputError("an observer that can be called expected");
  if (!tracker_) tracker_ = std::make_unique<ChangeTracker>(mesh_);
  observers_.push_back(std::move(observer));
}

std::span<Point> Stepper::Impl::positions() {
  if (positions_.empty()) positions_ = mesh_.user_positions();
  return positions_;
}

void Stepper::Impl::refresh_positions() {
  for (const UserVertex u : Numbers<UserVertex>(static_cast<int>(positions_.size())))
    positions_[u] = mesh_.position(mesh_.vertex_of_user(u));
}

StepOutcome Stepper::Impl::step_by(std::span<const Point> positions, double end_time, double dt) {
  require_forward(dt);
  if (static_cast<int>(positions.size()) != mesh_.n_user_vertices())
    throw InputError(std::to_string(positions.size()) + " positions, " +
                     std::to_string(mesh_.n_user_vertices()) + " expected");
  return advance(end_time, dt, [&](std::span<Point> next) {
    std::ranges::copy(mesh_.positions(), next.begin());
    for (const Vertex v : mesh_.vertices())
      if (const UserVertex user = mesh_.user_vertex(v); user != none) next[v] = positions[user];
    return non_finite_defect(
        mesh_, next, [&](Vertex) { return "in the positions given for time " + shortest_text(end_time); });
  });
}

StepOutcome Stepper::Impl::step_by(const Motion& motion, double end_time, double dt) {
  require_forward(dt);
  const TimeStep step{time_, end_time, dt, static_cast<std::uint64_t>(step_)};
  return advance(end_time, dt, [&](std::span<Point> next) { return move(motion, step, next); });
}

std::optional<Defect> Stepper::Impl::move(const Motion& motion, const TimeStep& step, std::span<Point> next) {
  const std::span<const Point> now = mesh_.positions();
  motion.advance(now, step, next);
  auto defect =
      non_finite_defect(mesh_, next, [&](Vertex v) { return motion.describe_non_finite(v, now, step); });
  if (defect || motion.roles().empty()) return defect;
  return follow(step.t1, next,
                [&] { return following(motion.interior()).follow(mesh_, motion, step, next); });
}

// solve() puts the interior where it follows the border to; it may have to go too far for numbers to hold.
template <class Solve>
std::optional<Defect> Stepper::Impl::follow(double end_time, std::span<Point> next, const Solve& solve) {
  const Stopwatch clock;
  const InteriorSolution solution = solve();
  interior_ms_ = clock.milliseconds();
  if (!solution.converged)
    throw InputError("the interior does not follow the border in step " + std::to_string(step_ + 1) +
                     ", at time " + shortest_text(end_time) + ": no solution after " +
                     std::to_string(solution.iterations) + " iterations, relative residual " +
                     shortest_text(solution.residual));
  has_followed_ = true;
  return non_finite_defect(mesh_, next,
                           [&](Vertex) { return "following the border to time " + shortest_text(end_time); });
}

Following& Stepper::Impl::following(const InteriorOptions& options) {
  if (!following_) following_.emplace(mesh_, options, std::move(start_));
  return *following_;
}

std::vector<Point> Stepper::Impl::moved(const Motion& motion, double end_time) {
  std::vector<Point> next(mesh_.positions().begin(), mesh_.positions().end());
  (void)move(motion, {time_, end_time, end_time - time_, static_cast<std::uint64_t>(step_)}, next);
  return next;
}

StepOutcome Stepper::Impl::step_border_by(std::span<const UserVertex> vertices,
                                          std::span<const Point> positions, double end_time, double dt) {
  require_forward(dt);
  if (interior_.follow == Follow::None) throw InputError("step_border: an interior that follows expected");
  if (vertices.size() != positions.size())
    throw InputError(std::to_string(positions.size()) + " positions for " + std::to_string(vertices.size()) +
                     " vertices, as many expected");
  std::vector<Role> roles = border_roles(mesh_);
  std::vector<char> is_given(mesh_.n_user_vertices(), 0);
  for (const UserVertex user : vertices) {
    if (user < 0 || user >= mesh_.n_user_vertices())
      throw InputError("vertex " + std::to_string(user) + ", expected a number from 0 and below " +
                       std::to_string(mesh_.n_user_vertices()));
    if (std::exchange(is_given[user], 1)) throw InputError("vertex " + std::to_string(user) + " comes twice");
    roles[mesh_.vertex_of_user(user)] = Role::Known;
  }
  const Named named(named_, mesh_, vertices);
  return advance(end_time, dt, [&](std::span<Point> next) {
    std::ranges::copy(mesh_.positions(), next.begin());
    for (std::size_t i = 0; i < vertices.size(); ++i) next[mesh_.vertex_of_user(vertices[i])] = positions[i];
    auto defect = non_finite_defect(
        mesh_, next, [&](Vertex) { return "in the positions given for time " + shortest_text(end_time); });
    if (defect) return defect;
    return follow(end_time, next, [&] { return following(interior_).follow(mesh_, roles, dt, next); });
  });
}

// --- the whole ---

Stepper::Stepper(Mesh&& mesh, const StepperOptions& options, double time, int steps_done)
    : impl_(std::make_unique<Impl>(std::move(mesh), options, time, steps_done)) {}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;

StepOutcome Stepper::step(std::span<const Point> positions, double dt) {
  return impl_->step(positions, dt);
}

StepOutcome Stepper::step(const Motion& motion, double dt) {
  return impl_->step(motion, dt);
}

StepOutcome Stepper::step_to(const Motion& motion, double end_time) {
  return impl_->step_to(motion, end_time);
}

StepOutcome Stepper::step_to(std::span<const Point> positions, double end_time) {
  return impl_->step_to(positions, end_time);
}

StepOutcome Stepper::step_border(std::span<const UserVertex> vertices, std::span<const Point> positions,
                                 double dt) {
  return impl_->step_border(vertices, positions, dt);
}

StepOutcome Stepper::step_border_to(std::span<const UserVertex> vertices, std::span<const Point> positions,
                                    double end_time) {
  return impl_->step_border_to(vertices, positions, end_time);
}

std::vector<Point> Stepper::moved(const Motion& motion, double end_time) {
  return impl_->moved(motion, end_time);
}

FollowingState Stepper::following_state() const {
  return impl_->following_state();
}

void Stepper::set_following_state(FollowingState state) {
  impl_->set_following_state(std::move(state));
}

std::span<Point> Stepper::positions() {
  return impl_->positions();
}

void Stepper::observe(StepObserver observer) {
  impl_->observe(std::move(observer));
}

const Mesh& Stepper::mesh() const {
  return impl_->mesh();
}

double Stepper::time() const {
  return impl_->time();
}

int Stepper::steps_done() const {
  return impl_->steps_done();
}

const Strategy& Stepper::strategy() const {
  return impl_->strategy();
}

std::span<const Face> Stepper::flipped_faces() const {
  return impl_->flipped_faces();
}

StepOutcome Stepper::repair(double dt) {
  return impl_->step(impl_->positions(), dt);
}

std::string StepOutcome::message() const {
  if (defect) return defect->message();
  if (!too_large) return {};
  return "regions of " + shortest_text(too_large->share) + " of all faces, at most " +
         shortest_text(too_large->limit) + " expected (max_region_share)";
}

}  // namespace kinemesh
