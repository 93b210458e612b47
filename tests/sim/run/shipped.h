// Scenarios that come with the program, and layers/, which came with it before bodies: borders that move
// within a layer, and tangle, as those of bodies do not.
#pragma once

#include <filesystem>
#include <string>

namespace kinemesh::test {

// By the name in examples/scenarios, or by layers/NAME.
inline std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(KINEMESH_SOURCE_DIR) /
         (name.starts_with("layers/") ? "tests/sim/run" : "examples/scenarios") / (name + ".toml");
}

}  // namespace kinemesh::test
