// The rectangle around the domain whose corners are part of the padding, so that the domain's border can move.
#pragma once

#include <array>
#include <span>

#include "core/mesh.h"

namespace kinemesh {

// Corners, counter-clockwise from lower left, at `margin` bounding-box diagonals from the bounding box of `points`.
std::array<Point, 4> frame_around(std::span<const Point> points, double margin);

// The frame follows a drifting domain: where the domain of `mesh` has come closer to it than half its margin, or has
// shrunk away, writes new corners to `next`. Depends on the mesh's positions alone.
void follow(const Mesh& mesh, std::span<Point> next);

}  // namespace kinemesh
