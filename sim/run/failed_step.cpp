#include "sim/run/failed_step.h"

#include "sim/run/mesh_members.h"

namespace kinemesh {

// By vertex, so that the same freedom is the same bytes.
template <class Archive, class S>
requires binary::Is<S, VertexFreedom>
void members(Archive& archive, S& freedom) {
  std::map<int, Point> tangents(freedom.tangents.begin(), freedom.tangents.end());
  std::vector<std::vector<Point>> curves;
  for (const Polyline& curve : freedom.curves)
    curves.emplace_back(curve.points().begin(), curve.points().end());
  std::map<int, int> curve_of(freedom.curve_of.begin(), freedom.curve_of.end());
  archive(freedom.held, tangents, curve_of, curves);
  if constexpr (!std::is_const_v<S>)
    freedom = {std::move(freedom.held),
               {tangents.begin(), tangents.end()},
               {curve_of.begin(), curve_of.end()},
               {curves.begin(), curves.end()}};
}

// Without the interior, which only what moves the vertices asks.
template <class Archive, class S>
requires binary::Is<S, StepperOptions>
void members(Archive& archive, S& options) {
  archive(options.strategy, options.quality, options.allow_escaped, options.retain, options.max_region_share,
          options.angle, options.freedom);
}

template <class Archive, class S>
requires binary::Is<S, FailedStep>
void members(Archive& archive, S& step) {
  archive(step.program, step.source, step.message, step.detail, step.options, step.origin, step.mesh,
          step.moved, step.time, step.end_time, step.steps_done);
}

namespace {

constexpr binary::Kind kind{"KMFSTEP\n", 5, "failed step of kinemesh"};

}  // namespace

FailedStep failed_step(Stepper& stepper, const Motion& motion, double end_time) {
  const Mesh& mesh = stepper.mesh();
  const std::vector<Point> next = stepper.moved(motion, end_time);
  FailedStep step;
  step.mesh = state_of(mesh);
  step.moved = mesh.in_user_order(next);
  step.time = stepper.time();
  step.end_time = end_time;
  step.steps_done = stepper.steps_done();
  return step;
}

Mesh mesh_before(const FailedStep& step) {
  Mesh mesh = rebuild(step.origin);
  restore(mesh, step.mesh);
  return mesh;
}

StepOutcome replay(const FailedStep& step) {
  Stepper stepper(mesh_before(step), step.options, step.time, step.steps_done);
  StepOutcome outcome = stepper.step_to(step.moved, step.end_time);
  if (outcome.defect && outcome.defect->kind == DefectKind::NonFinitePosition)
    outcome.defect->detail = step.detail;
  return outcome;
}

std::string format_failed_step(const FailedStep& step) {
  return binary::seal(kind, binary::bytes_of(step));
}

FailedStep parse_failed_step(std::string_view content) {
  return binary::parsed<FailedStep>(binary::unseal(kind, content));
}

}  // namespace kinemesh
