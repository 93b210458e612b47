// The commands of the program. Each function adds one to the program's options; when the user chose it,
// `action` is what to do once everything on the command line has been understood.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace kinemesh::cli {

// What the process returns; a contract.
enum ExitCode : int {
  done = 0,
  not_valid = 1,  // done, but the mesh is not valid; or no valid mesh exists; or the run had to stop
  bad_input = 2,  // nothing was done: a file or the command line is wrong
};

// Returns the exit code. Errors are exceptions: InputError for bad input.
using Action = std::function<int()>;

void add_list(CLI::App& program, Action& action);
void add_bench(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_convert(CLI::App& program, Action& action);
void add_untangle(CLI::App& program, Action& action);
void add_replay(CLI::App& program, Action& action);
void add_draw(CLI::App& program, Action& action);
void add_report(CLI::App& program, Action& action);
void add_run(CLI::App& program, Action& action, const std::vector<std::string>& argv);

}  // namespace kinemesh::cli
