// The fields that come with the program; kinemesh/registry.h is the way to them.
#pragma once

#include <vector>

#include "kinemesh/registry.h"

namespace kinemesh {

struct RegisteredField : FieldInfo {
  FieldFactory make;
};

std::vector<RegisteredField> builtin_fields();

}  // namespace kinemesh
