#include "core/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/face_sweep.h"
#include "core/parallel.h"

namespace kinemesh {
namespace {

double twice_area(const std::array<Point, 3>& p) {
  const Point u = p[1] - p[0], v = p[2] - p[1];
  return u.x * v.y - u.y * v.x;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

double smallest(Pair p) {
  return std::min(p[0], p[1]);
}

// Of two faces at a time.
struct Partial {
  Pair area{0.0, 0.0};
  Pair min_area{infinity, infinity};
  Pair min_tangent{infinity, infinity};

  // As tangent_of_smallest_angle.
  void add(const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
    const Pair pu = difference(p[1], p[0]), pv = difference(p[2], p[1]), pw = difference(p[0], p[2]);
    const Pair qu = difference(q[1], q[0]), qv = difference(q[2], q[1]), qw = difference(q[0], q[2]);
    const auto sum = [](Pair of_p, Pair of_q) { return firsts(of_p, of_q) + seconds(of_p, of_q); };
    const Pair turn_p = pu * swapped(pv), turn_q = qu * swapped(qv);
    const Pair cross = firsts(turn_p, turn_q) - seconds(turn_p, turn_q);
    const Pair dot = -smaller(sum(pu * pv, qu * qv), smaller(sum(pv * pw, qv * qw), sum(pw * pu, qw * qu)));
    area += 0.5 * cross;
    min_area = smaller(0.5 * cross, min_area);
    min_tangent = smaller(cross > 0.0 ? cross / dot : Pair{0.0, 0.0}, min_tangent);
  }
  void add(const std::array<Point, 3>& p) {
    const double face_area = 0.5 * twice_area(p);
    area[0] += face_area;
    min_area[0] = std::min(min_area[0], face_area);
    min_tangent[0] = std::min(min_tangent[0], tangent_of_smallest_angle(p));
  }
  void join(const Partial& other) {
    area += other.area;
    min_area = smaller(other.min_area, min_area);
    min_tangent = smaller(other.min_tangent, min_tangent);
  }
};

Partial measure(const Mesh& mesh, int begin, int end) {
  Partial partial;
  int first = none;  // of a pair
  for (int f = begin; f < end; ++f) {
    fetch_ahead(mesh.triangles(), mesh.positions(), f);
    if (mesh.is_padding(f)) continue;
    if (first == none) {
      first = f;
    } else {
      partial.add(mesh.corners(first), mesh.corners(f));
      first = none;
    }
  }
  if (first != none) partial.add(mesh.corners(first));
  return partial;
}

constexpr int grain = 1 << 14;  // faces that are worth a task

}  // namespace

// It has the largest dot product of its sides; twice the area is the cross product of any two.
double tangent_of_smallest_angle(const std::array<Point, 3>& p) {
  const Point u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
  const auto dot = [](const Point& a, const Point& b) { return -(a.x * b.x + a.y * b.y); };
  const double cross = twice_area(p);
  return cross > 0.0 ? cross / std::max({dot(u, v), dot(v, w), dot(w, u)}) : 0.0;
}

Measures measure(const Mesh& mesh) {
  std::array<Partial, most_parts> partial;
  parallel_parts(mesh.n_faces(), grain,
                 [&](int part, int begin, int end) { partial[part] = measure(mesh, begin, end); });
  Partial total;
  for (const auto& part : partial) total.join(part);
  return {total.area[0] + total.area[1], smallest(total.min_area),
          std::atan(smallest(total.min_tangent)) * 180.0 / std::numbers::pi};
}

double mean_spacing(const Mesh& mesh) {
  return std::sqrt(measure(mesh).area / mesh.n_user_vertices());
}

}  // namespace kinemesh
