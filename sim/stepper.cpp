#include "sim/stepper.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/error.h"
#include "core/frame.h"
#include "core/measure.h"
#include "core/stopwatch.h"

namespace kinemesh {
namespace {

// Shortest text that reads back as the same number.
std::string exact_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

// Every defect tells the time; what moves vertices out of this world tells it itself.
void add_time(Defect& defect, double time) {
  if (defect.kind == DefectKind::NonFinitePosition) return;
  if (!defect.detail.empty()) defect.detail += ", ";
  defect.detail += "at time " + exact_text(time);
}

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

// describe(vertex) names what moved it.
template <class Describe>
std::optional<Defect> non_finite_defect(const Mesh& mesh, std::span<const Point> next,
                                        const Describe& describe) {
  const auto bad = std::find_if_not(next.begin(), next.end(), is_finite);
  if (bad == next.end()) return std::nullopt;
  const int vertex = static_cast<int>(bad - next.begin());
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

void describe_mesh(const Mesh& mesh, StepRecord& record) {
  const Measures measures = measure(mesh);
  record.vertices = mesh.n_user_vertices();
  record.faces = mesh.n_user_faces();
  record.min_angle_deg = measures.min_angle_deg;
  record.min_area = measures.min_area;
}

void require_forward(double dt) {
  if (!std::isfinite(dt) || dt < 0) throw InputError("time step: a finite number, not negative, expected");
}

}  // namespace

Stepper::Stepper(Mesh mesh, const StepperOptions& options)
    : mesh_(std::move(mesh)),
      strategy_(make_strategy(options.strategy)),
      quality_(make_quality(options.quality, mesh_)),
      repair_{.allow_escaped = options.allow_escaped, .retain = options.retain},
      next_(mesh_.positions().begin(), mesh_.positions().end()) {}

// `move` writes the positions at end_time over those of now and names what made one of them not finite.
template <class Move>
StepOutcome Stepper::advance(double end_time, double dt, const Move& move) {
  const Stopwatch clock;
  StepOutcome outcome;
  outcome.record.step = step_ + 1;
  outcome.record.time = end_time;
  outcome.record.dt = dt;

  next_.assign(mesh_.positions().begin(), mesh_.positions().end());
  outcome.defect = move(std::span<Point>(next_));
  if (!outcome.defect) {
    follow(mesh_, next_);
    outcome.defect = hull_defect(mesh_, next_);
  }
  outcome.record.move_ms = clock.milliseconds();

  if (!outcome.defect) repair_moved(outcome);
  if (outcome.defect) {
    add_time(*outcome.defect, end_time);
  } else {
    time_ = end_time;
    ++step_;
    outcome.record.accepted = true;
  }
  describe_mesh(mesh_, outcome.record);
  outcome.record.total_ms = clock.milliseconds();
  return outcome;
}

void Stepper::repair_moved(StepOutcome& outcome) {
  PositionsInPlace moved(mesh_, next_);
  RepairOutcome repaired = strategy_->repair(mesh_, repair_);
  outcome.record.repair = std::move(repaired.record);
  outcome.defect = std::move(repaired.defect);
  if (outcome.defect) return;
  improve(outcome.record.repair);
  moved.keep();
}

// Comes after all that can fail, and cannot: the repair is not undone any more. The initial mesh may have any
// shape, so the first step looks at all of it; next_ holds the positions before the step.
void Stepper::improve(RepairRecord& record) {
  const Stopwatch clock;
  const auto before = step_ == 0 ? std::span<const Point>() : std::span<const Point>(next_);
  record.quality_flips = quality_->improve(mesh_, before, record.regions);
  record.quality_ms = clock.milliseconds();
}

StepOutcome Stepper::step(std::span<const Point> positions, double dt) {
  require_forward(dt);
  if (static_cast<int>(positions.size()) != mesh_.n_user_vertices())
    throw InputError(std::to_string(positions.size()) + " positions, " +
                     std::to_string(mesh_.n_user_vertices()) + " expected");
  return advance(time_ + dt, dt, [&](std::span<Point> next) {
    for (int v = 0; v < mesh_.n_vertices(); ++v)
      if (const int user = mesh_.user_vertex(v); user != none) next[v] = positions[user];
    return non_finite_defect(
        mesh_, next, [&](int) { return "in the positions given for time " + exact_text(time_ + dt); });
  });
}

StepOutcome Stepper::step(const Motion& motion, double dt) {
  return step_by(motion, time_ + dt, dt);
}

StepOutcome Stepper::step_to(const Motion& motion, double end_time) {
  return step_by(motion, end_time, end_time - time_);
}

StepOutcome Stepper::step_by(const Motion& motion, double end_time, double dt) {
  require_forward(dt);
  const auto number = static_cast<std::uint64_t>(step_);
  return advance(end_time, dt, [&](std::span<Point> next) {
    const std::span<const Point> now = mesh_.positions();
    motion.advance(now, time_, dt, number, next);
    return non_finite_defect(mesh_, next,
                             [&](int v) { return motion.describe_non_finite(v, now, time_, dt, number); });
  });
}

}  // namespace kinemesh
