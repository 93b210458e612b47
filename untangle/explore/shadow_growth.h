// Growing the shadow of a local exploration.
#pragma once

#include "kinemesh/mesh.h"
#include "untangle/explore/convex_pieces.h"
#include "untangle/explore/sheets.h"

namespace kinemesh {

// Adds the extended shadow G(J): pairs of upright sheets, both lifts in R of a point of the border of X, are
// walked outward together while both stay upright, and each pair adds the overlap of its shadows to X.
// Reads only faces that belong to R once the new pieces have been walked. Pre: nothing is left to walk, so
// that the border of X runs along shadows of crease edges of J. [Agarwal 2008, §4, Lemma 4.2]
void grow_shadow(const Mesh& mesh, Sheets& sheets, ConvexPieces& pieces);

}  // namespace kinemesh
