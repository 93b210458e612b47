#include "motion/border.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_set>
#include <utility>

namespace kinemesh {
namespace {

std::string quoted(const Mesh& mesh, int marker) {
  return marker == none ? "the border without a marker" : "marker \"" + mesh.marker_names()[marker] + "\"";
}

// What slides.
struct SlidingBorder {
  std::vector<SlideLine> lines;
  std::vector<std::string> names;   // what each is a part of
  std::unordered_set<int> corners;  // vertices on lines that do not slide for that alone
};

// What the border says about every vertex, before frame and fixed vertices.
class BorderReader {
 public:
  BorderReader(const Mesh& mesh, const BorderConditions& conditions) : mesh_(mesh), conditions_(conditions) {
    const std::unordered_set<std::string_view> names(mesh.marker_names().begin(), mesh.marker_names().end());
    for (const auto& [name, condition] : conditions.by_marker)
      if (!names.contains(name)) throw ParameterError(name, "the mesh has no marker \"" + name + "\"");
  }

  SlidingBorder read(std::vector<BorderCondition>& at) const {
    std::map<int, std::vector<MeshEdge>> sliding;  // by marker
    const auto apply = [&](const MeshEdge& edge, int marker, BorderCondition condition) {
      for (const Vertex v : edge) at[v] = std::max(at[v], condition);
      if (condition == BorderCondition::Slide) sliding[marker].push_back(edge);
    };
    read_named(apply);
    read_others(apply);
    SlidingBorder border;
    for (const auto& [marker, edges] : sliding) add_lines(marker, edges, border);
    hold_corners(border, at);
    return border;
  }

 private:
  template <class Apply>
  void read_named(const Apply& apply) const {
    for (int marker = 0; marker < static_cast<int>(mesh_.markers().size()); ++marker) {
      const auto named = conditions_.by_marker.find(mesh_.marker_names()[marker]);
      if (named == conditions_.by_marker.end()) continue;
      for (const auto& [from, to] : mesh_.markers()[marker].edges)
        apply({mesh_.vertex_of_user(UserVertex(from)), mesh_.vertex_of_user(UserVertex(to))}, marker,
              named->second);
    }
  }

  template <class Apply>
  void read_others(const Apply& apply) const {
    for (const Constraint& c : mesh_.constraints())
      if (c.is_border() &&
          !(c.marker != none && conditions_.by_marker.contains(mesh_.marker_names()[c.marker])))
        apply({c.from, c.to}, c.marker, conditions_.otherwise);
  }

  void add_lines(int marker, const std::vector<MeshEdge>& edges, SlidingBorder& border) const {
    try {
      for (SlideLine& line : slide_lines(mesh_, edges)) {
        border.lines.push_back(std::move(line));
        border.names.push_back(quoted(mesh_, marker));
      }
    } catch (const InputError& error) {
      throw ParameterError(marker == none ? "default" : mesh_.marker_names()[marker],
                           quoted(mesh_, marker) + " cannot slide: " + error.what());
    }
  }

  // A vertex of two lines slides where they go on in one direction.
  static void hold_corners(SlidingBorder& border, std::vector<BorderCondition>& at) {
    std::unordered_map<int, Point> directions;
    const auto hold = [&](Vertex v) {
      if (std::exchange(at[v], BorderCondition::Fixed) == BorderCondition::Slide) border.corners.insert(v);
    };
    for (const SlideLine& line : border.lines) {
      for (const Vertex v : line.corners()) hold(v);
      for (const auto& [v, direction] : line.ends()) {
        const auto [other, is_first] = directions.emplace(v, direction);
        if (!is_first && !are_parallel(other->second, direction)) hold(v);
      }
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
  SlidingBorder border = BorderReader(mesh, conditions).read(conditions_);
  lines_ = std::move(border.lines);
  names_ = std::move(border.names);
  corners_ = std::move(border.corners);
  for (const Vertex v : mesh.vertices()) {
    if (!mesh.is_fixed(v) && mesh.user_vertex(v) != none) continue;
    conditions_[v] = BorderCondition::Fixed;
    corners_.erase(v);
  }
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (const Vertex v : lines_[i].vertices()) line_of_.emplace(v, static_cast<int>(i));
}

Point Freedom::tangent(Vertex vertex, const Point& x) const {
  return lines_[line_of_.at(vertex)].tangent_near(x);
}

double Freedom::distance_from_line(Vertex vertex, const Point& x) const {
  const SlideLine& line = lines_[line_of_.at(vertex)];
  return glm::distance(x, line.at(line.parameter_near(x)));
}

Point Freedom::on_line(Vertex vertex, const Point& x0, const Point& x1) const {
  return lines_[line_of_.at(vertex)].moved(x0, x1);
}

Point Freedom::along(const Point& tangent, const Point& v) {
  if (tangent.x == 0.0) return {0.0, v.y};
  if (tangent.y == 0.0) return {v.x, 0.0};
  return glm::dot(tangent, v) * tangent;
}

}  // namespace kinemesh
