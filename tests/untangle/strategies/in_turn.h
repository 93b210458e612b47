// What must hold when tangles are untangled one seed after the other.
#pragma once

#include <string>

#include "kinemesh/mesh.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {

// Untangles a copy locally, seeds and options at random, until nothing is tangled: each region goes away
// without a trace outside it, and in the end the mesh is valid if and only if global untangling finds one.
// What is wrong, in a sentence, or nothing.
std::string check_in_turn(const Mesh& tangled, Random& random);

}  // namespace kinemesh::test
