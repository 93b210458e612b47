// Bounding boxes, borders included.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "kinemesh/types.h"

namespace kinemesh {

struct Box {
  Point low, high;
};

// Of nothing: hull_of(nowhere, box) is the box.
inline constexpr double infinitely_far = std::numeric_limits<double>::infinity();
inline constexpr Box nowhere{{infinitely_far, infinitely_far}, {-infinitely_far, -infinitely_far}};

inline Box box_of(const Point& a, const Point& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

inline Box box_of(const std::array<Point, 3>& t) {
  return {{std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})},
          {std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})}};
}

inline Box hull_of(const Box& a, const Box& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

inline Box hull_of(const Box& a, const Point& p) {
  return hull_of(a, Box{p, p});
}

inline bool meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

// Pre: the boxes meet.
inline Box common(const Box& a, const Box& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

}  // namespace kinemesh
