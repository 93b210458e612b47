// The two ends of an edge in an order that does not depend on its direction.
#pragma once

#include <algorithm>
#include <array>

namespace kinemesh {

template <class Number>
std::array<Number, 2> ascending(const std::array<Number, 2>& ends) {
  return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

}  // namespace kinemesh
