// The heavy invariants: what every mesh must hold, and the culprit where one does not.
#pragma once

#include <optional>

#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// The first defect in a fixed order: connectivity, numbering, constrained edges with their labels,
// finite positions, faces upright, convex border of the padding, coverage. Nothing: the padded mesh is an
// embedded triangulation of its convex hull, and so is the domain of its part. O(n); exact but for the
// coverage sum.
std::optional<Defect> validate(const Mesh& mesh);

// Only what does not depend on positions: what holds for tangled meshes too.
std::optional<Defect> validate_connectivity(const Mesh& mesh);

}  // namespace kinemesh
#pragma GCC visibility pop
