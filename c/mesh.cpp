// Meshes as plain arrays.
#include <algorithm>
#include <memory>

#include "c/handles.h"
#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/orient.h"
#include "kinemesh/validate.h"

using namespace kinemesh;

namespace {

void require_finite(std::span<const Point> points) {
  const auto bad = std::ranges::find_if_not(points, is_finite);
  if (bad != points.end())
    refuse({.kind = DefectKind::NonFinitePosition,
            .vertices = {UserVertex(static_cast<int>(bad - points.begin()))}});
}

const Marker& marker_of(const Using<const kinemesh_mesh>& mesh, std::int32_t marker) {
  const auto& markers = mesh->data.markers;
  return markers[index(marker, markers.size(), "marker")];
}

// Ends are vertices of the mesh.
std::vector<Edge> edges_of(std::span<const std::int32_t> ends, int n_vertices) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    index(ends[i], static_cast<std::size_t>(n_vertices), ("edges[" + std::to_string(i) + "]").c_str());
    if (i % 2 != 0) edges.push_back({ends[i - 1], ends[i]});
  }
  return edges;
}

}  // namespace

kinemesh_status kinemesh_mesh_create(int32_t n_vertices, const double* xy, int32_t n_faces,
                                     const int32_t* triangles, const int32_t* labels, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    const auto vertices = count(n_vertices, "n_vertices"), faces = count(n_faces, "n_faces");
    check_size(vertices, "vertices");
    check_size(faces, "faces");
    auto made = std::make_unique<kinemesh_mesh>();
    made->data.points = points(array(xy, 2 * vertices, "xy"));
    made->data.triangles = triangles_of(array(triangles, 3 * faces, "triangles"));
    if (labels) made->data.labels.assign(labels, labels + faces);
    require_finite(made->data.points);
    make_consistent(made->data);
    result = made.release();
  });
}

kinemesh_status kinemesh_mesh_read(const char* file, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    result = new kinemesh_mesh{read_mesh(required(file, "file")).mesh};
  });
}

kinemesh_status kinemesh_mesh_write(const kinemesh_mesh* mesh, const char* file) {
  return guarded([&] { write_mesh(required(file, "file"), Using(mesh, "mesh")->data); });
}

int32_t kinemesh_mesh_n_vertices(const kinemesh_mesh* mesh) {
  return guarded_or<int32_t>(none, [&] { return Using(mesh, "mesh")->data.n_vertices(); });
}

int32_t kinemesh_mesh_n_faces(const kinemesh_mesh* mesh) {
  return guarded_or<int32_t>(none, [&] { return Using(mesh, "mesh")->data.n_faces(); });
}

kinemesh_status kinemesh_mesh_get(const kinemesh_mesh* mesh, double* xy, int32_t* triangles,
                                  int32_t* labels) {
  return guarded([&] { copy(Using(mesh, "mesh")->data, xy, triangles, labels); });
}

kinemesh_status kinemesh_mesh_add_marker(kinemesh_mesh* mesh, const char* name, int32_t n_edges,
                                         const int32_t* edges) {
  return guarded([&] {
    const Using m(mesh, "mesh");
    auto markers = m->data.markers;
    const auto ends = array(edges, 2 * count(n_edges, "n_edges"), "edges");
    const Marker added{required(name, "name"), edges_of(ends, m->data.n_vertices())};
    const auto same = std::ranges::find(markers, added.name, &Marker::name);
    if (same == markers.end())
      markers.push_back(added);
    else
      same->edges.insert(same->edges.end(), added.edges.begin(), added.edges.end());
    m->data.markers.swap(markers);
  });
}

int32_t kinemesh_mesh_n_markers(const kinemesh_mesh* mesh) {
  return guarded_or<int32_t>(none,
                             [&] { return static_cast<int>(Using(mesh, "mesh")->data.markers.size()); });
}

const char* kinemesh_mesh_marker_name(const kinemesh_mesh* mesh, int32_t marker) {
  return guarded_or<const char*>(nullptr,
                                 [&] { return marker_of(Using(mesh, "mesh"), marker).name.c_str(); });
}

int32_t kinemesh_mesh_marker_n_edges(const kinemesh_mesh* mesh, int32_t marker) {
  return guarded_or<int32_t>(
      none, [&] { return static_cast<int>(marker_of(Using(mesh, "mesh"), marker).edges.size()); });
}

kinemesh_status kinemesh_mesh_get_marker(const kinemesh_mesh* mesh, int32_t marker, int32_t* edges) {
  return guarded([&] {
    const Using m(mesh, "mesh");
    const Marker& found = marker_of(m, marker);
    int32_t* next = found.edges.empty() ? edges : required(edges, "edges");
    for (const Edge& edge : found.edges) next = std::ranges::copy(edge, next).out;
  });
}

const char* kinemesh_mesh_label_name(const kinemesh_mesh* mesh, int32_t label) {
  return guarded_or<const char*>(nullptr, [&] {
    const Using m(mesh, "mesh");
    const auto found = m->data.label_names.find(label);
    return found == m->data.label_names.end() ? "" : found->second.c_str();
  });
}

kinemesh_status kinemesh_mesh_name_label(kinemesh_mesh* mesh, int32_t label, const char* name) {
  return guarded([&] { Using(mesh, "mesh")->data.label_names[label] = required(name, "name"); });
}

kinemesh_status kinemesh_mesh_validate(const kinemesh_mesh* mesh) {
  return guarded([&] {
    if (const auto defect = validate(build_mesh(Using(mesh, "mesh")->data)))
      throw Failure(KINEMESH_NOT_VALID, defect->message(), defect);
  });
}

kinemesh_status kinemesh_mesh_untangle(kinemesh_mesh* mesh, const char* strategy) {
  return guarded([&] {
    const Using m(mesh, "mesh");
    Mesh work = build_mesh(m->data);
    const auto outcome = make_strategy(strategy ? strategy : "global")->repair(work, {});
    if (!outcome) refuse(*outcome.defect);
    m->data = work.domain();
  });
}

kinemesh_status kinemesh_mesh_destroy(kinemesh_mesh* mesh) {
  return guarded([&] { destroy(mesh, "mesh"); });
}
