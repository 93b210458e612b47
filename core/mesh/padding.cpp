#include "core/mesh/padding.h"

#include <algorithm>

#include "core/mesh/winding.h"
#include "kinemesh/build.h"

namespace kinemesh {
namespace {

// The border's vertices under numbers of their own, ascending in the mesh's.
struct Border {
  std::vector<int> vertices;
  std::vector<Point> points;
  std::vector<Edge> edges;
};

Border compress(std::span<const Point> points, std::span<const Edge> border, std::span<const Vertex> extra) {
  Border result;
  result.vertices.assign(extra.begin(), extra.end());
  for (const auto& edge : border) result.vertices.insert(result.vertices.end(), edge.begin(), edge.end());
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  for (const int v : result.vertices) result.points.push_back(points[v]);
  const auto local = [&](int v) {
    return static_cast<int>(std::lower_bound(result.vertices.begin(), result.vertices.end(), v) -
                            result.vertices.begin());
  };
  for (const auto& [a, b] : border) result.edges.push_back({local(a), local(b)});
  return result;
}

class Culprits {
 public:
  Culprits(const Border& border, std::span<const UserVertex> user_number)
      : border_(border), user_number_(user_number) {}

  [[noreturn]] void refuse(const Contact& contact) const {
    Defect defect{.where = contact.where};
    switch (contact.kind) {
      case Contact::Kind::CoincidentPoints:
        defect.kind = DefectKind::CoincidentVertices;
        defect.vertices = {user(contact.first), user(contact.second)};
        break;
      case Contact::Kind::CrossingEdges:
        defect.kind = DefectKind::CrossingEdges;
        defect.edges = {user_edge(contact.first), user_edge(contact.second)};
        break;
      case Contact::Kind::PointOnEdge:
        defect.kind = DefectKind::VertexOnEdge;
        defect.vertices = {user(contact.first)};
        defect.edges = {user_edge(contact.second)};
        break;
    }
    throw NoEmbedding(std::move(defect));
  }

  // A triangle with a winding number that no domain gives it lies beside this border edge or beyond it.
  [[noreturn]] void refuse_inside_out(const Triangulation& triangulation, int triangle) const {
    Defect defect{.kind = DefectKind::InsideOut};
    defect.where = border_.points[triangulation.triangles[triangle][0]];
    for (const int e : triangulation.edges[triangle]) {
      if (e != none) defect.edges = {user_edge(e)};
    }
    throw NoEmbedding(std::move(defect));
  }

 private:
  UserVertex user(int local) const { return user_number_[border_.vertices[local]]; }
  UserEdge user_edge(int e) const { return {user(border_.edges[e][0]), user(border_.edges[e][1])}; }

  const Border& border_;
  std::span<const UserVertex> user_number_;
};

// Prefers a triangle that has a border edge to show.
int find_inside_out(const Triangulation& triangulation, const std::vector<int>& winding) {
  int found = none;
  for (int t = 0; t < static_cast<int>(winding.size()); ++t) {
    if (winding[t] == 0 || winding[t] == 1) continue;
    const auto& edges = triangulation.edges[t];
    if (std::any_of(edges.begin(), edges.end(), [](int e) { return e != none; })) return t;
    found = t;
  }
  return found;
}

}  // namespace

std::vector<Triangle> pad(std::span<const Point> points, std::span<const Edge> border_edges,
                          std::span<const Vertex> extra, std::span<const UserVertex> user_number) {
  const auto border = compress(points, border_edges, extra);
  const Culprits culprits(border, user_number);
  Triangulator triangulator;
  Triangulation triangulation;
  if (const auto contact = triangulator.triangulate(border.points, border.edges, triangulation)) {
    culprits.refuse(*contact);
  }
  const auto winding = winding_numbers(triangulation, border.edges);
  if (const int wrong = find_inside_out(triangulation, winding); wrong != none) {
    culprits.refuse_inside_out(triangulation, wrong);
  }
  std::vector<Triangle> padding;
  for (std::size_t t = 0; t < winding.size(); ++t) {
    if (winding[t] != 0) continue;
    const auto& [a, b, c] = triangulation.triangles[t];
    padding.push_back({border.vertices[a], border.vertices[b], border.vertices[c]});
  }
  return padding;
}

}  // namespace kinemesh
