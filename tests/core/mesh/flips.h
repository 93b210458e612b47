// Edge flips written as patches: the smallest change a splice can make.
#pragma once

#include "core/mesh/patch.h"

namespace kinemesh::test {

// Takes the edge of side a -> b, with faces abc and bad, to run from c to d. Pre: a face on either side.
Patch flip_of(const Mesh& mesh, Side side);

// True if the edge has faces on either side and no constraint, and c and d are different vertices and not
// joined already.
bool can_flip(const Mesh& mesh, Side side);

}  // namespace kinemesh::test
