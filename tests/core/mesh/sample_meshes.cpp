#include "tests/core/mesh/sample_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/cdt/triangulator.h"
#include "core/mesh/winding.h"

namespace kinemesh::test {
namespace {

// The loops' vertices without repetitions, and their edges.
struct Outline {
  MeshData data;
  std::vector<Edge> edges;
  std::map<std::pair<double, double>, int> number;

  int vertex(const Point& p) {
    const auto [place, fresh] = number.try_emplace({p.x, p.y}, data.n_vertices());
    if (fresh) data.points.push_back(p);
    return place->second;
  }
  void add(const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int from = vertex(loop[i]);
      edges.push_back({from, vertex(loop[(i + 1) % loop.size()])});
    }
  }
};

bool inside_u(const Point& p) {
  return p.y < 1.0 || p.x < 1.0 || p.x > 2.0;
}

}  // namespace

Point snapped(const Point& p) {
  return {std::round(p.x * 0x1p24) * 0x1p-24, std::round(p.y * 0x1p24) * 0x1p-24};
}

Loop rectangle(const Point& low, const Point& high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

Loop circle(const Point& centre, double radius, int n) {
  Loop loop;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    loop.push_back(snapped(centre + radius * Point(std::cos(angle), std::sin(angle))));
  }
  return loop;
}

Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

MeshData domain_of(const std::vector<Loop>& loops, const std::vector<Point>& inside,
                   const std::vector<Loop>& lines) {
  Outline outline;
  for (const auto& loop : loops) outline.add(loop);
  const std::size_t n_border = outline.edges.size();
  for (const auto& line : lines) outline.add(line);
  for (const auto& p : inside) outline.vertex(p);
  Triangulation triangulation;
  if (Triangulator().triangulate(outline.data.points, outline.edges, triangulation))
    throw std::logic_error("the sample's loops touch");
  const auto winding = winding_numbers(triangulation, std::span(outline.edges).first(n_border));
  for (std::size_t t = 0; t < winding.size(); ++t) {
    if (winding[t] == 1) outline.data.triangles.push_back(triangulation.triangles[t]);
  }
  return std::move(outline.data);
}

MeshData random_square(int n, Random& random) {
  std::vector<Point> inside;
  while (static_cast<int>(inside.size()) < n - 4) {
    const Point p = snapped({random.between(0, 1), random.between(0, 1)});
    if (p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) inside.push_back(p);
  }
  return domain_of({rectangle({0, 0}, {1, 1})}, inside);
}

MeshData random_grid(int nx, int ny, Random& random) {
  MeshData data;
  for (int y = 0; y <= ny; ++y) {
    for (int x = 0; x <= nx; ++x) data.points.push_back({2.0 * x, 2.0 * y});
  }
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const int a = y * (nx + 1) + x, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      const bool rising = random.one_in(2);
      data.triangles.push_back(rising ? Triangle{a, b, c} : Triangle{a, b, d});
      data.triangles.push_back(rising ? Triangle{a, c, d} : Triangle{b, c, d});
    }
  }
  return data;
}

MeshData four_triangles() {
  MeshData data;
  data.points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  data.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return data;
}

MeshData u_shape(int inside, Random& random) {
  std::vector<Point> points;
  while (static_cast<int>(points.size()) < inside) {
    const Point p = snapped({random.between(0.01, 2.99), random.between(0.01, 2.99)});
    if (inside_u(p)) points.push_back(p);
  }
  const Loop border{{0, 0}, {1.5, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  return domain_of({border}, points);
}

MeshData mirrored(MeshData data) {
  for (auto& p : data.points) p.x = -p.x;
  for (auto& t : data.triangles) std::swap(t[1], t[2]);
  return data;
}

MeshData mapped(MeshData data, const Point& factor, const Point& shift) {
  for (auto& p : data.points) p = p * factor + shift;
  return data;
}

}  // namespace kinemesh::test
