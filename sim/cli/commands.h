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
  not_valid =
      1,  // the mesh is not valid; no valid mesh exists; or the run had to stop, be it for a full disk
  bad_input = 2,  // a file or the command line is wrong; nothing was written
  lacking = 3,    // memory has run out; or the machine lacks what a command other than run takes
  internal = 4,   // a mistake of kinemesh
};

// Returns the exit code. Errors are exceptions: InputError for bad input, before anything is written;
// ResourceError and bad_alloc for what the machine lacks; others are internal.
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
