// The triangles that embed a domain in a convex set.
#pragma once

#include <span>
#include <vector>

#include "core/cdt/triangulator.h"
#include "kinemesh/types.h"

namespace kinemesh {

// One constrained Delaunay triangulation of all border edges (the domain to the left of each) and the extra
// points, up to their convex hull; the triangles outside the domain, by winding number, in the points'
// numbers. Doing all loops at once is what makes nested islands and holes that share a vertex come out right.
// Throws NoEmbedding (kinemesh/build.h) where border edges cross, touch, or enclose the domain wrongly.
// `user_number` names the culprits.
std::vector<Triangle> pad(std::span<const Point> points, std::span<const Edge> border,
                          std::span<const Vertex> extra, std::span<const UserVertex> user_number);

}  // namespace kinemesh
