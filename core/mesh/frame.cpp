#include "core/mesh/frame.h"

#include <algorithm>
#include <cmath>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

double diagonal(const Box& box) {
  return std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

// True if the hull turns at its vertex i.
bool is_corner(const Mesh& mesh, std::size_t i) {
  const auto hull = mesh.hull();
  const Point& before = mesh.position(hull[(i + hull.size() - 1) % hull.size()]);
  const Point& after = mesh.position(hull[(i + 1) % hull.size()]);
  return orientation(before, mesh.position(hull[i]), after) != Orientation::Collinear;
}

// A valid domain is inside its border.
Box domain_box(const Mesh& mesh) {
  Box box = nowhere;
  for (const auto& constraint : mesh.constraints()) {
    if (constraint.is_border()) box = hull_of(box, mesh.position(constraint.from));
  }
  return box;
}

// A step that is longer than the frame is deep takes the frame with it, be it to where no numbers go.
void enlarge(const Mesh& mesh, std::span<Point> next) {
  Box box = nowhere;
  for (const auto& constraint : mesh.constraints())
    if (constraint.is_border()) box = hull_of(box, next[constraint.from]);
  const Point low = next[mesh.frame()[0]], high = next[mesh.frame()[2]];
  const bool is_inside = low.x < box.low.x && low.y < box.low.y && box.high.x < high.x && box.high.y < high.y;
  if (is_inside) return;
  const auto fresh = frame_around(box, mesh.frame_margin());
  for (int i = 0; i < 4; ++i) next[mesh.frame()[i]] = fresh[i];
}

std::optional<Defect> non_finite_corner(const Mesh& mesh, std::span<const Point> next) {
  for (const Vertex corner : mesh.frame()) {
    if (is_finite(next[corner])) continue;
    return Defect{.kind = DefectKind::NonFinitePosition,
                  .vertices = {none},
                  .where = mesh.position(corner),
                  .detail = "the frame cannot follow, a smaller frame or smaller coordinates expected"};
  }
  return std::nullopt;
}

}  // namespace

std::array<Point, 4> frame_around(const Box& box, double margin) {
  const double d = margin * diagonal(box);
  return {Point{box.low.x - d, box.low.y - d}, Point{box.high.x + d, box.low.y - d},
          Point{box.high.x + d, box.high.y + d}, Point{box.low.x - d, box.high.y + d}};
}

std::optional<Defect> follow(const Mesh& mesh, std::span<Point> next) {
  if (mesh.frame().empty()) return std::nullopt;
  const auto box = domain_box(mesh);
  const Point low = mesh.position(mesh.frame()[0]), high = mesh.position(mesh.frame()[2]);
  const auto gaps = {box.low.x - low.x, box.low.y - low.y, high.x - box.high.x, high.y - box.high.y};
  const double margin = mesh.frame_margin() * diagonal(box);
  const bool stays = std::min(gaps) >= 0.5 * margin && std::max(gaps) <= 2.0 * margin;
  const auto fresh = frame_around(box, mesh.frame_margin());
  for (int i = 0; i < 4; ++i) {
    const Vertex corner = mesh.frame()[i];
    next[corner] = stays ? mesh.position(corner) : fresh[i];
  }
  enlarge(mesh, next);
  return non_finite_corner(mesh, next);
}

std::optional<Defect> hull_defect(const Mesh& mesh, std::span<const Point> next) {
  if (!mesh.frame().empty()) return std::nullopt;
  const auto hull = mesh.hull();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vertex v = hull[i];
    if (next[v] == mesh.position(v)) continue;
    const Point& before = next[hull[(i + hull.size() - 1) % hull.size()]];
    const Point& after = next[hull[(i + 1) % hull.size()]];
    const bool between = next[v] != before && next[v] != after && on_segment(next[v], before, after);
    if (between && !is_corner(mesh, i)) continue;
    return Defect{.kind = DefectKind::HullMoved, .vertices = {mesh.user_vertex(v)}, .where = next[v]};
  }
  return std::nullopt;
}

bool is_outside_hull(const Mesh& mesh, const Point& p) {
  const auto hull = mesh.hull();
  if (std::any_of(hull.begin(), hull.end(), [&](Vertex v) { return mesh.position(v) == p; })) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point& a = mesh.position(hull[i]);
    const Point& b = mesh.position(hull[(i + 1) % hull.size()]);
    if (orientation(a, b, p) != Orientation::CounterClockwise) return true;
  }
  return false;
}

}  // namespace kinemesh
