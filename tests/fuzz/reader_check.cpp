#include "tests/fuzz/reader_check.h"

#include <bit>
#include <cmath>
#include <optional>

namespace kinemesh {
namespace {

std::optional<MeshData> parse_or_refuse(std::string_view text, Format format, bool split_quads) {
  try {
    return parse_mesh(text, format, "input", {.split_quads = split_quads}).mesh;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool exists(const MeshData& mesh, int vertex) {
  return vertex >= 0 && vertex < mesh.n_vertices();
}

std::string broken_contract(const MeshData& mesh) {
  if (mesh.triangles.empty()) return "no triangles";
  if (!mesh.labels.empty() && mesh.labels.size() != mesh.triangles.size())
    return "labels and faces differ in number";
  for (const Point& p : mesh.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return "a point is not finite";
  }
  for (const Triangle& t : mesh.triangles) {
    for (int v : t) {
      if (!exists(mesh, v)) return "a face has a vertex that does not exist";
    }
  }
  for (const Marker& marker : mesh.markers) {
    for (const Edge& e : marker.edges) {
      if (!exists(mesh, e[0]) || !exists(mesh, e[1]) || e[0] == e[1])
        return "a marker has an edge that cannot be";
    }
  }
  return {};
}

bool same_points(const MeshData& a, const MeshData& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Point &p = a.points[i], &q = b.points[i];
    if (std::bit_cast<std::uint64_t>(p.x) != std::bit_cast<std::uint64_t>(q.x)) return false;
    if (std::bit_cast<std::uint64_t>(p.y) != std::bit_cast<std::uint64_t>(q.y)) return false;
  }
  return true;
}

bool same_markers(const MeshData& a, const MeshData& b) {
  if (a.markers.size() != b.markers.size()) return false;
  for (std::size_t i = 0; i < a.markers.size(); ++i) {
    if (a.markers[i].name != b.markers[i].name || a.markers[i].edges != b.markers[i].edges) return false;
  }
  return true;
}

std::string difference(const MeshData& a, const MeshData& b, Format format) {
  if (!same_points(a, b)) return "points changed";
  if (a.triangles != b.triangles) return "faces changed";
  if (keeps_labels(format) && (a.labels != b.labels || a.label_names != b.label_names))
    return "labels changed";
  if (keeps_markers(format) && !same_markers(a, b)) return "markers changed";
  return {};
}

}  // namespace

std::string check_reader(std::string_view text, Format format) {
  const std::optional<MeshData> whole = parse_or_refuse(text, format, false);
  const std::optional<MeshData> mesh = parse_or_refuse(text, format, true);
  if (!mesh) return whole ? "accepted only without splitting" : "";
  if (std::string broken = broken_contract(*mesh); !broken.empty()) return broken;
  if (whole && !difference(*whole, *mesh, format).empty())
    return "splitting changed a mesh without quadrilaterals";
  try {
    return difference(*mesh, parse_mesh(format_mesh(*mesh, format), format, "output").mesh, format);
  } catch (const InputError& error) {
    return std::string("written and not read again: ") + error.what();
  }
}

}  // namespace kinemesh
