// Vertices that may move along a line only.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

struct SlidingVertex {
  Vertex vertex;
  Point tangent;  // unit vector
};

// Those of a mesh, ascending.
class SlidingVertices {
 public:
  explicit SlidingVertices(int n_vertices) : is_sliding_(n_vertices, false) {}

  void add(Vertex vertex, const Point& tangent) {  // ascending
    is_sliding_[vertex] = true;
    vertices_.push_back({vertex, tangent});
  }
  bool empty() const { return vertices_.empty(); }
  bool contains(Vertex vertex) const { return is_sliding_[vertex]; }
  const Point& tangent(Vertex vertex) const { return within(vertex, vertex + 1).front().tangent; }

  // Those from begin on and below end.
  std::span<const SlidingVertex> within(int begin, int end) const {
    const auto below = [](const SlidingVertex& s, int vertex) { return s.vertex < vertex; };
    const auto first = std::lower_bound(vertices_.begin(), vertices_.end(), begin, below);
    return {first, std::lower_bound(first, vertices_.end(), end, below)};
  }

  // Of the vectors of vertices begin to end, the part that these may follow.
  void project(int begin, int end, std::span<Point> vectors) const {
    for (const auto& [vertex, tangent] : within(begin, end))
      vectors[vertex] = tangent * glm::dot(tangent, vectors[vertex]);
  }

 private:
  std::vector<char> is_sliding_;  // per vertex
  std::vector<SlidingVertex> vertices_;
};

}  // namespace kinemesh
