// The order in which a mesh keeps its vertices: near in the plane, near in memory.
#pragma once

#include <span>
#include <vector>

#include "core/base/box.h"

namespace kinemesh {

// The points' numbers along Hilbert's curve through the square over the box: by 64-bit keys of their
// positions, 2^32 cells on a side, and where these are equal by number. So the order of two points depends on
// the box and on them alone. Points beyond the box count as on its border. Pre: finite.
std::vector<int> order_along_curve(std::span<const Point> points, const Box& box);

}  // namespace kinemesh
