// The line along which a border slides: what the border was at the start of the run.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "kinemesh/detail/polyline.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Whether unit vectors point along the same line, to 1e-9.
bool are_parallel(const Point& a, const Point& b);

// A straight line, or a chain of segments, open or closed. Vertices of the border are parameters on it.
class SlideLine : public Polyline {
 public:
  // vertices: in their order along the line, two at least; a closed line does not name the first one again.
  SlideLine(const Mesh& mesh, std::vector<Vertex> vertices, bool is_closed);

  std::span<const Vertex> vertices() const { return vertices_; }
  bool is_straight() const { return points().size() == 2; }  // within 1e-9 of its length: then one segment

  // All but the ends of an open line.
  std::span<const Vertex> inner_vertices() const {
    return is_closed() ? vertices() : vertices().subspan(1, vertices_.size() - 2);
  }

  // Vertices where the line turns by more than 30 degrees.
  std::vector<Vertex> corners() const;

  // First and last vertex of an open line with the unit vectors along it there.
  std::vector<std::pair<Vertex, Point>> ends() const;

  // Where something on the line that has moved from x0 to x1 is: as far along it from x0 as the way goes
  // along the tangent. Horizontal and vertical straight lines give x1, bit by bit.
  Point moved(const Point& x0, const Point& x1) const;

 private:
  std::vector<Vertex> vertices_;
};

// The lines that edges make up, curved ones the same however the mesh is stored. Throws InputError that names
// a vertex (the user's number) where more than two meet.
std::vector<SlideLine> slide_lines(const Mesh& mesh, const std::vector<MeshEdge>& edges);

}  // namespace kinemesh
