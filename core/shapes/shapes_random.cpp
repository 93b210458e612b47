// Square, disk and annulus: regular borders, random vertices inside.
#include <algorithm>
#include <stdexcept>

#include "core/cdt/triangulator.h"
#include "core/shapes/shape_parts.h"
#include "kinemesh/shapes.h"

namespace kinemesh {
namespace {

// Appends the points of a closed loop to the mesh; the edges between them.
std::vector<Edge> add_loop(MeshData& mesh, const std::vector<Point>& points) {
  const int first = mesh.n_vertices(), n = static_cast<int>(points.size());
  mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  std::vector<Edge> edges;
  for (int i = 0; i < n; ++i) edges.push_back({first + i, first + (i + 1) % n});
  return edges;
}

std::vector<Point> circle(double radius, int n, bool clockwise) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i)
    points.push_back(on_circle(radius, static_cast<double>(clockwise ? (n - i) % n : i) / n));
  return points;
}

std::vector<Point> square_border(int n) {
  std::vector<Point> points;
  const auto at = [n](int i) { return static_cast<double>(i) / n; };
  for (int i = 0; i < n; ++i) points.emplace_back(at(i), 0.0);
  for (int i = 0; i < n; ++i) points.emplace_back(1.0, at(i));
  for (int i = n; i > 0; --i) points.emplace_back(at(i), 1.0);
  for (int i = n; i > 0; --i) points.emplace_back(0.0, at(i));
  return points;
}

// Appends what is missing to `vertices`, taken from `make_point`, along a Hilbert curve.
template <class MakePoint>
void fill(MeshData& mesh, int vertices, MakePoint make_point) {
  std::vector<Point> inner;
  const int n = vertices - mesh.n_vertices();
  inner.reserve(n);
  for (int i = 0; i < n; ++i) inner.push_back(make_point());
  mesh.points.reserve(vertices);
  for (const int i : hilbert_order(inner)) mesh.points.push_back(inner[i]);
}

// Triangulates the convex hull of the vertices, with all marked edges.
void triangulate(MeshData& mesh) {
  std::vector<Edge> edges;
  for (const Marker& marker : mesh.markers)
    edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
  Triangulation triangulation;
  if (Triangulator().triangulate(mesh.points, edges, triangulation)) {
    throw std::logic_error("a shape's vertices coincide or its border edges meet");
  }
  mesh.triangles = std::move(triangulation.triangles);
}

// A random point of a ring.
Point between_circles(UniformRandom& random, double inner, double outer) {
  for (;;) {
    const Point p{random.between(-outer, outer), random.between(-outer, outer)};
    const double square = p.x * p.x + p.y * p.y;
    if (inner * inner <= square && square <= outer * outer) return p;
  }
}

// Distance from the centre to the sides of the polygon in a circle.
double apothem(double radius, int sides) {
  return radius * std::cos(std::numbers::pi / sides);
}

int n_edges(double length, double h) {
  return static_cast<int>(std::lround(length / h));
}

}  // namespace

MeshData make_square(int vertices, std::uint64_t seed) {
  require_vertices("square", vertices, 16);
  const double h = std::sqrt(1.0 / vertices);
  const int n = n_edges(1.0, h);
  MeshData mesh;
  const std::vector<Edge> edges = add_loop(mesh, square_border(n));
  const char* names[] = {"bottom", "right", "top", "left"};
  for (int k = 0; k < 4; ++k) {
    mesh.markers.push_back({names[k], {edges.begin() + k * n, edges.begin() + (k + 1) * n}});
  }
  UniformRandom random(seed);
  fill(mesh, vertices, [&] {
    const double x = random.between(0.5 * h, 1.0 - 0.5 * h);
    return Point{x, random.between(0.5 * h, 1.0 - 0.5 * h)};
  });
  triangulate(mesh);
  return mesh;
}

MeshData make_disk(int vertices, std::uint64_t seed) {
  require_vertices("disk", vertices, 16);
  const double h = std::sqrt(std::numbers::pi / vertices);
  const int n = n_edges(2.0 * std::numbers::pi, h);
  MeshData mesh;
  mesh.markers.push_back({"border", add_loop(mesh, circle(1.0, n, false))});
  UniformRandom random(seed);
  fill(mesh, vertices, [&] { return between_circles(random, 0.0, apothem(1.0, n) - 0.5 * h); });
  triangulate(mesh);
  return mesh;
}

MeshData make_annulus(int vertices, std::uint64_t seed) {
  require_vertices("annulus", vertices, 48);
  const double h = std::sqrt(0.75 * std::numbers::pi / vertices);
  const int n_outer = n_edges(2.0 * std::numbers::pi, h), n_inner = n_edges(std::numbers::pi, h);
  MeshData mesh;
  mesh.markers.push_back({"outer", add_loop(mesh, circle(1.0, n_outer, false))});
  mesh.markers.push_back({"inner", add_loop(mesh, circle(0.5, n_inner, true))});
  UniformRandom random(seed);
  fill(mesh, vertices,
       [&] { return between_circles(random, 0.5 + 0.5 * h, apothem(1.0, n_outer) - 0.5 * h); });
  triangulate(mesh);
  const auto on_inner = [&](int v) { return n_outer <= v && v < n_outer + n_inner; };
  std::erase_if(mesh.triangles,
                [&](const Triangle& t) { return std::all_of(t.begin(), t.end(), on_inner); });  // the hole
  return mesh;
}

}  // namespace kinemesh
