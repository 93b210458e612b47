// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/error.h"

namespace kinemesh {

// Writes `content` to a temporary file beside `path`, flushes it to the disk, and renames it: after a crash
// or on a full disk the old file is still there, and nothing else. A symbolic link is followed. Throws
// InputError naming file and reason; never replaces what is not a regular file.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// Makes renamings in the folder survive a crash, where its file system can.
void flush_directory(const std::filesystem::path& directory);

// The whole file. Throws InputError naming file and reason: missing, a directory or device, unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace kinemesh
