// New upright faces for a locally removable region whose border overlaps itself in the plane.
#pragma once

#include <optional>
#include <span>

#include "kinemesh/mesh.h"
#include "untangle/fill/new_faces.h"
#include "untangle/fill/remeshable_set.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// The construction of Lemma 3.3 [Agarwal 2008], in exact arithmetic. While other tangles remain, the border
// of R* may overlap itself although that of R does not: f is a bijection between the borders of R and of
// X = f(J) (Lemma 3.1).
// Trace (untangle/fill/shadow_border.h):
//   1. The border of X is what no other piece covers of the crease edges' shadows.
//   2. The upright faces that cross it cut it into sub-segments, each the image of a part of the border of R.
//   3. Where these end are extra vertices, unless a vertex of J is there.
// Triangulate (untangle/fill/plane_parts.h):
//   4. What each face crossed has outside X is triangulated in that face's own sheet,
//   5. and X, with the vertices in R, in the plane.
// Glue (untangle/fill/part_gluing.h):
//   6. The triangulations are glued along mesh edges and sub-segments.
//   7. The extra vertices are removed: the star of each is upright and gets a triangulation without it.
// The paper takes fewer points into X; here every end of a sub-segment is one, which comes out the same.
// Nothing in degenerate positions in which this does not work out. Pre: `cells` are those of R over the
// inverted faces of J.
std::optional<NewFaces> mesh_overlapping(const Mesh& mesh, const FaceSets& sets, int set,
                                         std::span<const Cell> cells);

}  // namespace kinemesh
