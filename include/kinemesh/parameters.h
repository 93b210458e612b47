// Parameters of a field as a scenario gives them: by name, typed, not yet checked.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// An integer stands for a number wherever a number is expected.
using ParameterValue =
    std::variant<double, std::int64_t, std::vector<double>, std::vector<Point>, std::string>;
using FieldParameters = std::map<std::string, ParameterValue, std::less<>>;

// A parameter that is unknown, missing, of the wrong type or out of range. what() is a whole sentence; key()
// tells a reader of scenarios which line to name.
class ParameterError : public InputError {
 public:
  ParameterError(const std::string& key, const std::string& what) : InputError(what), key_(key) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace kinemesh
#pragma GCC visibility pop
