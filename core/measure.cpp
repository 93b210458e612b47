#include "core/measure.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kinemesh {
namespace {

double twice_area(const std::array<Point, 3>& p) {
  const Point u = p[1] - p[0], v = p[2] - p[1];
  return u.x * v.y - u.y * v.x;
}

struct Partial {
  double area = 0.0;
  double min_area = std::numeric_limits<double>::infinity();
  double min_tangent = std::numeric_limits<double>::infinity();

  void add(const std::array<Point, 3>& p) {
    const double face_area = 0.5 * twice_area(p);
    area += face_area;
    min_area = std::min(min_area, face_area);
    min_tangent = std::min(min_tangent, tangent_of_smallest_angle(p));
  }
  void join(const Partial& other) {
    area += other.area;
    min_area = std::min(min_area, other.min_area);
    min_tangent = std::min(min_tangent, other.min_tangent);
  }
};

constexpr int grain =
    1 << 14;  // fixed, so that sums are taken in the same order whatever the number of threads

}  // namespace

// It has the largest dot product of its sides; twice the area is the cross product of any two.
double tangent_of_smallest_angle(const std::array<Point, 3>& p) {
  const Point u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
  const auto dot = [](const Point& a, const Point& b) { return -(a.x * b.x + a.y * b.y); };
  const double cross = twice_area(p);
  return cross > 0.0 ? cross / std::max({dot(u, v), dot(v, w), dot(w, u)}) : 0.0;
}

Measures measure(const Mesh& mesh) {
  const auto total = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<int>(0, mesh.n_faces(), grain), Partial{},
      [&](const tbb::blocked_range<int>& range, Partial partial) {
        for (int f = range.begin(); f != range.end(); ++f) {
          if (!mesh.is_padding(f)) partial.add(mesh.corners(f));
        }
        return partial;
      },
      [](Partial a, const Partial& b) {
        a.join(b);
        return a;
      });
  return {total.area, total.min_area, std::atan(total.min_tangent) * 180.0 / std::numbers::pi};
}

double mean_spacing(const Mesh& mesh) {
  return std::sqrt(measure(mesh).area / mesh.n_user_vertices());
}

}  // namespace kinemesh
