#include "kinemesh/shapes.h"

#include "core/base/registry.h"
#include "core/shapes/shape_parts.h"

namespace kinemesh {
namespace {

const Registry<ShapeInfo>& registry() {
  static const Registry<ShapeInfo> all(
      "shape", {
                   {"square",
                    "the unit square, random vertices",
                    {"bottom", "right", "top", "left"},
                    16,
                    [](const ShapeOptions& o) { return make_square(o.vertices, o.seed); }},
                   {"disk",
                    "the unit disk, random vertices",
                    {"border"},
                    16,
                    [](const ShapeOptions& o) { return make_disk(o.vertices, o.seed); }},
                   {"annulus",
                    "radius 1/2 to 1, random vertices",
                    {"outer", "inner"},
                    48,
                    [](const ShapeOptions& o) { return make_annulus(o.vertices, o.seed); }},
                   {"channel",
                    "[0,4]x[0,1] around a cylinder, graded",
                    {"inlet", "outlet", "bottom", "top", "cylinder"},
                    200,
                    [](const ShapeOptions& o) { return make_channel(o.vertices); }},
                   {"airfoil",
                    "NACA 0012 in a round far field, graded",
                    {"airfoil", "farfield"},
                    400,
                    [](const ShapeOptions& o) { return make_airfoil(o.vertices); }},
                   {"umbilic",
                    "a tangle that covers its shadow k + 1 times",
                    {"border"},
                    379,
                    [](const ShapeOptions& o) { return make_umbilic(o.k, o.vertices, o.seed); }},
               });
  return all;
}

}  // namespace

void require_vertices(std::string_view shape, int vertices, int minimum) {
  constexpr int most = most_items / 2;  // a vertex brings two faces
  if (vertices >= minimum && vertices <= most) return;
  const std::string expected =
      vertices < minimum ? "at least " + std::to_string(minimum) : "at most " + std::to_string(most);
  throw InputError(std::string(shape) + ": " + std::to_string(vertices) + " vertices, expected " + expected);
}

MeshData make_grid(int nx, int ny) {
  if (nx < 1 || ny < 1)
    throw InputError("grid: " + std::to_string(nx) + " by " + std::to_string(ny) +
                     " cells, expected at least 1 by 1");
  check_size((std::size_t{1} + nx) * (std::size_t{1} + ny), "vertices of a grid");
  check_size(std::size_t{2} * nx * ny, "faces of a grid");
  const auto vertex = [nx](int i, int j) { return j * (nx + 1) + i; };
  MeshData mesh;
  mesh.points.reserve(static_cast<std::size_t>(nx + 1) * (ny + 1));
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i)
      mesh.points.emplace_back(static_cast<double>(i) / nx, static_cast<double>(j) / ny);
  }
  mesh.triangles.reserve(static_cast<std::size_t>(nx) * ny * 2);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  mesh.markers = {{"bottom", {}}, {"right", {}}, {"top", {}}, {"left", {}}};
  for (int i = 0; i < nx; ++i) mesh.markers[0].edges.push_back({vertex(i, 0), vertex(i + 1, 0)});
  for (int j = 0; j < ny; ++j) mesh.markers[1].edges.push_back({vertex(nx, j), vertex(nx, j + 1)});
  for (int i = nx; i > 0; --i) mesh.markers[2].edges.push_back({vertex(i, ny), vertex(i - 1, ny)});
  for (int j = ny; j > 0; --j) mesh.markers[3].edges.push_back({vertex(0, j), vertex(0, j - 1)});
  return mesh;
}

std::vector<ShapeInfo> shapes() {
  return registry().all();
}

MeshData make_shape(std::string_view name, const ShapeOptions& options) {
  return registry().find(name).make(options);
}

}  // namespace kinemesh
