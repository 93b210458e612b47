// The mesh of a run after any of its steps, from patches.bin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "kinemesh/mesh_data.h"

namespace kinemesh::draw {

struct StepOfRun {
  MeshData mesh;                       // without markers: they are not in that file
  std::vector<std::uint8_t> replaced;  // per face: 1 if the step has replaced it
  double time = 0.0;
};

// Step 0 is the start. Throws InputError: no patches.bin, or not so many steps in it.
StepOfRun step_of_run(const std::filesystem::path& directory, int step);

}  // namespace kinemesh::draw
