#include "kinemesh/run.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>

#include "kinemesh/registry.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/numbers.h"
#include "sim/cli/progress.h"

namespace kinemesh::cli {
namespace {

struct RunArguments {
  std::string scenario;
  std::vector<std::string> overrides;
  RunOptions options;
  std::string directory;
  bool split_quads = false;
  bool quiet = false;
  bool verbose = false;

  Verbosity verbosity() const {
    return quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal;
  }
};

template <class Value>
void print_row(const char* name, const Value& value) {
  print_line(fmt::format("{:<22}{}", name, value));
}

// Whether a text says no more than that nothing is said.
bool is_left_out(const MotionSpec& motion, const std::string& name, const ParameterValue& value) {
  if (!std::holds_alternative<std::string>(value)) return false;
  for (const FieldInfo& field : fields())
    if (field.name == motion.field)
      for (const ParameterInfo& parameter : field.parameters)
        if (parameter.name == name) return parameter.otherwise == value;
  return false;
}

std::string describe(const MotionSpec& motion) {
  std::string text = motion.field;
  for (const auto& [name, value] : motion.parameters)
    if (!is_left_out(motion, name, value)) text += fmt::format(" {} = {}", name, to_string(value));
  return text;
}

std::string describe(const BorderConditions& border) {
  std::string text = fmt::format("default {}", to_string(border.otherwise));
  for (const auto& [marker, condition] : border.by_marker)
    text += fmt::format(", {} {}", marker, to_string(condition));
  return text;
}

std::string describe(const RepairSpec& repair) {
  return repair.quality == "angles" ? fmt::format("angles, of {} degrees", repair.angle) : repair.quality;
}

std::string describe(const InteriorOptions& interior) {
  std::string text = to_string(interior.follow);
  for (const auto& [label, value] : interior.stiffness)
    text += fmt::format(", label {} stiffness {}", label, value);
  return text;
}

std::string describe_parts(const MotionSpec& motion) {
  std::string text = fmt::format(" on {}", fmt::join(motion.on, ", "));
  if (motion.blend) text += fmt::format(", blended from {} to {}", (*motion.blend)[0], (*motion.blend)[1]);
  return text;
}

std::string describe(const BodyScenario& body) {
  std::string text = fmt::format("{}", fmt::join(body.on, ", "));
  for (const MotionSpec& motion : body.motions) text += "; " + describe(motion);
  return text;
}

void print_plan(const Scenario& scenario, const RunPlan& plan) {
  const MeshSpec& mesh = scenario.mesh;
  print_row("mesh", mesh.file.empty() ? "shape " + mesh.shape : mesh.file.string());
  print_row("size", fmt::format("{} vertices, {} faces, {} more as padding", plan.vertices, plan.faces,
                                plan.padding_faces));
  print_row("minimum angle", fmt::format("{:.4g} degrees", plan.min_angle_deg));
  print_row("markers",
            plan.markers.empty() ? std::string("none") : fmt::format("{}", fmt::join(plan.markers, ", ")));
  for (const BodyScenario& body : scenario.bodies) print_row("body", describe(body));
  for (const MotionSpec& motion : scenario.motions)
    print_row("motion", describe(motion) + describe_parts(motion));
  print_row("border", describe(scenario.border.conditions));
  print_row("interior follows", describe(scenario.interior.options));
  print_row("time", fmt::format("{} steps of {} to {}{}", plan.steps, scenario.time.dt, plan.end_time,
                                plan.is_adaptive ? ", fewer or more as they succeed" : ""));
  print_row("strategy", plan.strategy);
  print_row("quality", describe(scenario.repair));
  print_row("threads", plan.threads);
  print_row("folder", plan.directory.string());
}

// To the microsecond at most, never an exponent: five characters up to 99,999, so that the phases fit a line.
std::string milliseconds(double ms) {
  return fmt::format("{:.{}f}", ms, ms < 10.0 ? 3 : ms < 100.0 ? 2 : ms < 1000.0 ? 1 : 0);
}

std::string in_phases(const PhaseTimes& ms, int steps) {
  const double n = std::max(1, steps);
  return fmt::format("move {}, detect {}, explore {}, triangulate {}, splice {}", milliseconds(ms.move / n),
                     milliseconds(ms.detect / n), milliseconds(ms.explore / n),
                     milliseconds(ms.triangulate / n), milliseconds(ms.splice / n));
}

// What only some runs have.
std::string in_rest(const PhaseTimes& ms, int steps) {
  const double n = std::max(1, steps);
  std::string text;
  if (ms.interior > 0.0) text += "interior " + milliseconds(ms.interior / n);
  if (ms.quality > 0.0) text += (text.empty() ? "quality " : ", quality ") + milliseconds(ms.quality / n);
  return text;
}

void print_times(const RunSummary& summary, const RemeshProbe& probe) {
  if (summary.steps == 0) return;
  const double step_ms = summary.ms.total / summary.steps;
  print_row("time of a step", milliseconds(step_ms) + " ms");
  print_row("in its phases", in_phases(summary.ms, summary.steps));
  if (const auto rest = in_rest(summary.ms, summary.steps); !rest.empty()) print_row("", rest);
  if (const auto remesh_ms = probe.step_ms(); remesh_ms && step_ms > 0.0)
    print_row("with a full re-mesh",
              fmt::format("{} ms, {:.3g} times as long", milliseconds(*remesh_ms), *remesh_ms / step_ms));
}

// Most need no quotes.
std::string word(const std::string& text) {
  const auto is_usual = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("/._-+,:@%", c);
  };
  return std::ranges::all_of(text, is_usual) ? text : shell_word(text);
}

void print_quality(const RunSummary& summary) {
  if (summary.steps == 0) return;
  print_row("smallest angle", fmt::format("{:.4g} degrees in the worst step", summary.min_angle_deg));
  if (summary.quality_flips + summary.quality_moves > 0)
    print_row("for quality", fmt::format("{:.4g} edges flipped, {:.4g} moves of vertices in a step",
                                         static_cast<double>(summary.quality_flips) / summary.steps,
                                         static_cast<double>(summary.quality_moves) / summary.steps));
}

// program: as the user has called it, which need not be on the path.
void print_summary(const RunSummary& summary, const RemeshProbe& probe, const std::string& program) {
  const std::string planned = summary.plan.is_adaptive ? fmt::format("{} rejected", summary.rejected)
                                                       : fmt::format("of {}", summary.plan.steps);
  print_row("steps", fmt::format("{} {}, to t = {:.6g}", summary.steps, planned, summary.time));
  print_row("steps that tangled", summary.steps_tangled);
  print_row("inverted triangles", fmt::format("{} in {} regions, the largest of {}", summary.inverted,
                                              summary.regions, summary.region_faces_max));
  print_row("triangles replaced", summary.replaced);
  print_row("share of the mesh", fmt::format("{:.3g} % in a step, at most {:.3g} %",
                                             100.0 * summary.share_mean, 100.0 * summary.share_max));
  if (summary.escaped_max > 0) print_row("escaped vertices", fmt::format("at most {}", summary.escaped_max));
  if (summary.retries > 0) print_row("retries", summary.retries);
  print_quality(summary);
  print_times(summary, probe);
  fmt::print("files\n");
  for (const auto& file : summary.files) print_line("  " + file.string());
  print_row("to look at it",
            fmt::format("{} report {}", word(program), word(summary.plan.directory.string())));
}

// The resolved scenario holds what --set and --split-quads changed.
std::string how_to_go_on(const RunSummary& summary) {
  if (!summary.can_resume) return "";
  const std::string folder = summary.plan.directory.string();
  return fmt::format("; to go on: kinemesh run {} -o {} --resume", shell_word(folder + "/scenario.toml"),
                     shell_word(folder));
}

ExitCode code_of(StopCause cause) {
  switch (cause) {
    case StopCause::Memory:
      return lacking;
    case StopCause::Bug:
      return internal;
    case StopCause::Other:
      break;
  }
  return not_valid;
}

int run_scenario(const RunArguments& arguments) {
  Scenario scenario = load_scenario(arguments.scenario, arguments.overrides);
  scenario.mesh.split_quads |= arguments.split_quads;
  RunOptions options = arguments.options;
  options.directory = arguments.directory;
  Progress progress(arguments.verbosity());
  const RunSummary summary = run(scenario, options, progress);
  if (summary.was_finished) {
    if (!arguments.quiet) fmt::print("the run is finished, nothing to do\n");
    return done;
  }
  if (options.dry_run) {
    print_plan(scenario, summary.plan);
    return done;
  }
  if (!arguments.quiet) print_summary(summary, progress.probe(), options.argv.front());
  if (!summary.stopped) return done;
  std::fflush(stdout);
  print_error(fmt::format("{}: {}{}", arguments.scenario, *summary.stopped, how_to_go_on(summary)));
  return code_of(summary.stop_cause);
}

}  // namespace

