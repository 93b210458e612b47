#include "untangle/places/max_min_area.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/box.h"

namespace kinemesh {
namespace {

// A function with a smaller gradient is a constant, up to rounding: gradients of areas are the link's edges,
// in a box of size 1.
constexpr double no_gradient = 1e-14;

// splitmix64: any fixed order that no mesh is made for.
std::uint64_t random_bits(std::uint64_t i) {
  i += 0x9e3779b97f4a7c15;
  i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9;
  i = (i ^ (i >> 27)) * 0x94d049bb133111eb;
  return i ^ (i >> 31);
}

template <class T>
void shuffle(std::vector<T>& items) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random_bits(i) % i]);
}

Box bounding_box(std::span<const LinkEdge> link) {
  Box box = nowhere;
  for (const auto& [from, to] : link) box = hull_of(box, box_of(from, to));
  return box;
}

}  // namespace

std::optional<Point> MaxMinArea::operator()(std::span<const LinkEdge> link) {
  if (link.empty()) return std::nullopt;
  const auto box = bounding_box(link);
  const Point centre = 0.5 * box.low + 0.5 * box.high, extent = box.high - box.low;
  const double size = std::max(extent.x, extent.y);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;

  areas_.clear();
  for (const auto& [from, to] : link) {
    const Point p = (from - centre) / size, q = (to - centre) / size, e = q - p;
    areas_.push_back({Point(-e.y, e.x), cross(p, q)});
  }
  shuffle(areas_);
  half_ = 0.5 / size * extent;
  Point x = best_corner(areas_.front().g);
  const auto area = [&](std::size_t i) { return dot(areas_[i].g, x) + areas_[i].c; };
  for (std::size_t n = 1, tight = 0; n < areas_.size(); ++n) {
    if (area(n) >= area(tight)) continue;
    x = best_on_face(areas_[tight = n], n);
  }
  return centre + size * x;
}

Point MaxMinArea::best_corner(const Point& direction) const {
  return {std::copysign(half_.x, direction.x), std::copysign(half_.y, direction.y)};
}

// The place where f is largest of those at which the first n areas are no less than f.
Point MaxMinArea::best_on_face(const Linear& f, std::size_t n) {
  sides_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const Point g = areas_[i].g - f.g;
    if (dot(g, g) > no_gradient * no_gradient) sides_.push_back({g, areas_[i].c - f.c});
  }
  Point x = best_corner(f.g);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (dot(sides_[i].g, x) + sides_[i].c < 0.0) x = best_on_line(sides_[i], f.g, i);
  }
  return x;
}

// The place on the line, in the box and on the right side of the first n lines, that is furthest that way. If
// rounding leaves none, it is about in the middle between those that part.
Point MaxMinArea::best_on_line(const Linear& line, const Point& direction, std::size_t n) const {
  const Point start = -line.c / dot(line.g, line.g) * line.g, way{-line.g.y, line.g.x};
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  const auto keep = [&](double slope, double value) {  // slope s + value >= 0
    if (slope > 0.0) low = std::max(low, -value / slope);
    if (slope < 0.0) high = std::min(high, -value / slope);
  };
  keep(way.x, start.x + half_.x);
  keep(-way.x, half_.x - start.x);
  keep(way.y, start.y + half_.y);
  keep(-way.y, half_.y - start.y);
  for (std::size_t i = 0; i < n; ++i) keep(dot(sides_[i].g, way), dot(sides_[i].g, start) + sides_[i].c);
  if (!(low <= high)) return start + 0.5 * (low + high) * way;
  return start + (dot(direction, way) > 0.0 ? high : low) * way;
}

}  // namespace kinemesh
