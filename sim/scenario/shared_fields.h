// Fields as motions ask for them. Internal to sim/.
#pragma once

#include <map>
#include <string>

#include "kinemesh/registry.h"
#include "kinemesh/scenario.h"

namespace kinemesh {

// Motions with the same field and parameters share it, as fields are pure functions: so a file that many of
// them name is read once, and is in memory once.
class SharedFields {
 public:
  AnyField of(const MotionSpec& motion);  // throws what make_field does

 private:
  std::map<std::string, AnyField> known_;  // by all that the motion says of it
};

}  // namespace kinemesh
