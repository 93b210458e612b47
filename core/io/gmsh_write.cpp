#include <map>

#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/text_buffer.h"
#include "kinemesh/error.h"

namespace kinemesh::io {
namespace {

void check_quotes(const std::string& name) {
  if (name.find('"') != std::string::npos)
    throw InputError("the name " + in_quotes(name) + " has quotes, which Gmsh cannot");
}

// Markers are the physical curves 1, 2, ...; labels are the physical surfaces of their number.
void write_physical_names(const MeshData& mesh, TextBuffer& text) {
  if (mesh.markers.empty() && mesh.label_names.empty()) return;
  text << "$PhysicalNames\n" << mesh.markers.size() + mesh.label_names.size() << '\n';
  int tag = 0;
  for (const Marker& marker : mesh.markers) {
    check_quotes(marker.name);
    text << "1 " << ++tag << " \"" << marker.name << "\"\n";
  }
  for (const auto& [label, name] : mesh.label_names) {
    check_quotes(name);
    text << "2 " << label << " \"" << name << "\"\n";
  }
  text << "$EndPhysicalNames\n";
}

void write_nodes(const MeshData& mesh, TextBuffer& text) {
  text << "$Nodes\n" << mesh.n_vertices() << '\n';
  int tag = 0;
  for (const Point& p : mesh.points) text << ++tag << ' ' << p.x << ' ' << p.y << " 0\n";
  text << "$EndNodes\n";
}

// Gmsh keeps physical groups by geometric entity, so each label and each marker needs one of its own.
std::map<int, int> entities_of_labels(const MeshData& mesh) {
  std::map<int, int> entity;
  for (int label : mesh.labels) entity.emplace(label, 0);
  if (mesh.labels.empty()) entity.emplace(0, 0);
  int n = 0;
  for (auto& [label, number] : entity) number = ++n;
  return entity;
}

void write_elements(const MeshData& mesh, TextBuffer& text) {
  std::size_t n_lines = 0;
  for (const Marker& marker : mesh.markers) n_lines += marker.edges.size();
  text << "$Elements\n" << n_lines + mesh.triangles.size() << '\n';
  std::size_t element = 0;
  int tag = 0;
  for (const Marker& marker : mesh.markers) {
    ++tag;
    for (const Edge& e : marker.edges) {
      text << ++element << " 1 2 " << tag << ' ' << tag << ' ' << e[0] + 1 << ' ' << e[1] + 1 << '\n';
    }
  }
  const std::map<int, int> entity = entities_of_labels(mesh);
  for (int f = 0; f < mesh.n_faces(); ++f) {
    const Triangle& t = mesh.triangles[f];
    text << ++element << " 2 2 " << mesh.label(f) << ' ' << entity.at(mesh.label(f)) << ' ' << t[0] + 1 << ' '
         << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  text << "$EndElements\n";
}

}  // namespace

std::string write_gmsh(const MeshData& mesh) {
  TextBuffer text(56 * mesh.points.size() + 48 * mesh.triangles.size() + 256);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, text);
  write_nodes(mesh, text);
  write_elements(mesh, text);
  return text.take();
}

}  // namespace kinemesh::io
