#include "examples/heat/turning_body.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

#include "core/cdt/triangulator.h"

namespace heat {
namespace {

using kinemesh::Edge;

void add_closed_line(const std::vector<Point>& line, std::vector<Point>& points, std::vector<Edge>& edges) {
  const int first = static_cast<int>(points.size()), n = static_cast<int>(line.size());
  for (int i = 0; i < n; ++i) edges.push_back({first + i, first + (i + 1) % n});
  points.insert(points.end(), line.begin(), line.end());
}

std::vector<Point> sides_of_square(int n) {
  std::vector<Point> line;
  const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      const double s = static_cast<double>(i) / n;
      line.push_back(corners[side] * (1 - s) + corners[side + 1] * s);
    }
  return line;
}

std::vector<Point> outline(const TurningBody& shape, double h) {
  const int n = static_cast<int>(std::lround(2 * std::numbers::pi * shape.radius / h));
  std::vector<Point> line;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    line.push_back(shape.centre + shape.radius * Point(std::cos(angle), std::sin(angle)));
  }
  return line;
}

// A shaken lattice, apart from the lines.
void add_inner_points(const TurningBody& shape, int n, std::vector<Point>& points) {
  const double h = 1.0 / n;
  std::mt19937 random(1);
  const auto shake = [&] { return 0.2 * h * (static_cast<double>(random()) / std::mt19937::max() - 0.5); };
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) {
      const Point p(i * h + shake(), j * h + shake());
      if (std::abs(glm::distance(p, shape.centre) - shape.radius) > 0.6 * h) points.push_back(p);
    }
}

}  // namespace

Point TurningBody::velocity(const Point& x, int label) const {
  return label == body ? rate * Point(centre.y - x.y, x.x - centre.x) : Point(0.0);
}

Point TurningBody::turned(const Point& x, double t) const {
  const double c = std::cos(rate * t), s = std::sin(rate * t);
  const Point arm = x - centre;
  return centre + Point(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
}

MeshData square_with_body(const TurningBody& shape, double h) {
  const int n = static_cast<int>(std::lround(1 / h));
  MeshData mesh;
  std::vector<Edge> edges;
  add_closed_line(sides_of_square(n), mesh.points, edges);
  add_closed_line(outline(shape, h), mesh.points, edges);
  add_inner_points(shape, n, mesh.points);
  kinemesh::Triangulation made;
  if (kinemesh::Triangulator().triangulate(mesh.points, edges, made)) throw std::logic_error("lines touch");
  mesh.triangles = made.triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
    mesh.labels.push_back(glm::distance(middle, shape.centre) < shape.radius ? body : medium);
  }
  return mesh;
}

std::vector<int> body_vertices(const MeshData& mesh) {
  std::set<int> vertices;
  for (int f = 0; f < mesh.n_faces(); ++f)
    if (mesh.label(f) == body) vertices.insert(mesh.triangles[f].begin(), mesh.triangles[f].end());
  return {vertices.begin(), vertices.end()};
}

}  // namespace heat
