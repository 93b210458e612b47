// The faces around a vertex, as functions of its place, and the place that is best for their angles.
#pragma once

#include <boost/container/small_vector.hpp>
#include <optional>

#include "kinemesh/detail/polyline.h"
#include "kinemesh/mesh.h"
#include "untangle/places/optimal_point.h"

namespace kinemesh {

// Of an upright triangle's smallest angle, as tangent_of_smallest_angle (kinemesh/measure.h) but for
// rounding: the same bits, whichever of its corners comes first.
double tangent_from_any_corner(const std::array<Point, 3>& corners);

// Does not depend on how the mesh is stored, neither on the order of faces, vertices and corners nor on where
// the fan begins. Takes memory for vertices of very many faces only.
class Star {
 public:
  Star(const Mesh& mesh, Vertex vertex);

  // The tangent of the smallest angle of the domain's faces, were the vertex at x: 0 if one is not upright,
  // as far as rounding tells; infinity if there are none. Rounded.
  double tangent_at(const Point& x) const;

  // Padding, too. Exact.
  bool is_upright_at(const Point& x) const;

  // Whether the vertex may leave its place for another on the line through it: strictly between the other
  // ends of the two constrained edges here, which lie along it. Not on a slanted line that is the convex
  // border of the whole mesh, which rounded places would leave.
  bool may_move_along(const Point& direction) const;

  // Where tangent_at is largest, up to rounding and stopping short of negligible gains: of all places, or of
  // those along the direction; nothing if it may not move along it. Pre: a valid mesh.
  Point best_place() const;
  std::optional<Point> best_place_along(const Point& direction) const;

  // Likewise on a curve that the vertex is on, strictly between the other ends of the two constrained edges;
  // where tangent_at has several maxima, one of them. Nothing on the convex border of the whole mesh.
  std::optional<Point> best_place_on(const Polyline& curve) const;

 private:
  std::array<double, 2> range_along(const Point& direction) const;
  template <class At>
  Point best_between(double low, double high, const At& at) const;

  using Link = boost::container::small_vector<LinkEdge, 12>;

  Point x_;
  Link link_;                                             // of the domain's faces
  Link padding_;                                          // of the others
  boost::container::small_vector<Point, 2> constrained_;  // other ends of constrained edges
  bool is_on_hull_ = false;
};

}  // namespace kinemesh
