// From a scenario's words to a mesh and its motion. Errors are InputErrors with the scenario's file and line.
#pragma once

#include <string>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"
#include "kinemesh/scenario.h"
#include "kinemesh/stepper.h"

#pragma GCC visibility push(default)
namespace kinemesh {

struct SetUp {
  Mesh mesh;
  Motion motion;
  std::vector<std::string> notes;  // of the mesh's reader
};

// By what [repair] says; a quality pass moves no vertex of a body, and those of sliding borders along them.
StepperOptions stepper_options(const RepairSpec& repair, const Motion& motion);

// Post: the mesh is valid, every marker and label the scenario names is in it, and no border that is part of
// a convex hull without frame moves. Throws InputError otherwise.
SetUp set_up(const Scenario& scenario);

// The same for a mesh that is there already.
SetUp set_up(const Scenario& scenario, Mesh mesh);

}  // namespace kinemesh
#pragma GCC visibility pop
