#include "kinemesh/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/parallel.h"
#include "core/sweep/face_minima.h"

namespace kinemesh {
namespace {

// Two sums that do not wait for each other.
using Sums = std::array<double, 2>;

Sums areas(const Mesh& mesh, int begin, int end) {
  Sums sums{};
  int n = 0;
  for (Face f(begin); f < end; ++f)
    if (!mesh.is_padding(f)) sums[n++ % 2] += 0.5 * twice_area(mesh.corners(f));
  return sums;
}

double area(const Mesh& mesh) {
  std::array<Sums, most_parts> parts{};
  parallel_parts(mesh.n_faces(), grain::items,
                 [&](int part, int begin, int end) { parts[part] = areas(mesh, begin, end); });
  Sums total{};
  for (const Sums& sums : parts)
    for (int i = 0; i < 2; ++i) total[i] += sums[i];
  return total[0] + total[1];
}

}  // namespace

double twice_area(const std::array<Point, 3>& p) {
  return cross(p[0] - p[2], p[1] - p[2]);
}

// It has the largest dot product of its sides: those at the last corner, the first and the second are uv,
// uu - uv and vv - uv. Twice the area is the cross product of any two.
double tangent_of_smallest_angle(const std::array<Point, 3>& p) {
  const Point u = p[0] - p[2], v = p[1] - p[2];
  const double cross = twice_area(p), uv = dot(u, v), far = std::max(dot(u, u), dot(v, v)) - uv;
  return cross > 0.0 ? cross / (uv > far ? uv : far) : 0.0;  // as a sweep has it, what overflows included
}

Measures measure(const Mesh& mesh) {
  FaceMinima minima;
  minima.reset(mesh.n_faces());
  const auto [twice_area, tangent] = minima.update(mesh);
  return {area(mesh), 0.5 * twice_area, degrees(tangent)};
}

double degrees(double tangent) {
  return std::atan(tangent) * 180.0 / std::numbers::pi;
}

double mean_spacing(const Mesh& mesh) {
  return std::sqrt(area(mesh) / mesh.n_user_vertices());
}

}  // namespace kinemesh
