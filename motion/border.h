// What the border of the domain does while the inside moves.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/mesh.h"
#include "motion/parameters.h"

namespace kinemesh {

// By strictness: of two conditions that meet in a vertex the later one holds.
enum class BorderCondition : std::uint8_t { Moving, Slide, Fixed };

// "fixed", "moving" or "slide". Throws ParameterError with the given key.
BorderCondition parse_border_condition(std::string_view name, const std::string& key);

struct BorderConditions {
  // For markers not named here and border edges without a marker.
  BorderCondition otherwise = BorderCondition::Fixed;
  std::map<std::string, BorderCondition> by_marker;  // inner lines, too, where named
};

// How each vertex may move: anywhere, along a straight border, or not at all.
//
// Vertices on no border move freely; so do those of inner markers and of interfaces between labels, which are
// no border, unless their marker is named. Corners of the frame and fixed vertices of the mesh do not move. A
// vertex where two sliding borders of different directions meet does not move.
class Freedom {
 public:
  // Throws ParameterError whose key is the marker: not in the mesh; or sliding, but one of its connected
  // pieces is not straight (a vertex farther from the line through its ends than 1e-9 of their distance),
  // naming the vertex.
  Freedom(const Mesh& mesh, const BorderConditions& conditions);

  BorderCondition of(int vertex) const { return conditions_[vertex]; }

  // The part of `v` that the vertex may follow. Horizontal and vertical borders keep their constant
  // coordinate exactly; on others a vertex leaves the line by rounding, and the border, which is what its
  // vertices make it, with it.
  Point allowed(int vertex, const Point& v) const {
    if (conditions_[vertex] == BorderCondition::Moving) return v;
    return conditions_[vertex] == BorderCondition::Fixed ? Point(0.0, 0.0) : along(tangents_.at(vertex), v);
  }

 private:
  static Point along(const Point& tangent, const Point& v);

  std::vector<BorderCondition> conditions_;  // per vertex
  std::unordered_map<int, Point> tangents_;  // unit vectors of sliding vertices
};

}  // namespace kinemesh
