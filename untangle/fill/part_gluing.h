// From parts of the plane to the faces that take R*'s place: steps 6 and 7 of
// untangle/fill/overlapping_mesher.h.
#pragma once

#include <optional>
#include <span>

#include "untangle/fill/new_faces.h"
#include "untangle/fill/plane_parts.h"
#include "untangle/fill/remeshable_set.h"

namespace kinemesh {

// Glues the parts along their seams and removes the border's extra vertices. Nothing unless every seam has
// two sides, every star can do without its extra vertex, and what comes out has as many faces as R* and the
// same border. Exact. Deterministic.
std::optional<NewFaces> glue_parts(const RemeshableSet& set, const ShadowBorder& border,
                                   std::span<const PlanePart> parts);

}  // namespace kinemesh
