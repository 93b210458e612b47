// Which vertices a motion acts on, and how strongly: weights, measured once on the initial mesh.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"

namespace kinemesh {

// One weight in [0, 1] per vertex of the mesh; empty: 1 everywhere. Rounded. Throws ParameterError (key "on")
// for a marker or label the mesh does not have. Cost: O(n log m) for m edges that are named, in parallel.
std::vector<double> weights(const Mesh& mesh, const Restriction& restriction);

}  // namespace kinemesh
