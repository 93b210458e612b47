#include "sim/run/failed_step.h"

#include <algorithm>

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

// Without the interior, which only what moves the vertices asks, and the freedom, a section of its own.
template <class Archive, class S>
requires binary::Is<S, StepperOptions>
void members(Archive& archive, S& options) {
  archive(options.strategy, options.quality, options.allow_escaped, options.retain, options.max_region_share,
          options.angle);
}

namespace {

constexpr binary::FileKind kind{
    "KMFSTEP\n", "failed step of kinemesh",
    "that version can replay it, or this one's `run --dump-on-failure` write it anew"};

// In the order of the file.
template <class Sections, class S, class Freedom>
void list_sections(Sections& sections, S& step, Freedom& freedom) {
  sections({"about", 1}, step.program, step.source, step.message, step.detail);
  sections({"options", 1}, step.options);
  sections({"freedom", 1}, freedom);
  base_sections(sections, step.base);
  sections({"state", 1}, step.mesh);
  sections({"step", 1}, step.moved, step.time, step.end_time, step.steps_done);
}

template <class Value>
void renumber(std::unordered_map<int, Value>& values, const std::vector<int>& numbers) {
  std::unordered_map<int, Value> renumbered;
  for (const auto& [vertex, value] : values) renumbered.emplace(numbers[vertex], value);
  values = std::move(renumbered);
}

// By the user's numbers, and back.
VertexFreedom sorted(VertexFreedom freedom, const std::vector<int>& order) {
  if (!freedom.held.empty()) freedom.held = in_user_order(freedom.held, order);
  const auto numbers = inverse(order);
  renumber(freedom.tangents, numbers);
  renumber(freedom.curve_of, numbers);
  return freedom;
}

VertexFreedom placed(VertexFreedom freedom, const std::vector<int>& order) {
  const auto is_there = [&](const auto& item) {
    return item.first >= 0 && item.first < static_cast<int>(order.size());
  };
  if ((!freedom.held.empty() && freedom.held.size() != order.size()) ||
      !std::ranges::all_of(freedom.tangents, is_there) || !std::ranges::all_of(freedom.curve_of, is_there))
    throw InputError("what quality may move is of a mesh of another size");
  if (!freedom.held.empty()) freedom.held = in_mesh_order(freedom.held, order);
  renumber(freedom.tangents, order);
  renumber(freedom.curve_of, order);
  return freedom;
}

}  // namespace

FailedStep failed_step(Stepper& stepper, const Motion& motion, double end_time) {
  const Mesh& mesh = stepper.mesh();
  const std::vector<Point> next = stepper.moved(motion, end_time);
  FailedStep step;
  step.base = base_of(mesh);
  step.mesh = state_of(mesh, step.base.order);
  step.moved = mesh.in_user_order(next);
  step.time = stepper.time();
  step.end_time = end_time;
  step.steps_done = stepper.steps_done();
  return step;
}

Mesh mesh_before(const FailedStep& step) {
  return restore(step.base, step.mesh);
}

StepOutcome replay(const FailedStep& step) {
  Stepper stepper(mesh_before(step), step.options, step.time, step.steps_done);
  StepOutcome outcome = stepper.step_to(step.moved, step.end_time);
  if (outcome.defect && outcome.defect->kind == DefectKind::NonFinitePosition)
    outcome.defect->detail = step.detail;
  return outcome;
}

std::string format_failed_step(const FailedStep& step) {
  const VertexFreedom freedom = sorted(step.options.freedom, step.base.order.vertices);
  binary::SectionWriter writer;
  list_sections(writer, step, freedom);
  return std::move(writer).file(kind);
}

FailedStep parse_failed_step(std::string_view content) {
  binary::SectionReader reader(kind, content);
  FailedStep step;
  list_sections(reader, step, step.options.freedom);
  reader.expect_end();
  const auto& order = step.base.order.vertices;
  require_permutation(order);
  step.options.freedom = placed(std::move(step.options.freedom), order);
  return step;
}

}  // namespace kinemesh
