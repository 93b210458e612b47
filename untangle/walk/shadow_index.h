// Spatial index over the shadows of the tangled faces.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/walk/box_tree.h"

namespace kinemesh {

class ShadowIndex {
 public:
  // The closed shadows of `faces`, ascending, at the mesh's positions. Keeps its memory from one build to the
  // next.
  void build(const Mesh& mesh, std::span<const Face> faces);

  // True if `hit(face)` holds for a face whose bounding box meets that of the segment a, b. Asks in ascending
  // order.
  template <class Hit>
  bool any_near(const Point& a, const Point& b, const Hit& hit) const {
    return tree_.any(box_of(a, b), [&](int i) { return hit(faces_[i]); });
  }

  // The same for several segments within a triangle: what they may meet, as numbers for any_of, ascending.
  void find_near(const std::array<Point, 3>& triangle, std::vector<int>& near) const {
    near.clear();
    tree_.any(box_of(triangle), [&](int i) {
      near.push_back(i);
      return false;
    });
  }
  template <class Hit>
  bool any_of(std::span<const int> near, const Point& a, const Point& b, const Hit& hit) const {
    const Box box = box_of(a, b);
    return std::ranges::any_of(near, [&](int i) { return meet(boxes_[i], box) && hit(faces_[i]); });
  }

 private:
  std::vector<Face> faces_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace kinemesh
