// What a failed call on a file means. Internal to the writers and readers of files.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "kinemesh/error.h"

namespace kinemesh::io {

// Whether the machine lacks something, rather than the caller having named a wrong file.
inline bool is_lack_of_resources(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case ENOMEM:
    case ENOBUFS:
    case EMFILE:
    case ENFILE:
    case EAGAIN:
    case EMLINK:
    case ESTALE:
      return true;
    default:
      return false;
  }
}

// "FILE: DOING: why", an InputError or a ResourceError.
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& doing, int error) {
  const std::string what = doing + ": " + std::strerror(error);
  if (is_lack_of_resources(error)) throw ResourceError(path.string() + ": " + what);
  throw InputError(path.string(), 0, what);
}

}  // namespace kinemesh::io
