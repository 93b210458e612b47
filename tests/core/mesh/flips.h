// Edge flips written as patches: the smallest change a splice can make.
#pragma once

#include "kinemesh/mesh.h"

namespace kinemesh::test {

// Takes the edge of `halfedge`, from a to b with faces abc and bad, to run from c to d. Pre: a face on either
// side, no constraint.
Patch flip_of(const Mesh& mesh, int halfedge);

// True if c and d are different vertices and not joined already.
bool can_flip(const Mesh& mesh, int halfedge);

}  // namespace kinemesh::test
