// Steps that tangle a mesh but not its borders and interfaces, taken in every way there is.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "kinemesh/stepper.h"

namespace kinemesh::test {

// Two labels, 7 and 3, to the left and right of x = 0.25; a hole in the middle: regions reach padding and
// interfaces.
MeshData two_labels(int n);

Stepper stepper_on(const MeshData& data, const StepperOptions& options);  // with a frame

// On two_labels(12): moves the vertices on no border and no interface by up to `kick`, each on its side.
std::vector<Point> kicked(const Stepper& stepper, double kick, std::mt19937& random);

// Strategies that always end valid, with each quality, retaining and not.
std::vector<StepperOptions> all_ways();
std::string name_of(const StepperOptions& options);

}  // namespace kinemesh::test
