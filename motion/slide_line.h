// The line along which a border slides: what the border was at the start of the run.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/mesh.h"

namespace kinemesh {

// Whether unit vectors point along the same line, to 1e-9.
bool are_parallel(const Point& a, const Point& b);

// A straight line, or a chain of segments, open or closed. Vertices of the border are parameters on it: lengths from
// its start. Beyond its ends an open line goes on straight.
class SlideLine {
 public:
  // vertices: in their order along the line, two at least; a closed line does not name the first one again.
  SlideLine(const Mesh& mesh, std::vector<int> vertices, bool is_closed);

  std::span<const int> vertices() const { return vertices_; }
  bool is_closed() const { return is_closed_; }
  bool is_straight() const { return is_straight_; }  // within 1e-9 of its length: then one segment

  // Vertices where the line turns by more than 30 degrees.
  std::vector<int> corners() const;

  // First and last vertex of an open line with the unit vectors along it there.
  std::vector<std::pair<int, Point>> ends() const;

  double parameter_near(const Point& x) const;  // of the point of the line that is nearest to x
  Point at(double parameter) const;
  Point tangent_near(const Point& x) const;  // unit vector

  // Where something on the line that has moved from x0 to x1 is: as far along it from x0 as the way goes along the
  // tangent. Horizontal and vertical straight lines give x1, bit by bit.
  Point moved(const Point& x0, const Point& x1) const;

  double length() const { return start_.back(); }

 private:
  std::size_t segment_at(double parameter) const;
  std::size_t n_segments() const { return start_.size() - 1; }

  std::vector<int> vertices_;
  std::vector<Point> points_;  // corner points of the segments; the first one again where it is closed
  std::vector<double> start_;  // parameter of each point
  bool is_closed_, is_straight_ = false;
};

// The lines that edges make up. Throws InputError that names a vertex (the user's number) where more than two meet.
std::vector<SlideLine> slide_lines(const Mesh& mesh, const std::vector<Edge>& edges);

}  // namespace kinemesh
