// A spatial index of numbered boxes: Boost's R-tree. For .cpp files and for headers that few include:
// expensive.
#pragma once

#include <boost/geometry/geometries/register/box.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>

#include "core/base/box.h"

BOOST_GEOMETRY_REGISTER_POINT_2D(kinemesh::Point, double, boost::geometry::cs::cartesian, x, y)
BOOST_GEOMETRY_REGISTER_BOX(kinemesh::Box, kinemesh::Point, low, high)

namespace kinemesh {

using NumberedBox = std::pair<Box, int>;
using BoxIndex = boost::geometry::index::rtree<NumberedBox, boost::geometry::index::linear<16>>;

// Calls visit(number) for the boxes that meet this one, in no particular order.
template <class Visit>
void for_each_near(const BoxIndex& index, const Box& box, const Visit& visit) {
  for (auto it = index.qbegin(boost::geometry::index::intersects(box)); it != index.qend(); ++it)
    visit(it->second);
}

// True if is_wanted(number) holds for one of them.
template <class Predicate>
bool any_near(const BoxIndex& index, const Box& box, const Predicate& is_wanted) {
  namespace bgi = boost::geometry::index;
  const auto query = bgi::intersects(box) &&
                     bgi::satisfies([&](const NumberedBox& numbered) { return is_wanted(numbered.second); });
  return index.qbegin(query) != index.qend();
}

}  // namespace kinemesh