void add_run(CLI::App& program, Action& action, const std::vector<std::string>& argv) {
  const auto arguments = std::make_shared<RunArguments>();
  RunOptions& options = arguments->options;
  options.argv = argv;
  CLI::App& command =
      *program.add_subcommand("run", "Move a mesh through time and repair it after every step");
  command.add_option("SCENARIO", arguments->scenario, "What moves and how: a TOML file")->required();
  command.add_option("-o,--output", arguments->directory,
                     "Folder for the results; default: the scenario's name");
  command.add_option("--set", arguments->overrides, "Change the scenario: key=value, as in motion.0.rate=2")
      ->type_size(1)
      ->allow_extra_args(false);
  command.add_flag("--split-quads", arguments->split_quads,
                   "Cut the mesh's quadrilaterals in two instead of refusing them");
  command.add_flag("--dry-run", options.dry_run, "Say what would be done, and write nothing");
  command.add_flag("--dump-on-failure", options.dump_on_failure,
                   "Write a step without valid mesh, for `kinemesh replay`");
  CLI::Option* force = command.add_flag("--force", options.force, "Replace the run that is in the folder");
  command.add_flag("--resume", options.resume, "Go on with the run that is in the folder")->excludes(force);
  CLI::Option* quiet = command.add_flag("-q,--quiet", arguments->quiet, "Say nothing but errors");
  command.add_flag("-v,--verbose", arguments->verbose, "Say more")->excludes(quiet);
  command.add_option("--threads", options.threads, "Threads to use; default: all cores")
      ->transform(integer_within(1, 1024));
  command.footer(
      "Writes scenario.toml, run.json, steps.csv, regions.csv, mesh_NNNNNN.vtu, mesh.pvd, the last mesh\n"
      "and checkpoints. Progress goes to stderr, the summary to stdout. Ctrl-C ends the run after the\n"
      "step it is in; --resume goes on from the last checkpoint.");
  command.callback([arguments, &action] { action = [arguments] { return run_scenario(*arguments); }; });
}

}  // namespace kinemesh::cli
