// The folder a run writes to, and which of the files in it are a run's. Internal to sim/.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "sim/scenario.h"

namespace kinemesh {

std::string mesh_file_name(int step);  // mesh_000042.vtu

// True for the names run writes, whatever its scenario.
bool is_run_file(const std::string& name);

// True if run.json says that the run in the folder came to its end.
bool holds_finished_run(const std::filesystem::path& directory);

// Throws InputError if the folder holds a run of another scenario (a text as to_toml makes it).
void require_run_of(const std::string& scenario, const std::filesystem::path& directory);

// Throws InputError, changing nothing: not a folder; a run is there and `force` is not given; or the scenario
// or its mesh is one of the files that would be replaced.
void check_run_directory(const std::filesystem::path& directory, const Scenario& scenario, bool force);

// Makes the folder, or removes the run files from it, and nothing else. What a run could be resumed from goes
// first, and what says whose files they are last. Throws InputError naming the path.
void clear_run_directory(const std::filesystem::path& directory);

// Removes the page `kinemesh report` has made of what was in the folder before. Throws InputError naming the path.
void remove_report(const std::filesystem::path& directory);

// Removes what an interrupted run wrote after its checkpoint: meshes not named here, the last mesh, a failed
// step, files left half written. Throws InputError naming the path.
void remove_later_meshes(const std::filesystem::path& directory, std::span<const std::string> kept);

}  // namespace kinemesh
