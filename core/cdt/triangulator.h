// Constrained Delaunay triangulation of points and edges as plain arrays; CGAL stays behind it, in one source
// file.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

// Of the convex hull of the points. Triangles are counter-clockwise; side k runs from corner k to corner k
// + 1.
struct Triangulation {
  std::vector<Triangle> triangles;   // numbers of input points
  std::vector<Triangle> neighbours;  // across side k: triangle, or none outside the hull
  std::vector<Triangle> edges;       // on side k: number of an input edge, or none

  void clear();
};

// Why there is no triangulation with these points and edges. Where several reasons hold: the first in this
// order, and of those the one with the smallest numbers.
struct Contact {
  enum class Kind { CoincidentPoints, CrossingEdges, PointOnEdge };
  Kind kind;
  int first;   // point, edge, point
  int second;  // point, edge, edge
  Point where;
};

class Triangulator {
 public:
  Triangulator();
  ~Triangulator();
  Triangulator(Triangulator&&) noexcept;
  Triangulator& operator=(Triangulator&&) noexcept;

  // Exact. Deterministic: the same input gives the same output. Edges may repeat (the first number is
  // reported) and share ends; other contacts fail. Points on no edge and edges of no triangle are allowed
  // where the hull is flat: the result then has no triangles. Post on failure: `out` is unspecified.
  [[nodiscard]] std::optional<Contact> triangulate(std::span<const Point> points, std::span<const Edge> edges,
                                                   Triangulation& out);

  // Spent in CGAL's insertions and nothing else, over all calls.
  double milliseconds() const { return milliseconds_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double milliseconds_ = 0.0;
};

// Searches for a contact directly; nothing if the edges and points touch only where edges share end points.
std::optional<Contact> find_contact(std::span<const Point> points, std::span<const Edge> edges);

// The points' numbers along a Hilbert curve.
std::vector<int> hilbert_order(std::span<const Point> points);

}  // namespace kinemesh
