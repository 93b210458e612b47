// Bounding boxes for the spatial indices.
#pragma once

#include <algorithm>
#include <array>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>

#include "kinemesh/types.h"

namespace kinemesh {

using Box = boost::geometry::model::box<boost::geometry::model::d2::point_xy<double>>;

inline Box box_of(const Point& a, const Point& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

inline Box box_of(const std::array<Point, 3>& t) {
  return {{std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})},
          {std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})}};
}

inline Box hull_of(const Box& a, const Box& b) {
  const auto &p = a.min_corner(), &q = b.min_corner(), &r = a.max_corner(), &s = b.max_corner();
  return {{std::min(p.x(), q.x()), std::min(p.y(), q.y())}, {std::max(r.x(), s.x()), std::max(r.y(), s.y())}};
}

// Borders included.
inline bool meet(const Box& a, const Box& b) {
  const auto &p = a.min_corner(), &q = b.min_corner(), &r = a.max_corner(), &s = b.max_corner();
  return p.x() <= s.x() && q.x() <= r.x() && p.y() <= s.y() && q.y() <= r.y();
}

// Pre: the boxes meet.
inline Box common(const Box& a, const Box& b) {
  const auto &p = a.min_corner(), &q = b.min_corner(), &r = a.max_corner(), &s = b.max_corner();
  return {{std::max(p.x(), q.x()), std::max(p.y(), q.y())}, {std::min(r.x(), s.x()), std::min(r.y(), s.y())}};
}

}  // namespace kinemesh
