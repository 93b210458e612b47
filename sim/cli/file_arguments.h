// The files that a command line names, looked at before the work begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/atomic_file.h"
#include "kinemesh/mesh_data.h"

namespace kinemesh::cli {

struct FileArgument {
  std::string name;            // of the argument: "MESH", "--report"
  std::filesystem::path path;  // empty: not given
};

// Throws InputError where a file that is to be written has no place to be in, or is named by another
// argument, too, under this name or another one. Removes what killed processes have left beside the places.
void check_files(const std::vector<FileArgument>& read, const std::vector<FileArgument>& written);

// Throws InputError where `path` is a file of the run in `directory`, or an input of its scenario.
void require_none_of_run(const std::filesystem::path& path, const std::filesystem::path& directory);

// The mesh in the format of the path's extension, where the path leads to if it is a link; with a note for
// what that format cannot keep. Throws InputError.
StagedFile stage_mesh(const std::filesystem::path& path, const MeshData& mesh);

}  // namespace kinemesh::cli
