// A folder has one writer.
#pragma once

#include <filesystem>

#include "kinemesh/error.h"

namespace kinemesh {

// Holds a folder against other processes that lock it, too. The lock is the kernel's, on the folder itself:
// it leaves no file, and dies with its process, however that ends. On a network file system it may hold among
// the processes of one machine only.
class FolderLock {
 public:
  FolderLock() = default;  // of no folder

  // Throws InputError: no such folder, not readable, or another process holds it.
  explicit FolderLock(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

  bool is_held() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

}  // namespace kinemesh
