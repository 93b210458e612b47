#include "core/io/svg_frame.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace kinemesh::io {

SvgFrame::SvgFrame(const ViewBox& view, double width) : view_(view), width_(width) {
  const double w = view.upper.x / 2 - view.lower.x / 2, h = view.upper.y / 2 - view.lower.y / 2;
  scale_ = width / (w > 0 ? w : h > 0 ? h : 1.0);
  height_ = std::clamp(h * scale_, 1.0, 10 * width);
  if (h * scale_ > height_) scale_ = height_ / h;
}

Point SvgFrame::pixel(const Point& p) const {
  const double shift = (width_ - (view_.upper.x / 2 - view_.lower.x / 2) * scale_) / 2;
  return {shift + (p.x / 2 - view_.lower.x / 2) * scale_, (view_.upper.y / 2 - p.y / 2) * scale_};
}

ViewBox whole_view(const MeshData& mesh) {
  ViewBox box{{0, 0}, {1, 1}};
  bool is_first = true;
  const auto add = [&](const Point& p) {
    box.lower = is_first ? p : glm::min(box.lower, p);
    box.upper = is_first ? p : glm::max(box.upper, p);
    is_first = false;
  };
  for (const Triangle& t : mesh.triangles) {
    for (int v : t) add(mesh.points[v]);
  }
  constexpr double room = 0.02;
  const double margin = room * std::max(box.upper.x / 2 - box.lower.x / 2, box.upper.y / 2 - box.lower.y / 2);
  const Point largest(std::numeric_limits<double>::max());
  box.lower = glm::max(box.lower - margin, -largest);
  box.upper = glm::min(box.upper + margin, largest);
  return box;
}

}  // namespace kinemesh::io
