// The folder a run writes to, and which of the files in it are a run's. Internal to sim/.
#pragma once

#include <filesystem>
#include <string>

#include "sim/scenario.h"

namespace kinemesh {

std::string mesh_file_name(int step);  // mesh_000042.vtu

// True for the names run writes, whatever its scenario.
bool is_run_file(const std::string& name);

// Throws InputError, changing nothing: not a folder; a run is there and `force` is not given; or the scenario
// or its mesh is one of the files that would be replaced.
void check_run_directory(const std::filesystem::path& directory, const Scenario& scenario, bool force);

// Makes the folder, or removes the run files from it, and nothing else. Throws InputError naming the path.
void clear_run_directory(const std::filesystem::path& directory);

}  // namespace kinemesh
