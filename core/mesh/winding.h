// Winding numbers of closed curves, on a triangulation that has the curves' edges.
#pragma once

#include <vector>

#include "core/cdt/triangulator.h"

namespace kinemesh {

// For each triangle, how often the directed edges 0 .. edges.size() - 1 of the triangulation run
// counter-clockwise around it; its other edges count for nothing. Pre: as many of them enter each point as
// leave it. O(n).
std::vector<int> winding_numbers(const Triangulation& triangulation, std::span<const Edge> edges);

}  // namespace kinemesh
