// Files that are there whole or not at all.
//
// Errors are InputErrors naming file and reason, and ResourceErrors where the machine is the reason
// (core/io/file_error.h).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "kinemesh/error.h"

namespace kinemesh {

// A file's new content, on the disk beside it under a name of its own: several files can be staged before the
// first one is put in place. What is never committed goes away with the object; what a killed process has
// left is found by remove_leftovers.
class StagedFile {
 public:
  // Throws, leaving nothing: the folder is missing or not writable, the disk is full, or `path` is a link, a
  // folder, a pipe or a device, none of which is ever written through or replaced.
  StagedFile(const std::filesystem::path& path, std::string_view content);
  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&&) = delete;
  ~StagedFile();

  // Renames it to `path`, which keeps its permissions; after a crash there is the old or the new file.
  void commit();

 private:
  void discard() noexcept;

  std::filesystem::path path_, staged_;
  int descriptor_;
};

// Stages and commits: after a crash or on a full disk the old file is still there, and nothing else.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// Where a chain of symbolic links leads, for files that the user has named and may have named by a link.
std::filesystem::path follow_links(const std::filesystem::path& path);

// Throws what writing `path` would throw for a reason that is known before there is content: no such folder,
// one that may not be written to, something that is no regular file at that place.
void require_place_for(const std::filesystem::path& path);

// Throws InputError where something stands at that place that is no regular file: a link, folder, pipe,
// device.
void require_regular_or_nothing(const std::filesystem::path& path);

// Removes the files in a folder that processes which are no more have staged and neither committed nor
// discarded.
void remove_leftovers(const std::filesystem::path& directory);
bool is_staged_name(std::string_view name);

// Makes renamings in the folder survive a crash, where its file system can.
void flush_directory(const std::filesystem::path& directory);

// The whole file. Throws for what is missing, a directory or device, unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace kinemesh
