// Channel and airfoil: Delaunay refinement under a size that grows away from the body.
#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "core/cdt/refine.h"
#include "core/mesh/sides.h"
#include "core/shapes/shape_parts.h"
#include "kinemesh/predicates.h"
#include "kinemesh/shapes.h"

namespace kinemesh {
namespace {

// A smooth piece of the border.
struct Piece {
  std::string marker;
  std::function<Point(double)> at;  // t in [0, 1]
};

struct Domain {
  std::vector<std::string> markers;  // in the mesh's order
  std::vector<std::vector<Piece>>
      loops;  // closed: a piece ends where the next starts; the domain to the left
  Point in_hole;
  SizeField size;  // up to a common factor
};

struct BorderPoint {
  Point p;
  const Piece* piece;
  double t;
};

struct Border {
  std::vector<BorderPoint> points;
  std::vector<int> next;  // around the loop
};

// Points of the piece, but its end, such that the integral of ds / size between two of them is the same.
void sample(const Piece& piece, const SizeField& size, std::vector<BorderPoint>& out) {
  constexpr int n_steps = 20000;
  constexpr double step_in_sizes = 0.8;  // the refinement's edges are about that long
  std::vector<double> distance{0.0};     // in sizes
  Point last = piece.at(0.0);
  for (int i = 1; i <= n_steps; ++i) {
    const Point next = piece.at(static_cast<double>(i) / n_steps);
    distance.push_back(distance.back() +
                       std::hypot(next.x - last.x, next.y - last.y) / size(0.5 * (last + next)));
    last = next;
  }
  const int n = std::max(2, static_cast<int>(std::ceil(distance.back() / step_in_sizes)));
  for (int i = 0, step = 0; i < n; ++i) {
    const double target = distance.back() * i / n;
    while (distance[step + 1] <= target) ++step;
    const double t = (step + (target - distance[step]) / (distance[step + 1] - distance[step])) / n_steps;
    out.push_back({piece.at(t), &piece, t});
  }
}

Border sample(const Domain& domain, const SizeField& size) {
  Border border;
  for (const auto& loop : domain.loops) {
    const int first = static_cast<int>(border.points.size());
    for (const Piece& piece : loop) sample(piece, size, border.points);
    const int end = static_cast<int>(border.points.size());
    for (int i = first; i < end; ++i) border.next.push_back(i + 1 == end ? first : i + 1);
  }
  return border;
}

// The vertex after each border vertex, the domain to the left; none for the others.
std::vector<int> border_successors(const Refinement& mesh) {
  const auto opposite = pair_sides(mesh.triangles, static_cast<int>(mesh.points.size())).opposite;
  std::vector<int> next(mesh.points.size(), none);
  for (int side = 0; side < static_cast<int>(opposite.size()); ++side) {
    const auto [a, b] = ends_of_side(mesh.triangles, side);
    if (opposite[side] == none) next[a] = b;
  }
  return next;
}

// The vertices by which the refinement split the border's edge at `from`.
std::vector<int> splits(const std::vector<int>& next, int from, int n_given) {
  std::vector<int> result;
  for (int v = next[from]; v >= n_given; v = next[v]) result.push_back(v);
  return result;
}

// Moves vertices that lie on chords of the border to its curves; back where that would invert a face.
void project(Refinement& mesh, const Border& border, const std::vector<int>& next) {
  std::map<int, Point> before;
  const int n = static_cast<int>(border.points.size());
  for (int i = 0; i < n; ++i) {
    const BorderPoint &a = border.points[i], &b = border.points[border.next[i]];
    const double end = b.piece == a.piece && b.t > a.t ? b.t : 1.0;
    for (const int v : splits(next, i, n)) {
      Point& p = mesh.points[v];
      before[v] = p;
      const double part = std::hypot(p.x - a.p.x, p.y - a.p.y) / std::hypot(b.p.x - a.p.x, b.p.y - a.p.y);
      p = a.piece->at(a.t + part * (end - a.t));
    }
  }
  for (bool again = true; again;) {
    again = false;
    for (const Triangle& t : mesh.triangles) {
      if (orientation(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) ==
          Orientation::CounterClockwise)
        continue;
      for (const int v : t) {
        if (before.contains(v)) mesh.points[v] = before[v];
      }
      again = true;
    }
  }
}

Marker& marker_named(MeshData& mesh, const std::string& name) {
  return *std::find_if(mesh.markers.begin(), mesh.markers.end(),
                       [&](const Marker& m) { return m.name == name; });
}

void mark(MeshData& mesh, const Border& border, const std::vector<int>& next) {
  const int n = static_cast<int>(border.points.size());
  for (int i = 0; i < n; ++i) {
    auto& edges = marker_named(mesh, border.points[i].piece->marker).edges;
    int from = i;
    for (const int v : splits(next, i, n)) {
      edges.push_back({from, v});
      from = v;
    }
    edges.push_back({from, border.next[i]});
  }
}

MeshData mesh_at_scale(const Domain& domain, double scale) {
  const SizeField size = [&](const Point& p) { return scale * domain.size(p); };
  const Border border = sample(domain, size);
  std::vector<Point> points;
  std::vector<Edge> edges;
  for (int i = 0; i < static_cast<int>(border.points.size()); ++i) {
    points.push_back(border.points[i].p);
    edges.push_back({i, border.next[i]});
  }
  Refinement refined = refine(points, edges, domain.in_hole, size);
  const std::vector<int> next = border_successors(refined);
  project(refined, border, next);
  MeshData mesh;
  mesh.points = std::move(refined.points);
  mesh.triangles = std::move(refined.triangles);
  for (const std::string& name : domain.markers) mesh.markers.push_back({name, {}});
  mark(mesh, border, next);
  return mesh;
}

// The number of vertices goes with 1 / scale^2, nearly; each trial corrects the factor.
MeshData mesh_of_size(const Domain& domain, int vertices) {
  constexpr int max_trials = 8;
  double factor = 1.43;  // found for big meshes of both domains
  std::optional<MeshData> best;
  const auto error = [&](const MeshData& mesh) { return std::abs(mesh.n_vertices() - vertices); };
  for (int trial = 0; trial < max_trials && (!best || error(*best) > 0.05 * vertices); ++trial) {
    const double scale = std::sqrt(factor / vertices);
    MeshData mesh = mesh_at_scale(domain, scale);
    factor = mesh.n_vertices() * scale * scale;
    if (!best || error(mesh) < error(*best)) best = std::move(mesh);
  }
  return std::move(*best);
}

std::function<Point(double)> straight(Point a, Point b) {
  return [a, b](double t) {
    return Point{t < 1.0 ? a.x + t * (b.x - a.x) : b.x, t < 1.0 ? a.y + t * (b.y - a.y) : b.y};
  };
}

std::function<Point(double)> circle(Point centre, double radius, bool clockwise) {
  return [=](double t) { return centre + on_circle(radius, clockwise ? -t : t); };
}

// Along the section from x = 0 to 1 (upper side) or back (lower side); smooth at both ends.
Point section(double t, bool upper) {
  const double x =
      t <= 0.0 || t >= 1.0 ? std::clamp(t, 0.0, 1.0) : 0.5 - 0.5 * std::cos(std::numbers::pi * t);
  return {x, upper ? naca0012_half_thickness(x) : 0.0 - naca0012_half_thickness(x)};
}

double distance(const Point& p, const Point& q) {
  return std::hypot(p.x - q.x, p.y - q.y);
}

// From the section, roughly: above and below it measured vertically.
double distance_to_section(const Point& p) {
  if (p.x < 0.0) return distance(p, {0.0, 0.0});
  if (p.x > 1.0) return distance(p, {1.0, 0.0});
  return std::max(0.0, std::abs(p.y) - naca0012_half_thickness(p.x));
}

}  // namespace

double naca0012_half_thickness(double x) {
  const double t = 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
  return std::max(0.0, t);  // rounding leaves -3e-17 at the trailing edge
}

MeshData make_channel(int vertices) {
  require_vertices("channel", vertices, 200);
  const Point a{0.0, 0.0}, b{4.0, 0.0}, c{4.0, 1.0}, d{0.0, 1.0};
  Domain domain;
  domain.markers = {"inlet", "outlet", "bottom", "top", "cylinder"};
  domain.loops.push_back({{"bottom", straight(a, b)},
                          {"outlet", straight(b, c)},
                          {"top", straight(c, d)},
                          {"inlet", straight(d, a)}});
  domain.loops.push_back({{"cylinder", circle(cylinder_centre, cylinder_radius, true)}});
  domain.in_hole = cylinder_centre;
  domain.size = [](const Point& p) {
    const double away = std::max(0.0, distance(p, cylinder_centre) - cylinder_radius);
    return std::min(4.0, 1.0 + 3.0 * away);
  };
  return mesh_of_size(domain, vertices);
}

MeshData make_airfoil(int vertices) {
  require_vertices("airfoil", vertices, 400);
  const Point middle{0.5, 0.0};
  Domain domain;
  domain.markers = {"airfoil", "farfield"};
  domain.loops.push_back({{"airfoil", [](double t) { return section(t, true); }},
                          {"airfoil", [](double t) { return section(1.0 - t, false); }}});
  domain.loops.push_back({{"farfield", circle(middle, 15.0, false)}});
  domain.in_hole = middle;
  domain.size = [](const Point& p) {
    const double to_ends = std::min(distance(p, {0.0, 0.0}), distance(p, {1.0, 0.0}));
    return std::min(1.0, 0.25 + 3.0 * to_ends) + 10.0 * distance_to_section(p);
  };
  return mesh_of_size(domain, vertices);
}

}  // namespace kinemesh
