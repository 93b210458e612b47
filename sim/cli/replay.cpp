#include <fmt/core.h>

#include <memory>
#include <optional>

#include "core/io/atomic_file.h"
#include "kinemesh/run.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/file_arguments.h"
#include "sim/cli/mesh_arguments.h"
#include "sim/run/failed_step.h"

namespace kinemesh::cli {
namespace {

struct ReplayArguments {
  std::string file, before, after;
};

FailedStep read_failed_step(const std::string& file) {
  const std::string content = read_file(file);
  try {
    FailedStep step = parse_failed_step(content);
    (void)mesh_before(step);
    return step;
  } catch (const InputError& error) {
    throw InputError(file, 0, error.what());
  }
}

void write_meshes(const FailedStep& step, const ReplayArguments& arguments) {
  if (arguments.before.empty() && arguments.after.empty()) return;
  MeshData mesh = mesh_before(step).domain();
  std::optional<StagedFile> before, after;
  if (!arguments.before.empty()) before.emplace(stage_mesh(arguments.before, mesh));
  mesh.points = step.moved;
  if (!arguments.after.empty()) after.emplace(stage_mesh(arguments.after, mesh));
  if (before) before->commit();
  if (after) after->commit();
}

// What a run would say if it had to stop, but for what it knows may help, or nothing.
std::string reason_to_stop(const FailedStep& step) {
  try {
    const StepOutcome outcome = replay(step);
    return outcome ? "" : why_stopped(outcome);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
}

// Before any work: both can be written, and are none of the files there are.
void check(const ReplayArguments& arguments) {
  check_files({{"CASE", arguments.file}}, {{"--before", arguments.before}, {"--after", arguments.after}});
  for (const std::string& output : {arguments.before, arguments.after}) {
    if (output.empty()) continue;
    require_writable(output);
    require_none_of_run(output, std::filesystem::path(arguments.file).parent_path());
  }
}

int replay_file(const ReplayArguments& arguments) {
  check(arguments);
  const FailedStep step = read_failed_step(arguments.file);
  write_meshes(step, arguments);
  const std::string reason = reason_to_stop(step);
  if (reason.empty()) {
    print_line(fmt::format("step {} ends with a valid mesh; version {} had said: {}", step.steps_done + 1,
                           step.program, step.message));
    return done;
  }
  print_error(step.source + ": " + (step.message.starts_with(reason) ? step.message : reason));
  return not_valid;
}

}  // namespace

void add_replay(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App& command =
      *program.add_subcommand("replay", "Do the step again that `run --dump-on-failure` has written");
  command.add_option("CASE", arguments->file, "The step: failed_step.bin of a run")->required();
  command.add_option("--before", arguments->before, "Write the mesh before the step to this file");
  command.add_option("--after", arguments->after, "Write it with the vertices moved, and nothing repaired");
  command.footer("Says what the run said, with the same exit code, unless the step now ends valid.");
  command.callback([arguments, &action] { action = [arguments] { return replay_file(*arguments); }; });
}

}  // namespace kinemesh::cli
