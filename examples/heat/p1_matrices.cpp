#include "examples/heat/p1_matrices.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace heat {

// grad phi_i is the opposite side, turned by a right angle, over twice the area.
Element element(const std::array<Point, 3>& x) {
  const std::array<Point, 3> side{x[2] - x[1], x[0] - x[2], x[1] - x[0]};
  Element made;
  made.area = (side[1].x * side[2].y - side[1].y * side[2].x) / 2;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) made.stiffness[i][j] = glm::dot(side[i], side[j]) / (4 * made.area);
  return made;
}

P1Matrices::P1Matrices(const MeshData& mesh)
    : triangles_(mesh.triangles),
      elements_(mesh.n_faces()),
      faces_at_(mesh.n_vertices()),
      rows_(mesh.n_vertices()) {
  std::vector<int> all(mesh.n_faces());
  std::iota(all.begin(), all.end(), 0);
  for (const int f : all)
    for (const int v : triangles_[f]) faces_at_[v].push_back(f);
  measure(all, mesh.points);
}

void P1Matrices::rewire(std::span<const FaceChange> faces) {
  for (const auto& change : faces) {
    triangles_[change.face] = numbers_of(change.after);
    for (const int v : change.before) std::erase(faces_at_[v], change.face);
  }
  for (const auto& change : faces)
    for (const int v : change.after) {
      auto& around = faces_at_[v];
      around.insert(std::ranges::lower_bound(around, int{change.face}), change.face);
    }
}

void P1Matrices::measure(std::span<const int> faces, std::span<const Point> x) {
  std::vector<int> touched;
  for (const int f : faces) {
    const auto& [a, b, c] = triangles_[f];
    elements_[f] = element({x[a], x[b], x[c]});
    touched.insert(touched.end(), triangles_[f].begin(), triangles_[f].end());
  }
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const int v : touched) sum_row(v);
}

void P1Matrices::sum_row(int vertex) {
  auto& row = rows_[vertex];
  row.clear();
  for (const int f : faces_at_[vertex]) {
    const auto& t = triangles_[f];
    const auto i = std::ranges::find(t, vertex) - t.begin();
    for (int j = 0; j < 3; ++j) {
      auto at = std::ranges::lower_bound(row, t[j], {}, &Entry::column);
      if (at == row.end() || at->column != t[j]) at = row.insert(at, {t[j], 0.0, 0.0});
      at->mass += elements_[f].area / (i == j ? 6 : 12);
      at->stiffness += elements_[f].stiffness[i][j];
    }
  }
  ++rows_summed_;
}

}  // namespace heat
