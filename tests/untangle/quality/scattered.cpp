#include "tests/untangle/quality/scattered.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"
#include "kinemesh/shapes.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

// Label 2 inside a circle, as far as the grid follows it.
MeshData two_labels(MeshData data) {
  for (const auto& [a, b, c] : data.triangles) {
    const Point d = (data.points[a] + data.points[b] + data.points[c]) / 3.0 - Point(0.5, 0.5);
    data.labels.push_back(d.x * d.x + d.y * d.y < 0.1 ? 2 : 1);
  }
  return data;
}

// A marker along edges inside: one after the other, each to the neighbour furthest right.
MeshData marked_inside(MeshData data) {
  Marker line{"line", {}};
  const auto nearest = [&](const Point& p) {
    const auto d = [&](const Point& q) { return (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y); };
    return static_cast<int>(std::min_element(data.points.begin(), data.points.end(),
                                             [&](const Point& a, const Point& b) { return d(a) < d(b); }) -
                            data.points.begin());
  };
  for (int v = nearest({-0.5, 0.0}); line.edges.size() < 6;) {
    int best = v;
    for (const auto& t : data.triangles) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      for (const int w : t) best = data.points[w].x > data.points[best].x ? w : best;
    }
    line.edges.push_back({v, best});
    v = best;
  }
  data.markers.push_back(line);
  return data;
}

bool is_inside(const Mesh& mesh, const Point& p, int label) {
  for (const Face f : mesh.faces()) {
    if (mesh.label(f) == label && strictly_inside(p, mesh.corners(f))) return true;
  }
  return false;
}

}  // namespace

Domain domain_number(int number, std::uint64_t seed) {
  switch (number) {
    case 0:
      return {"square", build_mesh(make_square(300, seed))};
    case 1:
      return {"disk", build_mesh(make_disk(300, seed))};
    case 2:
      return {"annulus", build_mesh(make_annulus(400, seed))};
    case 3:
      return {"channel", build_mesh(make_channel(400))};
    case 4:
      return {"framed square", build_mesh(make_square(200, seed), {.frame = 0.3})};
    case 5:
      return {"two labels", build_mesh(two_labels(make_grid(17, 17)))};
    case 6:
      return {"marked line", build_mesh(marked_inside(make_disk(300, seed)))};
    default:
      throw std::logic_error("no such domain");
  }
}

Mesh scattered(const Mesh& mesh, double spacings, std::uint64_t seed) {
  Mesh result = mesh;
  Random random(seed);
  const double reach = spacings * mean_spacing(mesh);
  for (const Vertex v : mesh.vertices()) {
    if (!is_free(mesh, v)) continue;
    Point there;
    do {
      there = mesh.position(v) + Point(random.between(-reach, reach), random.between(-reach, reach));
    } while (!is_inside(mesh, there, mesh.home_label(v)));
    result.positions()[v] = there;
  }
  return result;
}

Mesh exchanged(const Mesh& mesh, std::uint64_t seed) {
  Mesh result = mesh;
  Random random(seed);
  std::map<int, std::vector<Vertex>> free;
  for (const Vertex v : mesh.vertices()) {
    if (is_free(mesh, v)) free[mesh.home_label(v)].push_back(v);
  }
  for (const auto& [label, vertices] : free) {
    for (int i = static_cast<int>(vertices.size()); i > 1; --i)
      std::swap(result.positions()[vertices[i - 1]], result.positions()[vertices[random.below(i)]]);
  }
  return result;
}

bool is_free(const Mesh& mesh, Vertex v) {
  return mesh.user_vertex(v) != none && !mesh.is_isolated(v) && !mesh.is_constrained(v) && !mesh.is_fixed(v);
}

MeshData shuffled(const MeshData& data, std::uint64_t seed) {
  Random random(seed);
  std::vector<int> order(data.n_faces());
  std::iota(order.begin(), order.end(), 0);
  for (int i = data.n_faces(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  MeshData result = data;
  for (int f = 0; f < data.n_faces(); ++f) {
    result.triangles[f] = data.triangles[order[f]];
    std::ranges::rotate(result.triangles[f], result.triangles[f].begin() + random.below(3));
    if (!data.labels.empty()) result.labels[f] = data.labels[order[f]];
  }
  return result;
}

int n_tangled(const Mesh& mesh) {
  const auto tangles = detect(mesh);
  return static_cast<int>(tangles.inverted.size() + tangles.flat.size());
}

std::string moved_what_stays(const Mesh& before, const Mesh& after) {
  for (const Vertex v : before.vertices()) {
    if (!is_free(before, v) && before.position(v) != after.position(v))
      return "moved vertex " + std::to_string(v);
  }
  return "";
}

bool same_connectivity(const Mesh& a, const Mesh& b) {
  const auto first = snapshot_of(a), second = snapshot_of(b);
  return first.faces == second.faces && first.fans == second.fans;
}

}  // namespace kinemesh::test
