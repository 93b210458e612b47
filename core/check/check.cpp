#include "kinemesh/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/check/adjacency.h"
#include "core/mesh/sides.h"
#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"
#include "kinemesh/validate.h"

namespace kinemesh {
namespace {

std::vector<Orientation> orientations(const MeshData& data) {
  std::vector<Orientation> result;
  result.reserve(data.triangles.size());
  for (const Triangle& t : data.triangles)
    result.push_back(orientation(data.points[t[0]], data.points[t[1]], data.points[t[2]]));
  return result;
}

std::array<Point, 3> corners_of(const MeshData& data, const Triangle& t) {
  return {data.points[t[0]], data.points[t[1]], data.points[t[2]]};
}

// Of an inverted face that of its mirror image.
double smallest_angle_deg(std::array<Point, 3> corners) {
  if (twice_area(corners) < 0.0) std::swap(corners[1], corners[2]);
  return degrees(tangent_of_smallest_angle(corners));
}

void measure(const MeshData& data, const std::vector<Orientation>& signs, CheckReport& report) {
  if (data.triangles.empty()) return;
  report.min_angle_deg = 180.0;
  report.min_area = std::numeric_limits<double>::infinity();
  for (int face = 0; face < data.n_faces(); ++face) {
    const Triangle& t = data.triangles[face];
    const bool is_flat = signs[face] == Orientation::Collinear;
    report.min_angle_deg =
        std::min(report.min_angle_deg, is_flat ? 0.0 : smallest_angle_deg(corners_of(data, t)));
    report.min_area = std::min(report.min_area, is_flat ? 0.0 : 0.5 * twice_area(corners_of(data, t)));
  }
}

int count_isolated(const MeshData& data) {
  std::vector<bool> used(data.points.size(), false);
  for (const Triangle& t : data.triangles)
    for (int v : t) used[v] = true;
  return static_cast<int>(std::count(used.begin(), used.end(), false));
}

void count(const MeshData& data, const std::vector<Orientation>& signs, CheckReport& report) {
  const std::vector<int> opposite = pair_sides(data.triangles, data.n_vertices()).opposite;
  std::vector<bool> is_inverted;
  for (Orientation sign : signs) is_inverted.push_back(sign == Orientation::Clockwise);
  report.vertices = data.n_vertices();
  report.isolated_vertices = count_isolated(data);
  report.faces = data.n_faces();
  report.inverted = static_cast<int>(std::count(signs.begin(), signs.end(), Orientation::Clockwise));
  report.degenerate = static_cast<int>(std::count(signs.begin(), signs.end(), Orientation::Collinear));
  report.inverted_components = count_parts(opposite, is_inverted);
  report.connected_parts = count_parts(opposite, std::vector<bool>(signs.size(), true));
  report.border_loops = count_border_loops(opposite);
  for (const Marker& marker : data.markers)
    report.markers.push_back({marker.name, static_cast<int>(marker.edges.size())});
}

Defect bad_face(const MeshData& data, int face, DefectKind kind) {
  const Triangle& t = data.triangles[face];
  Defect defect;
  defect.kind = kind;
  defect.faces = {UserFace(face)};
  defect.vertices = {UserVertex(t[0]), UserVertex(t[1]), UserVertex(t[2])};
  defect.where = (data.points[t[0]] + data.points[t[1]] + data.points[t[2]]) / 3.0;
  return defect;
}

void name_bad_faces(const MeshData& data, const std::vector<Orientation>& signs, Orientation sign,
                    DefectKind kind, std::vector<Defect>& culprits) {
  int named = 0;
  for (int face = 0; face < data.n_faces() && named < culprits_per_kind; ++face) {
    if (signs[face] != sign) continue;
    culprits.push_back(bad_face(data, face, kind));
    ++named;
  }
}

Defect missing_edge(const MeshData& data, const Marker& marker, const Edge& edge) {
  Defect defect;
  defect.kind = DefectKind::MissingEdge;
  defect.edges = {{UserVertex(edge[0]), UserVertex(edge[1])}};
  defect.where = (data.points[edge[0]] + data.points[edge[1]]) / 2.0;
  defect.detail = "marker \"" + marker.name + "\" names it, but no face has it";
  return defect;
}

// Returns whether there are any.
bool name_missing_edges(const MeshData& data, std::vector<Defect>& culprits) {
  std::vector<Edge> edges;            // of all markers
  std::vector<const Marker*> marker;  // of each
  for (const Marker& m : data.markers) {
    edges.insert(edges.end(), m.edges.begin(), m.edges.end());
    marker.resize(edges.size(), &m);
  }
  const std::vector<int> missing = missing_edges(data.triangles, edges);
  for (const int i : std::span(missing).first(std::min<std::size_t>(missing.size(), culprits_per_kind)))
    culprits.push_back(missing_edge(data, *marker[i], edges[i]));
  return !missing.empty();
}

// Whether the borders can be embedded at all, and whether the faces then cover what is inside them once.
std::optional<Defect> defect_of_embedding(const MeshData& data) {
  try {
    return validate(build_mesh(data));
  } catch (const NoEmbedding& error) {
    return error.defect();
  }
}

bool is_named(const Defect& defect, const std::vector<Defect>& culprits) {
  return std::any_of(culprits.begin(), culprits.end(),
                     [&](const Defect& d) { return d.kind == defect.kind; });
}

}  // namespace

FaceCount count_bad_faces(const MeshData& data) {
  FaceCount result;
  for (Orientation sign : orientations(data)) {
    result.inverted += sign == Orientation::Clockwise;
    result.degenerate += sign == Orientation::Collinear;
  }
  return result;
}

CheckReport check_mesh(const MeshData& data) {
  CheckReport report;
  const std::vector<Orientation> signs = orientations(data);
  count(data, signs, report);
  measure(data, signs, report);
  name_bad_faces(data, signs, Orientation::Clockwise, DefectKind::InvertedFace, report.culprits);
  name_bad_faces(data, signs, Orientation::Collinear, DefectKind::FlatFace, report.culprits);
  MeshData embedded = data;
  if (name_missing_edges(data, report.culprits)) embedded.markers.clear();  // build_mesh refuses such
  const std::optional<Defect> defect = defect_of_embedding(embedded);
  if (defect && !is_named(*defect, report.culprits)) report.culprits.push_back(*defect);
  report.valid = report.culprits.empty();
  return report;
}

}  // namespace kinemesh
