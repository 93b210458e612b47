// The heavy invariants, and the measures of a mesh people ask for first.
#pragma once

#include <optional>

#include "core/defect.h"
#include "core/mesh.h"

namespace kinemesh {

// The first defect in a fixed order: connectivity and mirror, numbering, finite positions, faces upright, convex border
// of the padding, constrained edges present with their labels, coverage. Nothing: the padded mesh is an embedded
// triangulation of its convex hull, and so is the domain of its part. O(n), exact but for the coverage sum.
std::optional<Defect> validate(const Mesh& mesh);

// Only what does not depend on positions: for meshes known to be tangled.
std::optional<Defect> validate_connectivity(const Mesh& mesh);

struct Measures {
  double area = 0.0;           // of the domain, signed
  double min_area = 0.0;       // smallest signed face area
  double min_angle_deg = 0.0;  // smallest angle of any face; 0 for flat ones
};

// Over the domain's faces; rounded. Parallel, independent of the number of threads.
Measures measure(const Mesh& mesh);

// The unit "spacing": sqrt(domain area / vertices).
double mean_spacing(const Mesh& mesh);

}  // namespace kinemesh
