// The folder a run writes to, and which of the files in it are the run's. Internal to sim/.
//
// A file is a run's own if the run.json beside it lists it. run.json is the first file that a run writes, and
// lists a name before a file of that name is made, so that this holds at whatever moment a run is killed. A
// folder in which every file with a name of ours is the run's own is what check_run_directory asks for; the
// others rely on it.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "kinemesh/scenario.h"
#include "sim/scenario/scenario_inputs.h"

namespace kinemesh {

std::string mesh_file_name(int step);  // mesh_000042.vtu

// True for the names run writes, whatever its scenario.
bool is_run_file(const std::string& name);

// The names that the folder's run.json lists; none where there is none.
std::set<std::string> files_of_run(const std::filesystem::path& directory);

// True if run.json says that the run in the folder came to its end.
bool holds_finished_run(const std::filesystem::path& directory);

// Throws InputError if the folder holds a run of another scenario (a text as to_toml makes it).
void require_run_of(const std::string& scenario, const std::filesystem::path& directory);

// Throws InputError, changing nothing: not a folder; a run is there and must not be touched (`may_be_there`
// is false); a file with a name of ours is no regular file, is one of the scenario's inputs, or is not the
// run's own. The run's scenario.toml may be the scenario itself: it is left as it is.
void check_run_directory(const std::filesystem::path& directory, const Scenario& scenario, bool may_be_there);

// Removes the run's files but run.json and, where it is the scenario itself, scenario.toml. What the run
// could be resumed from goes first. Throws InputError naming the path.
void clear_run_directory(const std::filesystem::path& directory, const Scenario& scenario);

// Whether it is a page that `kinemesh report` has made.
bool is_report(const std::filesystem::path& file);

// Removes the page `kinemesh report` has made of what was in the folder before. Throws InputError naming the
// path.
void remove_report(const std::filesystem::path& directory);

// Removes what an interrupted run wrote after its checkpoint: meshes not named here, the last mesh, a failed
// step. Throws InputError naming the path.
void remove_later_meshes(const std::filesystem::path& directory, std::span<const std::string> kept);

}  // namespace kinemesh
