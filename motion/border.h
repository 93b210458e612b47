// What the border of the domain does while the inside moves.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"
#include "motion/slide_line.h"

namespace kinemesh {

// "fixed", "moving" or "slide". Throws ParameterError with the given key.
BorderCondition parse_border_condition(std::string_view name, const std::string& key);

// How each vertex may move: anywhere, along a line, or not at all.
//
// Vertices on no border move freely; so do those of inner markers and of interfaces between labels, which are
// no border, unless their marker is named. Corners of the frame and fixed vertices of the mesh do not move.
// Sliding vertices follow the line that their border was at the start (motion/slide_line.h), corners of more
// than 30 degrees apart, which do not move; nor do vertices where two sliding borders of different directions
// meet.
class Freedom {
 public:
  // mesh: at the start of the run. Throws ParameterError whose key is the marker: not in the mesh; or
  // sliding, but three or more of its edges meet in a vertex, which it names.
  Freedom(const Mesh& mesh, const BorderConditions& conditions);

  BorderCondition of(Vertex vertex) const { return conditions_[vertex]; }

  // It is fixed only since its border slides in two directions there.
  bool is_corner(Vertex vertex) const { return corners_.contains(vertex); }

  // The part of `v` that the vertex at x may follow. Horizontal and vertical borders keep their constant
  // coordinate exactly; on others a vertex leaves the line by rounding, until it is put back by on_line.
  Point allowed(Vertex vertex, const Point& x, const Point& v) const {
    if (conditions_[vertex] == BorderCondition::Moving) return v;
    return conditions_[vertex] == BorderCondition::Fixed ? Point(0.0, 0.0) : along(tangent(vertex, x), v);
  }

  // Of a sliding vertex: unit vector along its line at x.
  Point tangent(Vertex vertex, const Point& x) const;

  // Where a sliding vertex that has moved from x0 to x1 is on its line: the way along it counts. Straight
  // horizontal and vertical lines keep x1 bit by bit.
  Point on_line(Vertex vertex, const Point& x0, const Point& x1) const;

  // Of a vertex on a line: from x to the nearest point of it; and which border that is, `marker "top"`.
  double distance_from_line(Vertex vertex, const Point& x) const;
  const std::string& border_of(Vertex vertex) const { return names_[line_of_.at(vertex)]; }

  std::span<const SlideLine> lines() const { return lines_; }

 private:
  static Point along(const Point& tangent, const Point& v);

  std::vector<BorderCondition> conditions_;  // per vertex
  std::vector<SlideLine> lines_;
  std::vector<std::string> names_;  // of the border that each line is a part of
  std::unordered_set<int> corners_;
  std::unordered_map<int, int> line_of_;  // of sliding vertices
};

}  // namespace kinemesh
