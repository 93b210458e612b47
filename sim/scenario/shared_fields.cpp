#include "sim/scenario/shared_fields.h"

namespace kinemesh {
namespace {

// With its length, so that no two lists of words have the same text.
std::string counted(const std::string& word) {
  return std::to_string(word.size()) + ':' + word;
}

std::string key_of(const MotionSpec& motion) {
  std::string key = counted(motion.field);
  for (const auto& [name, value] : motion.parameters)
    key += counted(name) + std::to_string(value.index()) + counted(to_string(value));
  return key;
}

}  // namespace

AnyField SharedFields::of(const MotionSpec& motion) {
  const std::string key = key_of(motion);
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  return known_.emplace(key, make_field(motion.field, motion.parameters)).first->second;
}

}  // namespace kinemesh
