// What a run adds up to, and the record it leaves of itself. Internal to sim/.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>

#include "kinemesh/run.h"

namespace kinemesh {

// Adds an accepted step; n_faces: of the mesh, padding included.
void add_step(RunSummary& summary, const StepRecord& record, int n_faces);

enum class RunState { Running, Done, Stopped };

// run.json, whole or not at all: who ran what with which program, how far it came, and which files of the
// folder are its own (sim/run/run_directory.h). The only file with dates in it.
class RunJson {
 public:
  // files: those in the folder that are the run's own already, or of the run it replaces.
  RunJson(const std::filesystem::path& directory, const Scenario& scenario, const RunOptions& options,
          std::set<std::string> files);

  // Throw ResourceError or InputError naming the file. Once the run is done, names of files that are not
  // there are left out.
  void write(const RunSummary& summary, RunState state);
  void claim(
      std::initializer_list<std::string> names);  // before files of these names are made; after a write()

 private:
  void put() const;

  std::filesystem::path path_;
  const Scenario& scenario_;
  const RunOptions& options_;
  std::string started_;
  std::set<std::string> files_;
  RunSummary summary_;  // as written last
  RunState state_ = RunState::Running;
};

}  // namespace kinemesh
