// Triangulated parts of the plane, which glued together are what takes R*'s place: steps 4 and 5 of
// untangle/fill/overlapping_mesher.h.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "untangle/fill/remeshable_set.h"

namespace kinemesh {

struct ShadowBorder;

// What lies across a side: another face of the same part, a sub-segment's other side, or what is beyond a
// side of the mesh. The others are none.
struct PlaneSide {
  int face = none;
  int sub = none;
  Side mesh_side;
  int constraint = none;  // number of one, or none; none on the border of R*
};

// Counter-clockwise; side k runs from corner k to the next.
struct PlaneFace {
  Triangle corners;  // vertices of the ShadowBorder
  std::array<PlaneSide, 3> sides;
};

using PlanePart = std::vector<PlaneFace>;

// Where parts meet: along a sub-segment, or along a mesh edge between two of the border's vertices.
struct Seam {
  int edge;       // or ~sub-segment
  int low, high;  // vertices; 0 with a sub-segment
  auto operator<=>(const Seam&) const = default;
};

// Pre: the side lies on a sub-segment or on a side of the mesh.
Seam seam_of(const Mesh& mesh, const PlaneFace& face, int side);

// What each face crossed has outside X, in that face's own sheet, by face; last X, with the vertices and the
// constrained edges in R. Nothing in degenerate positions. Exact. Deterministic.
std::optional<std::vector<PlanePart>> triangulate_parts(const RemeshableSet& set, const ShadowBorder& border);

}  // namespace kinemesh
