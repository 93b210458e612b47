// How a strategy that may fail says so.
#pragma once

#include <string>

#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"
#include "untangle/walk/detect.h"

namespace kinemesh {

// Names the face that is inverted or flat with the smallest of the user's numbers (one of the padding if none
// is of the domain), as the mesh is now, and how many there are. `who` is stuck: "edge flips". Pre: some are.
Defect stuck_defect(const Mesh& mesh, const Tangles& left, const std::string& who);

// Whether a repair failed for such a reason: a face it could not turn. Then another strategy may find a mesh.
inline bool is_stuck(const Defect& defect) {
  return defect.kind == DefectKind::InvertedFace || defect.kind == DefectKind::FlatFace;
}

}  // namespace kinemesh
