#include "untangle/fill/surface.h"

#include <algorithm>

namespace kinemesh {
namespace {

// A corner of a polygon, and what lies outside of the side that starts there.
struct Corner {
  int vertex;
  int mate;
  int constraint;
};
using Polygon = std::vector<Corner>;

constexpr int open = std::numeric_limits<int>::min();  // a mate that is to be glued later

CGAL::Orientation turn(const Surface& s, int a, int b, int c) {
  return CGAL::orientation(s.points[a], s.points[b], s.points[c]);
}

// Strictly convex, and no other corner in the closed triangle.
bool is_ear(const Surface& s, const Polygon& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  const int a = polygon[(i + n - 1) % n].vertex, b = polygon[i].vertex, c = polygon[(i + 1) % n].vertex;
  if (turn(s, a, b, c) != CGAL::LEFT_TURN) return false;
  return std::none_of(polygon.begin(), polygon.end(), [&](const Corner& corner) {
    const int v = corner.vertex;
    if (v == a || v == b || v == c) return false;
    return turn(s, a, b, v) != CGAL::RIGHT_TURN && turn(s, b, c, v) != CGAL::RIGHT_TURN &&
           turn(s, c, a, v) != CGAL::RIGHT_TURN;
  });
}

void close_side(Surface& s, int side, const Corner& outside) {
  s.constraints[side] = outside.constraint;
  if (outside.mate != open) s.glue(side, outside.mate);
}

// Fills the polygon with faces, ear by ear. Returns the side that got the open mate; none if there is no ear.
int fill(Surface& s, Polygon polygon) {
  int opened = none;
  const auto close = [&](int side, const Corner& outside) {
    close_side(s, side, outside);
    if (outside.mate == open) opened = side;
  };
  while (polygon.size() >= 3) {
    const std::size_t n = polygon.size();
    std::size_t i = 0;
    while (i < n && !is_ear(s, polygon, i)) ++i;
    if (i == n) return none;
    auto& before = polygon[(i + n - 1) % n];
    const auto& after = polygon[(i + 1) % n];
    const int side = s.add_face(before.vertex, polygon[i].vertex, after.vertex);
    close(side, before);
    close(side + 1, polygon[i]);
    if (n == 3) {
      close(side + 2, after);
      break;
    }
    before.mate = side + 2;
    before.constraint = none;
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return opened == none ? 0 : opened;
}

// The polygon from corner i to corner j, closed by an open side from j to i.
Polygon part(const Polygon& polygon, std::size_t i, std::size_t j, int constraint) {
  Polygon result;
  for (std::size_t k = i; k != j; k = (k + 1) % polygon.size()) result.push_back(polygon[k]);
  result.push_back({polygon[j].vertex, open, constraint});
  return result;
}

}  // namespace

int Surface::add_face(int a, int b, int c) {
  const int side = static_cast<int>(corners.size());
  corners.insert(corners.end(), {a, b, c});
  mates.insert(mates.end(), 3, open);
  constraints.insert(constraints.end(), 3, none);
  alive.push_back(true);
  return side;
}

void Surface::glue(int side, int mate) {
  mates[side] = mate;
  if (mate >= 0) mates[mate] = side;
}

bool Surface::remove_vertex(int side) {
  Polygon link;
  std::vector<std::size_t> constrained;  // corners of the link to which a constrained edge runs
  int constraint = none;
  for (int spoke = side;;) {
    const int outer = next(spoke);
    if (constraints[spoke] != none) {
      constraint = constraints[spoke];
      constrained.push_back(link.size());
    }
    link.push_back({corners[outer], mates[outer], constraints[outer]});
    alive[spoke / 3] = false;
    spoke = mates[prev(spoke)];
    if (spoke < 0) return false;  // a vertex of the border
    if (spoke == side) break;
  }
  if (constrained.empty()) return fill(*this, std::move(link)) != none;
  if (constrained.size() != 2) return false;
  const int left = fill(*this, part(link, constrained[0], constrained[1], constraint));
  const int right = fill(*this, part(link, constrained[1], constrained[0], constraint));
  if (left == none || right == none) return false;
  glue(left, right);
  return true;
}

}  // namespace kinemesh
