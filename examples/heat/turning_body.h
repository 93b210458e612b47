// The domain of the heat example: a unit square with a round body that turns inside it.
#pragma once

#include <vector>

#include "kinemesh/mesh_data.h"

namespace heat {

using kinemesh::MeshData;
using kinemesh::Point;

inline constexpr int medium = 0, body = 1;  // labels

struct TurningBody {
  Point centre{0.5, 0.5};
  double radius = 0.25;
  double rate = 0.0;  // radians per time, counter-clockwise

  // Of the material with this label.
  Point velocity(const Point& x, int label) const;
  // Where the material of the body that was at x at time 0 is at time t.
  Point turned(const Point& x, double t) const;
};

// Vertices at distance h from each other, more or less; the body's outline and the square's sides are edges.
MeshData square_with_body(const TurningBody& shape, double h);

// The vertices of the body, its outline with them.
std::vector<int> body_vertices(const MeshData& mesh);

}  // namespace heat
