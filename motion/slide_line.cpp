#include "motion/slide_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "core/error.h"

namespace kinemesh {
namespace {

// Rounding of coordinates in a file with 10 digits or more; any curve that is resolved at all is farther off.
constexpr double straight_within = 1e-9;

constexpr double corner_cosine = 0.8660254037844387;  // of 30 degrees

double cross(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

// Neighbours along the edges, of each vertex; in the order of vertices, so that lines do not depend on that of edges.
using Neighbours = std::map<int, std::set<int>>;

Neighbours neighbours_in(const Mesh& mesh, const std::vector<Edge>& edges) {
  Neighbours neighbours;
  for (const auto& [from, to] : edges) {
    neighbours[from].insert(to);
    neighbours[to].insert(from);
  }
  for (const auto& [v, others] : neighbours)
    if (others.size() > 2)
      throw InputError("more than two of its edges meet at vertex " + std::to_string(mesh.user_vertex(v)));
  return neighbours;
}

// From a vertex on, until it ends or comes back; takes the vertices out.
std::vector<int> take_chain(int first, Neighbours& neighbours) {
  std::vector<int> chain;
  for (int v = first; v != none;) {
    chain.push_back(v);
    const std::set<int> others = neighbours.at(v);
    neighbours.erase(v);
    const auto next = std::ranges::find_if(others, [&](int w) { return neighbours.contains(w); });
    v = next == others.end() ? none : *next;
  }
  return chain;
}

}  // namespace

bool are_parallel(const Point& a, const Point& b) {
  return std::abs(cross(a, b)) <= straight_within;
}

SlideLine::SlideLine(const Mesh& mesh, std::vector<int> vertices, bool is_closed)
    : vertices_(std::move(vertices)), is_closed_(is_closed) {
  for (const int v : vertices_) points_.push_back(mesh.position(v));
  const Point first = points_.front(), last = points_.back();
  const double span = glm::distance(first, last);
  is_straight_ = !is_closed_ && std::ranges::all_of(points_, [&](const Point& p) {
    return std::abs(cross(last - first, p - first)) <= straight_within * span * span;
  });
  if (is_straight_) points_ = {first, last};
  if (is_closed_) points_.push_back(first);
  start_.push_back(0.0);
  for (std::size_t i = 1; i < points_.size(); ++i)
    start_.push_back(start_.back() + glm::distance(points_[i - 1], points_[i]));
}

std::vector<int> SlideLine::corners() const {
  std::vector<int> corners;
  if (is_straight_) return corners;
  const std::size_t n = vertices_.size();
  const auto direction = [&](std::size_t i) { return glm::normalize(points_[i + 1] - points_[i]); };
  for (std::size_t i = is_closed_ ? 0 : 1; i < (is_closed_ ? n : n - 1); ++i)
    if (glm::dot(direction(i == 0 ? n - 1 : i - 1), direction(i)) < corner_cosine)
      corners.push_back(vertices_[i]);
  return corners;
}

std::vector<std::pair<int, Point>> SlideLine::ends() const {
  if (is_closed_) return {};
  const std::size_t n = points_.size();
  return {{vertices_.front(), glm::normalize(points_[1] - points_[0])},
          {vertices_.back(), glm::normalize(points_[n - 1] - points_[n - 2])}};
}

double SlideLine::parameter_near(const Point& x) const {
  double best = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n_segments(); ++i) {
    const double length = start_[i + 1] - start_[i];
    const Point along = (points_[i + 1] - points_[i]) / length;
    const bool goes_on_before = !is_closed_ && i == 0, goes_on_behind = !is_closed_ && i + 1 == n_segments();
    double s = glm::dot(along, x - points_[i]);
    if (!goes_on_before) s = std::max(s, 0.0);
    if (!goes_on_behind) s = std::min(s, length);
    const double distance = glm::distance(x, points_[i] + s * along);
    if (distance < nearest) {
      nearest = distance;
      best = start_[i] + s;
    }
  }
  return best;
}

std::size_t SlideLine::segment_at(double parameter) const {
  const auto behind = std::upper_bound(start_.begin(), start_.end(), parameter);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(behind - start_.begin(), 1)) - 1;
  return std::min(i, n_segments() - 1);
}

Point SlideLine::at(double parameter) const {
  if (is_closed_) {
    parameter = std::fmod(parameter, length());
    if (parameter < 0.0) parameter += length();
  }
  const std::size_t i = segment_at(parameter);
  const double share = (parameter - start_[i]) / (start_[i + 1] - start_[i]);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

Point SlideLine::tangent_near(const Point& x) const {
  const std::size_t i = segment_at(is_straight_ ? 0.0 : parameter_near(x));
  return (points_[i + 1] - points_[i]) / (start_[i + 1] - start_[i]);
}

Point SlideLine::moved(const Point& x0, const Point& x1) const {
  const Point way = points_[1] - points_[0];
  if (is_straight_ && (way.x == 0.0 || way.y == 0.0)) return x1;
  return at(parameter_near(x0) + glm::dot(tangent_near(x0), x1 - x0));
}

std::vector<SlideLine> slide_lines(const Mesh& mesh, const std::vector<Edge>& edges) {
  Neighbours neighbours = neighbours_in(mesh, edges);
  const Neighbours all = neighbours;
  std::vector<SlideLine> lines;
  for (const auto& [v, others] : all)  // open ones from their ends
    if (others.size() == 1 && neighbours.contains(v))
      lines.emplace_back(mesh, take_chain(v, neighbours), false);
  while (!neighbours.empty())
    lines.emplace_back(mesh, take_chain(neighbours.begin()->first, neighbours), true);
  return lines;
}

}  // namespace kinemesh
