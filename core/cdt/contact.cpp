// The search for what touches, run only when a triangulation has failed and the culprits are wanted by name.
#include <map>
#include <tuple>

#include "core/base/box_index.h"
#include "core/cdt/triangulator.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

// Where two segments that touch do so; rounded.
Point meeting_point(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a, v = d - c, w = c - a;
  const double area = cross(u, v);
  if (area == 0.0) return on_segment(a, c, d) ? a : on_segment(b, c, d) ? b : c;
  return a + u * (cross(w, v) / area);
}

std::optional<Contact> coincident_points(std::span<const Point> points) {
  std::map<std::pair<double, double>, int> seen;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const auto [other, fresh] = seen.try_emplace({points[i].x, points[i].y}, i);
    if (!fresh) return Contact{Contact::Kind::CoincidentPoints, other->second, i, points[i]};
  }
  return std::nullopt;
}

class EdgeIndex {
 public:
  EdgeIndex(std::span<const Point> points, std::span<const Edge> edges) : points_(points), edges_(edges) {
    std::vector<NumberedBox> entries;
    entries.reserve(edges.size());
    for (int i = 0; i < static_cast<int>(edges.size()); ++i) entries.emplace_back(box(i), i);
    tree_ = BoxIndex(entries);
  }

  std::optional<Contact> crossing_edges() const {
    for (int i = 0; i < static_cast<int>(edges_.size()); ++i) {
      const int j = smallest(box(i), [&](int k) { return k > i && cross(i, k); });
      if (j == none) continue;
      const auto [a, b] = edges_[i];
      const auto [c, d] = edges_[j];
      return Contact{Contact::Kind::CrossingEdges, i, j,
                     meeting_point(points_[a], points_[b], points_[c], points_[d])};
    }
    return std::nullopt;
  }

  std::optional<Contact> point_on_edge() const {
    for (int p = 0; p < static_cast<int>(points_.size()); ++p) {
      const int e = smallest(box_of(points_[p], points_[p]), [&](int k) { return lies_on(p, k); });
      if (e != none) return Contact{Contact::Kind::PointOnEdge, p, e, points_[p]};
    }
    return std::nullopt;
  }

 private:
  Box box(int edge) const { return box_of(points_[edges_[edge][0]], points_[edges_[edge][1]]); }

  bool cross(int i, int j) const {
    const auto [a, b] = edges_[i];
    const auto [c, d] = edges_[j];
    return segments_cross(points_[a], points_[b], points_[c], points_[d]);
  }

  bool lies_on(int p, int edge) const {
    const auto [a, b] = edges_[edge];
    return p != a && p != b && on_segment(points_[p], points_[a], points_[b]);
  }

  template <class Accept>
  int smallest(const Box& around, const Accept& accept) const {
    int best = none;
    for_each_near(tree_, around, [&](int i) {
      if ((best == none || i < best) && accept(i)) best = i;
    });
    return best;
  }

  std::span<const Point> points_;
  std::span<const Edge> edges_;
  BoxIndex tree_;
};

}  // namespace

std::optional<Contact> find_contact(std::span<const Point> points, std::span<const Edge> edges) {
  if (auto contact = coincident_points(points)) return contact;
  const EdgeIndex index(points, edges);
  if (auto contact = index.crossing_edges()) return contact;
  return index.point_on_edge();
}

}  // namespace kinemesh
