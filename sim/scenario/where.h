// The place in a scenario something was written at, for messages.
#pragma once

#include <string>

#include "kinemesh/error.h"

namespace kinemesh {

struct Where {
  std::string file;  // or the `--set key=value` it came from
  int line = 0;      // from 1; 0 where there is none
};

inline InputError error_at(const Where& where, const std::string& what) {
  return where.file.empty() ? InputError(what) : InputError(where.file, where.line, what);
}

}  // namespace kinemesh
