// A step that had no valid mesh, as a file that is enough to do it again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh_state.h"
#include "kinemesh/motion.h"
#include "kinemesh/stepper.h"

namespace kinemesh {

struct FailedStep {
  std::string program;  // its version; only to be told
  std::string source;   // the scenario's file, as given
  std::string message;  // why the run stopped
  std::string detail;   // of the defect, as only what moves the vertices knows it
  StepperOptions options;
  MeshBase base;
  MeshState mesh;            // before the step
  std::vector<Point> moved;  // to where it moves the vertices, in the user's order; may be non-finite
  double time = 0.0, end_time = 0.0;
  int steps_done = 0;
};

// What `stepper` fails to do: mesh, time and number are its own, positions those of the motion. The other
// members are left to the caller. Throws what the motion's fields throw.
FailedStep failed_step(Stepper& stepper, const Motion& motion, double end_time);

// The mesh before the step.
Mesh mesh_before(const FailedStep& step);

// Does it again, without motion: what the run had said, or would have gone on with if this version finds a
// valid mesh, quality included. Throws InputError for a mesh that cannot be made or does not go with the
// options, and what the repair threw.
StepOutcome replay(const FailedStep& step);

// As a file's content; see docs/formats.md.
std::string format_failed_step(const FailedStep& step);
FailedStep parse_failed_step(std::string_view content);  // throws InputError without the file's name

}  // namespace kinemesh
