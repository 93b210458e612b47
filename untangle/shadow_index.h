// Spatial index over the shadows of the tangled faces.
#pragma once

#include <boost/geometry/index/rtree.hpp>
#include <span>
#include <vector>

#include "core/mesh.h"
#include "untangle/box.h"

namespace kinemesh {

class ShadowIndex {
 public:
  // The closed shadows of `faces` at the mesh's positions.
  ShadowIndex(const Mesh& mesh, std::span<const int> faces);

  // True if `hit(face)` holds for a face whose bounding box meets that of the segment a, b.
  template <class Hit>
  bool any_near(const Point& a, const Point& b, const Hit& hit) const {
    namespace bgi = boost::geometry::index;
    const auto query =
        bgi::intersects(box_of(a, b)) && bgi::satisfies([&](const Entry& e) { return hit(e.second); });
    return tree_.qbegin(query) != tree_.qend();
  }

  // Calls visit(face) for each face whose bounding box meets that of the segment a, b, in no particular
  // order.
  template <class Visit>
  void for_each_near(const Point& a, const Point& b, const Visit& visit) const {
    const auto query = boost::geometry::index::intersects(box_of(a, b));
    for (auto it = tree_.qbegin(query); it != tree_.qend(); ++it) visit(it->second);
  }

 private:
  using Entry = std::pair<Box, int>;

  boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>> tree_;
};

}  // namespace kinemesh
