#include "motion/slide_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <string>

#include "kinemesh/error.h"

namespace kinemesh {
namespace {

// Rounding of coordinates in a file with 10 digits or more; any curve that is resolved at all is farther off.
constexpr double straight_within = 1e-9;

constexpr double corner_cosine = 0.8660254037844387;  // of 30 degrees

// Neighbours along the edges, of each vertex; in the order of vertices, so that lines do not depend on that
// of edges.
using Neighbours = std::map<Vertex, std::set<Vertex>>;

Neighbours neighbours_in(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
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
std::vector<Vertex> take_chain(Vertex first, Neighbours& neighbours) {
  std::vector<Vertex> chain;
  for (Vertex v = first; v != none;) {
    chain.push_back(v);
    const std::set<Vertex> others = neighbours.at(v);
    neighbours.erase(v);
    const auto next = std::ranges::find_if(others, [&](Vertex w) { return neighbours.contains(w); });
    v = next == others.end() ? none : *next;
  }
  return chain;
}

bool is_straight(const Mesh& mesh, std::span<const Vertex> chain) {
  const Point first = mesh.position(chain.front()), last = mesh.position(chain.back());
  const double span = glm::distance(first, last);
  return std::ranges::all_of(chain, [&](Vertex v) {
    return std::abs(cross(last - first, mesh.position(v) - first)) <= straight_within * span * span;
  });
}

std::vector<Point> points_of(const Mesh& mesh, std::span<const Vertex> vertices, bool is_closed) {
  if (!is_closed && is_straight(mesh, vertices))
    return {mesh.position(vertices.front()), mesh.position(vertices.back())};
  std::vector<Point> points;
  for (const Vertex v : vertices) points.push_back(mesh.position(v));
  if (is_closed) points.push_back(points.front());
  return points;
}

// From the lowest number on, of the ends where there are any, the way on which lower ones come first.
void put_in_order(const Mesh& mesh, std::vector<Vertex>& chain, bool is_closed) {
  const auto user = [&](Vertex v) { return mesh.user_vertex(v); };
  if (is_closed) std::rotate(chain.begin(), std::ranges::min_element(chain, {}, user), chain.end());
  const auto begin = chain.begin() + (is_closed ? 1 : 0);
  if (user(*begin) > user(chain.back())) std::reverse(begin, chain.end());
}

}  // namespace

bool are_parallel(const Point& a, const Point& b) {
  return std::abs(cross(a, b)) <= straight_within;
}

SlideLine::SlideLine(const Mesh& mesh, std::vector<Vertex> vertices, bool is_closed)
    : Polyline(points_of(mesh, vertices, is_closed)), vertices_(std::move(vertices)) {}

std::vector<Vertex> SlideLine::corners() const {
  std::vector<Vertex> corners;
  if (is_straight()) return corners;
  const std::size_t n = vertices_.size();
  const auto direction = [&](std::size_t i) { return glm::normalize(points()[i + 1] - points()[i]); };
  for (std::size_t i = is_closed() ? 0 : 1; i < (is_closed() ? n : n - 1); ++i)
    if (glm::dot(direction(i == 0 ? n - 1 : i - 1), direction(i)) < corner_cosine)
      corners.push_back(vertices_[i]);
  return corners;
}

std::vector<std::pair<Vertex, Point>> SlideLine::ends() const {
  if (is_closed()) return {};
  const auto p = points();
  const std::size_t n = p.size();
  return {{vertices_.front(), glm::normalize(p[1] - p[0])},
          {vertices_.back(), glm::normalize(p[n - 1] - p[n - 2])}};
}

Point SlideLine::moved(const Point& x0, const Point& x1) const {
  const Point way = points()[1] - points()[0];
  if (is_straight() && (way.x == 0.0 || way.y == 0.0)) return x1;
  return at(parameter_near(x0) + glm::dot(tangent_near(x0), x1 - x0));
}

std::vector<SlideLine> slide_lines(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  Neighbours neighbours = neighbours_in(mesh, edges);
  const Neighbours all = neighbours;
  std::vector<SlideLine> lines;
  const auto take_line = [&](Vertex first, bool is_closed) {
    std::vector<Vertex> chain = take_chain(first, neighbours);
    if (is_closed || !is_straight(mesh, chain)) put_in_order(mesh, chain, is_closed);
    lines.emplace_back(mesh, std::move(chain), is_closed);
  };
  for (const auto& [v, others] : all)  // open ones from their ends
    if (others.size() == 1 && neighbours.contains(v)) take_line(v, false);
  while (!neighbours.empty()) take_line(neighbours.begin()->first, true);
  return lines;
}

}  // namespace kinemesh
