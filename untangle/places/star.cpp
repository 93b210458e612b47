#include "untangle/places/star.h"

#include <algorithm>
#include <limits>

#include "core/mesh/around.h"
#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

constexpr double golden = 0.3819660112501051;
constexpr int line_steps = 40;  // each leaves 0.62 of the range: 4e-9 in the end

bool comes_before(const Point& a, const Point& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

// Exactly on horizontal and vertical lines.
Point along(const Point& x, const Point& direction, double distance) {
  return {direction.x == 0.0 ? x.x : x.x + distance * direction.x,
          direction.y == 0.0 ? x.y : x.y + distance * direction.y};
}

// Where f, which has no maxima but one, is largest between low and high: by golden sections around `best`,
// where it is larger than at both of them.
template <class F>
double maximum(const F& f, double low, double best, double high) {
  double value = f(best);
  for (int step = 0; step < line_steps; ++step) {
    const bool is_left = best - low > high - best;
    const double there = best + golden * ((is_left ? low : high) - best), value_there = f(there);
    double& beyond = is_left ? low : high;
    double& behind = is_left ? high : low;
    if (value_there > value) {
      behind = best;
      best = there;
      value = value_there;
    } else {
      beyond = there;
    }
  }
  return best;
}

}  // namespace

double tangent_from_any_corner(const std::array<Point, 3>& p) {
  const int first =
      comes_before(p[1], p[0]) ? (comes_before(p[2], p[1]) ? 2 : 1) : (comes_before(p[2], p[0]) ? 2 : 0);
  return tangent_of_smallest_angle({p[first], p[(first + 1) % 3], p[(first + 2) % 3]});
}

Star::Star(const Mesh& mesh, Vertex vertex) : x_(mesh.position(vertex)) {
  for_each_neighbour(mesh, vertex, [&](Vertex neighbour, Side side) {
    const Point& end = mesh.position(neighbour);
    if (mesh.has_constraint(side)) constrained_.push_back(end);
    if (mesh.opposite(side) == none) is_on_hull_ = true;
    if (mesh.from(side) == vertex)
      (mesh.is_padding(Mesh::face_of(side)) ? padding_ : link_)
          .push_back({end, mesh.position(mesh.apex(side))});
  });
  const auto first =
      std::ranges::min_element(link_, comes_before, [](const LinkEdge& side) { return side[0]; });
  std::rotate(link_.begin(), first, link_.end());
}

double Star::tangent_at(const Point& x) const {
  double tangent = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : link_) tangent = std::min(tangent, tangent_from_any_corner({x, p, q}));
  return tangent;
}

bool Star::is_upright_at(const Point& x) const {
  const auto is_upright = [&](const LinkEdge& side) {
    return orientation(x, side[0], side[1]) == Orientation::CounterClockwise;
  };
  return std::ranges::all_of(link_, is_upright) && std::ranges::all_of(padding_, is_upright);
}

Point Star::best_place() const {
  return optimal_point({link_.data(), link_.size()}, x_);
}

// Ways to the other ends of the two constrained edges.
std::array<double, 2> Star::range_along(const Point& direction) const {
  const double a = dot(constrained_[0] - x_, direction), b = dot(constrained_[1] - x_, direction);
  return {std::min(a, b), std::max(a, b)};
}

bool Star::may_move_along(const Point& direction) const {
  const bool is_slanted = direction.x != 0.0 && direction.y != 0.0;
  if (constrained_.size() != 2 || (is_on_hull_ && is_slanted)) return false;
  const auto [low, high] = range_along(direction);
  return low < 0.0 && high > 0.0;
}

// at(way): the place so far from the vertex.
template <class At>
Point Star::best_between(double low, double high, const At& at) const {
  return at(maximum([&](double way) { return tangent_at(at(way)); }, low, 0.0, high));
}

std::optional<Point> Star::best_place_along(const Point& direction) const {
  if (!may_move_along(direction)) return std::nullopt;
  const auto [low, high] = range_along(direction);
  return best_between(low, high, [&](double way) { return along(x_, direction, way); });
}

std::optional<Point> Star::best_place_on(const Polyline& curve) const {
  if (constrained_.size() != 2 || is_on_hull_) return std::nullopt;
  const double here = curve.parameter_near(x_);
  const double a = curve.way(here, curve.parameter_near(constrained_[0]));
  const double b = curve.way(here, curve.parameter_near(constrained_[1]));
  const auto [low, high] = std::minmax(a, b);
  if (!(low < 0.0 && high > 0.0)) return std::nullopt;
  return best_between(low, high, [&](double way) { return curve.at(here + way); });
}

}  // namespace kinemesh
