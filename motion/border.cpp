#include "motion/border.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_set>
#include <utility>

namespace kinemesh {
namespace {

// Rounding of coordinates in a file with 10 digits or more; any curve that is resolved at all is farther off.
constexpr double straight_within = 1e-9;

double cross(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

std::string quoted(const Mesh& mesh, int marker) {
  return marker == none ? "the border without a marker" : "marker \"" + mesh.marker_names()[marker] + "\"";
}

// Vertices of each connected piece of the edges.
std::vector<std::vector<int>> pieces_of(const std::vector<Edge>& edges) {
  std::unordered_map<int, std::vector<int>> neighbours;
  for (const auto& [from, to] : edges) {
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
  std::unordered_map<int, bool> seen;
  std::vector<std::vector<int>> pieces;
  for (const auto& edge : edges) {
    if (seen[edge[0]]) continue;
    auto& piece = pieces.emplace_back(1, edge[0]);
    seen[edge[0]] = true;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const int w : neighbours[piece[i]])
        if (!std::exchange(seen[w], true)) piece.push_back(w);
  }
  return pieces;
}

int farthest_from(int vertex, const std::vector<int>& piece, std::span<const Point> x) {
  return *std::max_element(piece.begin(), piece.end(), [&](int v, int w) {
    return glm::distance(x[v], x[vertex]) < glm::distance(x[w], x[vertex]);
  });
}

// Unit vector along a straight piece; throws for a bent one.
Point direction_of(const Mesh& mesh, int marker, const std::vector<int>& piece) {
  const auto x = mesh.positions();
  const int a = farthest_from(piece.front(), piece, x), b = farthest_from(a, piece, x);
  const double length = glm::distance(x[a], x[b]);
  const Point unit = (x[b] - x[a]) / length;
  for (const int v : piece)
    if (!(std::abs(cross(unit, x[v] - x[a])) <= straight_within * length))
      throw ParameterError(marker == none ? "default" : mesh.marker_names()[marker],
                           quoted(mesh, marker) + " cannot slide: it is not straight at vertex " +
                               std::to_string(mesh.user_vertex(v)) + ", and only a straight border can");
  return unit;
}

// What the border says about every vertex, before frame and fixed vertices.
class BorderReader {
 public:
  BorderReader(const Mesh& mesh, const BorderConditions& conditions) : mesh_(mesh), conditions_(conditions) {
    const std::unordered_set<std::string_view> names(mesh.marker_names().begin(), mesh.marker_names().end());
    for (const auto& [name, condition] : conditions.by_marker)
      if (!names.contains(name)) throw ParameterError(name, "the mesh has no marker \"" + name + "\"");
  }

  void read(std::vector<BorderCondition>& at, std::unordered_map<int, Point>& tangents) const {
    std::map<int, std::vector<Edge>> sliding;  // by marker
    const auto apply = [&](const Edge& edge, int marker, BorderCondition condition) {
      for (const int v : edge) at[v] = std::max(at[v], condition);
      if (condition == BorderCondition::Slide) sliding[marker].push_back(edge);
    };
    read_named(apply);
    read_others(apply);
    for (const auto& [marker, edges] : sliding)
      for (const auto& piece : pieces_of(edges))
        slide(piece, direction_of(mesh_, marker, piece), at, tangents);
  }

 private:
  template <class Apply>
  void read_named(const Apply& apply) const {
    for (int marker = 0; marker < static_cast<int>(mesh_.markers().size()); ++marker) {
      const auto named = conditions_.by_marker.find(mesh_.marker_names()[marker]);
      if (named == conditions_.by_marker.end()) continue;
      for (const auto& [from, to] : mesh_.markers()[marker].edges)
        apply({mesh_.vertex_of_user(from), mesh_.vertex_of_user(to)}, marker, named->second);
    }
  }

  template <class Apply>
  void read_others(const Apply& apply) const {
    for (const Constraint& c : mesh_.constraints())
      if (c.is_border() &&
          !(c.marker != none && conditions_.by_marker.contains(mesh_.marker_names()[c.marker])))
        apply({c.from, c.to}, c.marker, conditions_.otherwise);
  }

  static void slide(const std::vector<int>& piece, const Point& direction, std::vector<BorderCondition>& at,
                    std::unordered_map<int, Point>& tangents) {
    for (const int v : piece) {
      const auto [other, is_first] = tangents.emplace(v, direction);
      if (!is_first && std::abs(cross(other->second, direction)) > straight_within)
        at[v] = BorderCondition::Fixed;
    }
  }

  const Mesh& mesh_;
  const BorderConditions& conditions_;
};

}  // namespace

BorderCondition parse_border_condition(std::string_view name, const std::string& key) {
  if (name == "fixed") return BorderCondition::Fixed;
  if (name == "moving") return BorderCondition::Moving;
  if (name == "slide") return BorderCondition::Slide;
  throw ParameterError(key, "border condition \"" + std::string(name) + "\" of \"" + key +
                                "\" is unknown, expected fixed, moving or slide");
}

Freedom::Freedom(const Mesh& mesh, const BorderConditions& conditions)
    : conditions_(mesh.n_vertices(), BorderCondition::Moving) {
  BorderReader(mesh, conditions).read(conditions_, tangents_);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.is_fixed(v) || mesh.user_vertex(v) == none) conditions_[v] = BorderCondition::Fixed;
}

Point Freedom::along(const Point& tangent, const Point& v) {
  if (tangent.x == 0.0) return {0.0, v.y};
  if (tangent.y == 0.0) return {v.x, 0.0};
  return glm::dot(tangent, v) * tangent;
}

}  // namespace kinemesh
