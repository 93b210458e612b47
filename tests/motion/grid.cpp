#include "tests/motion/grid.h"

namespace kinemesh::test {

MeshData grid(int n) {
  MeshData data;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      data.points.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n);
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      data.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      data.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  data.markers = {{"bottom", {}}, {"right", {}}, {"top", {}}, {"left", {}}};
  for (int k = 0; k < n; ++k) {
    data.markers[0].edges.push_back({at(k, 0), at(k + 1, 0)});
    data.markers[1].edges.push_back({at(n, k), at(n, k + 1)});
    data.markers[2].edges.push_back({at(k, n), at(k + 1, n)});
    data.markers[3].edges.push_back({at(0, k), at(0, k + 1)});
  }
  return data;
}

MeshData mapped(MeshData data, const std::function<Point(Point)>& map) {
  for (Point& p : data.points) p = map(p);
  return data;
}

}  // namespace kinemesh::test
