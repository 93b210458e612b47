// The folder a benchmark writes to, and which of the files in it are a benchmark's.
#pragma once

#include <filesystem>
#include <span>

#include "core/io/folder_lock.h"
#include "kinemesh/scenario.h"

namespace kinemesh::cli {

// Makes the folder, locks it, and removes the files of a former benchmark, its report among them. Throws
// InputError, changing nothing: not a folder; another process writes to it; a file with a name of ours is
// there and `force` is not given, or is no regular file, not a benchmark's (by its first line), or an input
// of one of the scenarios.
FolderLock open_bench_directory(const std::filesystem::path& directory, std::span<const Scenario> scenarios,
                                bool force);

}  // namespace kinemesh::cli
