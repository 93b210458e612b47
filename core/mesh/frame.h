// The convex border of the padded mesh: a rectangular frame that follows the domain, or a hull that stays.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/base/box.h"
#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Corners, counter-clockwise from lower left, at `margin` diagonals of the box from it.
std::array<Point, 4> frame_around(const Box& box, double margin);

// The frame follows a drifting domain: where the domain of `mesh` has come closer to it than half its margin,
// or has left more than twice its margin, new corners are written to `next`; otherwise the old ones. Where
// the border at `next` would reach or leave the frame all the same, the corners lie around it. Nothing
// without a frame. A defect where numbers do not go as far as a corner would have to.
[[nodiscard]] std::optional<Defect> follow(const Mesh& mesh, std::span<Point> next);

// Without a frame, the corners of the convex hull have to stay where they are, and its other vertices on the
// straight line between their neighbours of the hull. The first that would not, at the positions `next`;
// nothing with a frame. Exact.
std::optional<Defect> hull_defect(const Mesh& mesh, std::span<const Point> next);

// True if p is neither strictly inside the hull of the mesh nor a position of one of its vertices. Exact,
// O(hull).
bool is_outside_hull(const Mesh& mesh, const Point& p);

}  // namespace kinemesh
