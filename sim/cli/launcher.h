// mpirun and its like: programs that start several processes of this one, which would all write the same
// files.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace kinemesh::cli {

struct Launch {
  int size = 1;           // processes
  bool is_first = true;   // of them
  std::string told_by{};  // the variable that says so
};

// What the environment tells; nothing where this process is the only one, or none knows.
std::optional<Launch> find_launch();

// Whether the chosen command writes files, but this is one of several processes. The first of them says so on
// stderr.
bool refuse_several(const CLI::App& program);

}  // namespace kinemesh::cli
