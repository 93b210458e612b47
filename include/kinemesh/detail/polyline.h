// A chain of straight segments, and places on it by how far along it they are.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Places are parameters: lengths from the start. Beyond its ends an open line goes on straight.
class Polyline {
 public:
  // Closed if the first point comes again as the last. Throws InputError for fewer than two, and for segments
  // of length 0 or not finite.
  explicit Polyline(std::vector<Point> points);

  std::span<const Point> points() const { return points_; }
  bool is_closed() const { return points_.front() == points_.back(); }
  double length() const { return start_.back(); }

  double parameter_near(const Point& x) const;  // of the point of the line that is nearest to x
  Point at(double parameter) const;
  Point tangent_near(const Point& x) const;  // unit vector

  // From one parameter to another, backwards below 0; on a closed line the shorter way round.
  double way(double from, double to) const;

 private:
  std::size_t segment_at(double parameter) const;
  std::size_t n_segments() const { return start_.size() - 1; }

  std::vector<Point> points_;
  std::vector<double> start_;  // parameter of each point
};

}  // namespace kinemesh
#pragma GCC visibility pop
