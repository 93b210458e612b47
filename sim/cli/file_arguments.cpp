#include "sim/cli/file_arguments.h"

#include <fmt/format.h>

#include "core/io/same_file.h"
#include "kinemesh/error.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/scenario.h"
#include "sim/cli/mesh_arguments.h"
#include "sim/run/run_directory.h"
#include "sim/scenario/scenario_inputs.h"

namespace kinemesh::cli {
namespace {

namespace fs = std::filesystem;

void require_apart(const FileArgument& written, const FileArgument& other) {
  if (other.path.empty() || !is_same_file(written.path, other.path)) return;
  throw InputError(written.path.string(), 0,
                   fmt::format("{} and {} name the same file; another one expected for {}", other.name,
                               written.name, written.name));
}

// The scenario of a run in `directory`; what cannot be read has no inputs that are known.
bool is_input_of_run(const fs::path& path, const fs::path& directory) try {
  return ScenarioInputs(load_scenario(directory / "scenario.toml")).contain(path);
} catch (const InputError&) {
  return false;
}

}  // namespace

void check_files(const std::vector<FileArgument>& read, const std::vector<FileArgument>& written) {
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i].path.empty()) continue;
    for (const FileArgument& other : read) require_apart(written[i], other);
    for (std::size_t k = 0; k < i; ++k) require_apart(written[i], written[k]);
    require_place_for(follow_links(written[i].path));
  }
  for (const auto& [name, path] : written)
    if (!path.empty()) remove_leftovers(fs::absolute(follow_links(path)).parent_path());
}

void require_none_of_run(const fs::path& path, const fs::path& directory) {
  if (is_run_file(path.filename().string()) && is_same_file(path, directory / path.filename()))
    throw InputError(path.string(), 0, "is a file of the run; another name expected");
  if (is_input_of_run(path, directory))
    throw InputError(path.string(), 0, "is an input of the run's scenario; another name expected");
}

StagedFile stage_mesh(const fs::path& path, const MeshData& mesh) {
  require_writable(path.string());
  note_losses(path.string(), mesh);
  try {
    return StagedFile(follow_links(path), format_mesh(mesh, *format_of(path)));
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(path.string(), 0, error.what());
  }
}

}  // namespace kinemesh::cli
