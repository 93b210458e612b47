#include "motion/segment_index.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace kinemesh {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeSegment = bg::model::segment<TreePoint>;
using Rtree = bgi::rtree<TreeSegment, bgi::linear<16>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

TreePoint to_tree(const Point& p) {
  return {p.x, p.y};
}
Point from_tree(const TreePoint& p) {
  return {bg::get<0>(p), bg::get<1>(p)};
}

}  // namespace

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a, to_p = p - a;
  const double length2 = glm::dot(along, along);
  const double s = length2 > 0.0 ? std::clamp(glm::dot(to_p, along) / length2, 0.0, 1.0) : 0.0;
  return std::min({glm::length(to_p - s * along), glm::distance(p, a), glm::distance(p, b)});
}

struct SegmentIndex::Tree {
  Rtree segments;
};

SegmentIndex::SegmentIndex(std::span<const Point> points, std::span<const Edge> edges)
    : low_(infinity, infinity), high_(-infinity, -infinity) {
  std::vector<TreeSegment> segments;
  segments.reserve(edges.size());
  for (const auto& [from, to] : edges) {
    segments.emplace_back(to_tree(points[from]), to_tree(points[to]));
    low_ = glm::min(low_, glm::min(points[from], points[to]));
    high_ = glm::max(high_, glm::max(points[from], points[to]));
  }
  tree_ = std::make_unique<Tree>(Tree{Rtree(segments)});  // packed: faster to build and to ask
}
SegmentIndex::~SegmentIndex() = default;

double SegmentIndex::distance(const Point& p) const {
  const auto nearest = tree_->segments.qbegin(bgi::nearest(to_tree(p), 1));
  if (nearest == tree_->segments.qend()) return infinity;
  return distance_to_segment(p, from_tree(nearest->first), from_tree(nearest->second));
}

bool SegmentIndex::maybe_within(const Point& p, double reach) const {
  return p.x >= low_.x - reach && p.x <= high_.x + reach && p.y >= low_.y - reach && p.y <= high_.y + reach;
}

}  // namespace kinemesh
