#include "core/io/writable.h"

#include <cmath>

#include "core/io/assembler.h"
#include "core/io/atomic_file.h"
#include "kinemesh/error.h"

namespace kinemesh::io {
namespace {

void check_vertex(const MeshData& mesh, int vertex, const std::string& where) {
  if (vertex >= 0 && vertex < mesh.n_vertices()) return;
  throw InputError(where + ": vertex " + std::to_string(vertex) +
                   " does not exist, expected a number from 0 and below " +
                   std::to_string(mesh.n_vertices()));
}

void check_points(const MeshData& mesh) {
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const Point& p = mesh.points[v];
    if (!is_finite(p)) {
      throw InputError("vertex " + std::to_string(v) + " is not at a finite place");
    }
  }
}

void check_faces(const MeshData& mesh) {
  for (int f = 0; f < mesh.n_faces(); ++f) {
    for (int v : mesh.triangles[f]) {
      if (v < 0 || v >= mesh.n_vertices()) check_vertex(mesh, v, "face " + std::to_string(f));
    }
    if (mesh.label(f) == padding_label)
      throw InputError("face " + std::to_string(f) + " has the reserved label");
  }
}

}  // namespace

void check_length(std::size_t length, std::size_t expected, const char* what) {
  if (length == 0 || length == expected) return;
  throw InputError(std::to_string(length) + " " + what + ", expected " + std::to_string(expected));
}

void check_writable(const MeshData& mesh) {
  check_length(mesh.labels.size(), mesh.triangles.size(), "labels");
  check_points(mesh);
  check_faces(mesh);
  for (const Marker& marker : mesh.markers) {
    check_name(marker.name);
    for (const auto& [a, b] : marker.edges) {
      check_vertex(mesh, a, "marker " + marker.name);
      check_vertex(mesh, b, "marker " + marker.name);
    }
  }
  for (const auto& [label, name] : mesh.label_names) check_name(name);
}

void write_content(const std::filesystem::path& path, const std::function<std::string()>& content) {
  std::string text;
  try {
    text = content();
  } catch (const InputError& error) {
    throw InputError(path.string(), 0, error.what());
  }
  write_file_atomically(path, text);
}

}  // namespace kinemesh::io
