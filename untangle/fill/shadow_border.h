// The border of X, cut where the faces of R* cross it: steps 1 to 3 of untangle/fill/overlapping_mesher.h.
// For .cpp files only: CGAL.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "untangle/fill/remeshable_set.h"
#include "untangle/fill/surface.h"

namespace kinemesh {

// A part of the border of X, X to its left, as far as one upright face runs across it.
struct SubSegment {
  int from, to;  // vertices
  Face face;     // of the mesh
  Side crease;   // the mesh edge it lies on, by its lower side
};

struct ShadowBorder {
  std::vector<ExactPoint> points;  // by vertex: those of R* by number, then the extra ones
  std::vector<SubSegment> subs;
  std::map<Face, std::vector<int>> subs_of;     // by face: the numbers of its sub-segments
  std::map<Side, std::vector<int>> subs_along;  // likewise, by crease
};

// An end of a sub-segment at the place of a vertex of J is that vertex, any other is an extra one. Nothing if
// two vertices of J lie at the same place, or if the sheets over the border do not tile it exactly once.
// Exact. Deterministic.
std::optional<ShadowBorder> trace_shadow_border(const RemeshableSet& set);

}  // namespace kinemesh
