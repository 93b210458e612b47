// Runs a scenario up to a step and draws what that step replaced.
//
//   example_draw_step SCENARIO.toml STEP OUT.svg [X0 Y0 X1 Y1]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/io/svg.h"
#include "sim/setup.h"
#include "sim/stepper.h"

namespace {

using namespace kinemesh;

// One flag per face of the domain, in the order of Mesh::domain.
std::vector<std::uint8_t> replaced_faces(const Mesh& mesh, const RepairRecord& record) {
  std::vector<std::uint8_t> by_face(mesh.n_faces(), 0), flags;
  for (const RegionRecord& region : record.regions)
    for (const int face : region.faces) by_face[face] = 1;
  for (const int face : mesh.faces_in_user_order()) flags.push_back(by_face[face]);
  return flags;
}

StepRecord step_to(Stepper& stepper, const Motion& motion, const Scenario& scenario, int last) {
  StepRecord record;
  for (int n = 1; n <= last; ++n) {
    StepOutcome outcome = stepper.step_to(motion, scenario.time.time_after(n));
    if (!outcome) throw std::runtime_error(outcome.defect->message());
    record = std::move(outcome.record);
  }
  return record;
}

void draw(const std::string& file, int step, const std::string& svg, const SvgOptions& view) {
  const Scenario scenario = load_scenario(file);
  SetUp made = set_up(scenario);
  Stepper stepper(std::move(made.mesh),
                  {scenario.repair.strategy, scenario.repair.allow_escaped, scenario.repair.retain});
  const StepRecord record = step_to(stepper, made.motion, scenario, step);
  const auto flags = replaced_faces(stepper.mesh(), record.repair);
  SvgOptions options = view;
  options.replaced = flags;
  write_svg(svg, stepper.mesh().domain(), options);
  std::printf("step %d, time %g: %d inverted, %d of %d faces replaced; %s\n", record.step, record.time,
              record.repair.inverted, record.repair.replaced, stepper.mesh().n_faces(), svg.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4 && argc != 8) throw std::runtime_error("SCENARIO STEP OUT.svg [X0 Y0 X1 Y1] expected");
  SvgOptions view;
  const auto number = [&](int i) { return std::strtod(argv[i], nullptr); };
  if (argc == 8) view.view = ViewBox{{number(4), number(5)}, {number(6), number(7)}};
  draw(argv[1], std::atoi(argv[2]), argv[3], view);
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_draw_step: %s\n", error.what());
  return 1;
}
