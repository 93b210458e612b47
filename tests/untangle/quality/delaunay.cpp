#include "tests/untangle/quality/delaunay.h"
#include "tests/core/mesh/edges.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/cdt/triangulator.h"
#include "kinemesh/predicates.h"

namespace kinemesh::test {
namespace {

using EdgeSet = std::set<Edge>;

Edge sorted(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

// From scratch, over the vertices that are in faces.
EdgeSet triangulated_edges(const Mesh& mesh) {
  std::vector<Vertex> vertices;
  std::vector<int> number(mesh.n_vertices(), none);
  std::vector<Point> points;
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    number[v] = static_cast<int>(vertices.size());
    vertices.push_back(v);
    points.push_back(mesh.position(v));
  }
  std::vector<Edge> constrained;
  for (const auto& c : mesh.constraints()) constrained.push_back({number[c.from], number[c.to]});
  Triangulation triangulation;
  if (Triangulator().triangulate(points, constrained, triangulation)) return {};
  EdgeSet edges;
  for (const auto& t : triangulation.triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(sorted(vertices[t[k]], vertices[t[(k + 1) % 3]]));
  }
  return edges;
}

Edge ends(const Mesh& mesh, Side edge) {
  return sorted(mesh.from(edge), mesh.to(edge));
}

InCircle opposite_vertex(const Mesh& mesh, Side edge) {
  const auto [a, b, c] = mesh.corners(Mesh::face_of(edge));
  return in_circle(a, b, c, mesh.position(mesh.apex(mesh.opposite(edge))));
}

}  // namespace

std::string not_delaunay(const Mesh& mesh) {
  const auto expected = triangulated_edges(mesh);
  if (static_cast<int>(expected.size()) != mesh.n_edges()) return "another number of edges";
  for (const Side edge : all_edges(mesh)) {
    if (expected.contains(ends(mesh, edge))) continue;
    if (mesh.constraint_of(edge) != none) return "a constrained edge is missing";
    if (mesh.is_flippable(edge) && opposite_vertex(mesh, edge) == InCircle::On) continue;
    return "edge " + std::to_string(ends(mesh, edge)[0]) + "-" + std::to_string(ends(mesh, edge)[1]) +
           " is not Delaunay";
  }
  return "";
}

int n_foreign_edges(const Mesh& mesh) {
  const auto expected = triangulated_edges(mesh);
  int foreign = 0;
  for (const Side edge : all_edges(mesh)) foreign += !expected.contains(ends(mesh, edge));
  return foreign;
}

int n_not_locally_delaunay(const Mesh& mesh) {
  int count = 0;
  for (const Side edge : all_edges(mesh))
    count += mesh.is_flippable(edge) && opposite_vertex(mesh, edge) == InCircle::Inside;
  return count;
}

}  // namespace kinemesh::test
