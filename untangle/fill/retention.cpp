#include "untangle/fill/retention.h"

#include <algorithm>

#include "core/base/box_index.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

class Choice {
 public:
  Choice(const Mesh& mesh, const std::vector<Face>& faces) : mesh_(mesh), faces_(faces) {
    index_vertices();
    is_clear_.reserve(faces.size());
    for (const Face face : faces) is_clear_.push_back(is_clear(face));
    find_components();
  }

  std::vector<Face> kept() {
    std::vector<Face> all;
    for (const auto& component : components_) {
      for (const Face face : component) {
        if (overlaps_kept(face)) continue;
        kept_index_.insert({box_of(mesh_.corners(face)), face});
        all.push_back(face);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  void index_vertices() {
    std::vector<Vertex> vertices;
    for (const Face face : faces_) {
      const auto& t = mesh_.triangles()[face];
      vertices.insert(vertices.end(), t.begin(), t.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<NumberedBox> entries;
    for (const Vertex v : vertices) entries.emplace_back(box_of(mesh_.position(v), mesh_.position(v)), v);
    vertex_index_ = BoxIndex(entries);  // packed
  }

  bool is_clear(Face face) const {
    const auto p = mesh_.corners(face);
    if (orientation(p[0], p[1], p[2]) != Orientation::CounterClockwise) return false;
    const auto blocks = [&](int number) {
      const Vertex vertex(number);
      const auto& t = mesh_.triangles()[face];
      if (std::find(t.begin(), t.end(), vertex) != t.end()) return false;
      const Point& q = mesh_.position(vertex);
      return orientation(p[0], p[1], q) != Orientation::Clockwise &&
             orientation(p[1], p[2], q) != Orientation::Clockwise &&
             orientation(p[2], p[0], q) != Orientation::Clockwise;
    };
    return !any_near(vertex_index_, box_of(p), blocks);
  }

  // Of clear faces; the largest first, then by the smallest face.
  void find_components() {
    std::vector<bool> is_found(faces_.size(), false);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (is_clear_[i] && !is_found[i]) components_.push_back(component_of(i, is_found));
    }
    std::stable_sort(components_.begin(), components_.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
  }

  std::vector<Face> component_of(std::size_t first, std::vector<bool>& is_found) const {
    std::vector<Face> component{faces_[first]};
    is_found[first] = true;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const Side side : mesh_.sides(component[next])) {
        const auto beyond = std::lower_bound(faces_.begin(), faces_.end(), mesh_.face_across(side));
        if (beyond == faces_.end() || *beyond != mesh_.face_across(side)) continue;
        const auto i = beyond - faces_.begin();
        if (!is_clear_[i] || is_found[i]) continue;
        is_found[i] = true;
        component.push_back(*beyond);
      }
    }
    return component;
  }

  bool overlaps_kept(Face face) const {
    const auto corners = mesh_.corners(face);
    return any_near(kept_index_, box_of(corners),
                    [&](int kept) { return interiors_overlap(corners, mesh_.corners(Face(kept))); });
  }

  const Mesh& mesh_;
  const std::vector<Face>& faces_;
  BoxIndex vertex_index_, kept_index_;
  std::vector<bool> is_clear_;  // beside faces_: upright, and no other vertex in the shadow
  std::vector<std::vector<Face>> components_;
};

}  // namespace

bool Retention::run(const Mesh& mesh, const std::vector<Face>& faces) {
  kept_ = Choice(mesh, faces).kept();
  if (kept_.empty()) return false;
  rest_.reset(mesh.n_faces());
  rest_.open();
  for (const Face face : faces) {
    if (!std::binary_search(kept_.begin(), kept_.end(), face)) rest_.add(face, 0);
  }
  return true;
}

}  // namespace kinemesh
