#include "untangle/walk/stuck.h"

#include <algorithm>

namespace kinemesh {
namespace {

Face first_of(const Mesh& mesh, const Tangles& left) {
  const auto key = [&](Face face) {
    return std::tuple(mesh.is_padding(face), mesh.is_padding(face) ? int{face} : int{mesh.user_face(face)});
  };
  Face first;
  for (const auto* faces : {&left.inverted, &left.flat}) {
    for (const Face face : *faces) {
      if (first == none || key(face) < key(first)) first = face;
    }
  }
  return first;
}

}  // namespace

Defect stuck_defect(const Mesh& mesh, const Tangles& left, const std::string& who) {
  const Face face = first_of(mesh, left);
  const bool is_flat = std::binary_search(left.flat.begin(), left.flat.end(), face);
  const auto n = left.inverted.size() + left.flat.size();
  Defect defect;
  defect.kind = is_flat ? DefectKind::FlatFace : DefectKind::InvertedFace;
  defect.faces = {mesh.user_face(face)};
  for (const Vertex v : mesh.triangles()[face]) defect.vertices.push_back(mesh.user_vertex(v));
  defect.where = mesh.corners(face)[0];
  defect.detail = who + " are stuck with " + std::to_string(n) +
                  (n == 1 ? " inverted or flat face left" : " inverted or flat faces left");
  return defect;
}

}  // namespace kinemesh
