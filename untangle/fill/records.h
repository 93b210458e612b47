// Turns a region's faces into the line that is logged of it.
#pragma once

#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"
#include "untangle/fill/hole.h"
#include "untangle/walk/detect.h"

namespace kinemesh {

// Detects, and records how much there is and how long that took.
Tangles detect(const Mesh& mesh, const Move& move, RepairRecord& record);

// Fills what follows from the faces alone (faces, user_faces, seed, inverted, degenerate, components,
// crease_edges, explored, border_edges, centre). To be called before anything is spliced.
RegionRecord describe_region(const Mesh& mesh, const Hole& region);

// The order of regions in a record: by the number users know their seed by, those of padding only at the end.
bool is_seeded_before(const RegionRecord& a, const RegionRecord& b);

// Vertices on no constrained edge that lie in another label than their home. None unless that is allowed.
int count_escaped(const Mesh& mesh, const RepairOptions& options);

}  // namespace kinemesh
