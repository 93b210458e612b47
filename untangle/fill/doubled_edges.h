// Edges with the same two ends: possible while a mesh is tangled elsewhere, and better avoided.
#pragma once

#include "kinemesh/mesh.h"
#include "untangle/fill/new_faces.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// Flips inner edges of the new faces whose ends another edge joins already, outside the set, on its border or
// among the new faces, where the other diagonal of the two faces is free and both stay upright. Returns how
// many remain doubled. Looks at the edges around the border's vertices, not at any face outside.
// Deterministic.
int avoid_doubled_edges(const Mesh& mesh, const FaceSets& sets, int set, NewFaces& faces);

}  // namespace kinemesh
