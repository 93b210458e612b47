// What a run adds up to, and the record it leaves of itself. Internal to sim/.
#pragma once

#include <filesystem>
#include <string>

#include "sim/run.h"

namespace kinemesh {

// Adds an accepted step; n_faces: of the mesh, padding included.
void add_step(RunSummary& summary, const StepRecord& record, int n_faces);

enum class RunState { Running, Done, Stopped };

// run.json, whole or not at all: who ran what with which program, and how far it came. The only file with
// dates in it.
class RunJson {
 public:
  RunJson(const std::filesystem::path& directory, const Scenario& scenario, const RunOptions& options);
  void write(const RunSummary& summary, RunState state) const;  // throws InputError naming the file

 private:
  std::filesystem::path path_;
  const Scenario& scenario_;
  const RunOptions& options_;
  std::string started_;
};

}  // namespace kinemesh
