// Which of two triangles has the larger signed area, exactly.
#pragma once

#include <array>

#include "kinemesh/types.h"

namespace kinemesh {

// Sign of the signed area of s minus that of t: -1, 0 or 1; clockwise triangles have negative area. Doubles
// under an error bound, and rational arithmetic where the bound does not tell. Pre: finite coordinates.
int compare_areas(const std::array<Point, 3>& s, const std::array<Point, 3>& t);

}  // namespace kinemesh
