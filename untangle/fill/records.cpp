#include "untangle/fill/records.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "core/base/sort_distinct.h"
#include "core/base/stopwatch.h"
#include "kinemesh/predicates.h"
#include "untangle/walk/detect.h"

namespace kinemesh {
namespace {

using FewFaces = ShortList<Face, 32>;

// What is to be told of a region's faces as they are.
struct Survey {
  FewFaces inverted, flat;  // ascending
  Point low, high;          // corners of the bounding box
};

Survey survey(const Mesh& mesh, const std::vector<Face>& faces) {
  const Point first = mesh.corners(faces.front())[0];
  Survey found{{}, {}, first, first};
  for (const Face face : faces) {
    const auto [a, b, c] = mesh.corners(face);
    const auto turn = orientation(a, b, c);
    if (turn == Orientation::Clockwise) found.inverted.push_back(face);
    if (turn == Orientation::Collinear) found.flat.push_back(face);
    found.low = glm::min(found.low, glm::min(a, glm::min(b, c)));
    found.high = glm::max(found.high, glm::max(a, glm::max(b, c)));
  }
  return found;
}

bool contains(const FewFaces& sorted, Face face) {
  return std::binary_search(sorted.begin(), sorted.end(), face);
}

// Between inverted faces and upright ones.
int count_crease_edges(const Mesh& mesh, const Survey& found) {
  int count = 0;
  for (const Face face : found.inverted) {
    for (const Side side : Mesh::sides(face)) {
      const Face across = mesh.face_across(side);
      count += across != none && !contains(found.inverted, across) && !contains(found.flat, across);
    }
  }
  return count;
}

int count_components(const Mesh& mesh, const FewFaces& inverted) {
  if (inverted.size() < 2) return static_cast<int>(inverted.size());
  return inverted_components(mesh, {inverted.data(), inverted.size()}).count;
}

// The smallest of the user's numbers, or none.
UserFace seed_of(const Mesh& mesh, const Survey& found) {
  UserFace seed;
  for (const auto* faces : {&found.inverted, &found.flat}) {
    for (const Face face : *faces) {
      const UserFace user = mesh.user_face(face);
      if (user != none && (seed == none || user < seed)) seed = user;
    }
  }
  return seed;
}

}  // namespace

Tangles detect(const Mesh& mesh, const Move& move, RepairRecord& record) {
  const Stopwatch detecting;
  auto tangles = detect(mesh, move.minima(), move.moved());
  record.inverted = static_cast<int>(tangles.inverted.size());
  record.degenerate = static_cast<int>(tangles.flat.size());
  record.detect_ms = detecting.milliseconds();
  return tangles;
}

RegionRecord describe_region(const Mesh& mesh, const Hole& region) {
  RegionRecord record;
  record.faces.assign(region.faces.begin(), region.faces.end());
  const Survey found = survey(mesh, region.faces);
  record.seed = seed_of(mesh, found);
  record.inverted = static_cast<int>(found.inverted.size());
  record.degenerate = static_cast<int>(found.flat.size());
  record.components = count_components(mesh, found.inverted);
  record.explored = region.size();
  record.border_edges = static_cast<int>(region.border.size());
  record.crease_edges = count_crease_edges(mesh, found);
  record.centre = found.low + 0.5 * (found.high - found.low);
  record.user_faces.reserve(record.faces.size());
  for (const Face face : record.faces) {
    if (!mesh.is_padding(face)) record.user_faces.push_back(mesh.user_face(face));
  }
  sort_distinct(record.user_faces, mesh.n_faces());
  return record;
}

bool is_seeded_before(const RegionRecord& a, const RegionRecord& b) {
  return std::pair(a.seed == none, a.seed) < std::pair(b.seed == none, b.seed);
}

int count_escaped(const Mesh& mesh, const RepairOptions& options) {
  if (!options.allow_escaped) return 0;
  std::vector<bool> escaped(mesh.n_vertices(), false);
  for (const Face face : mesh.faces()) {
    for (const Vertex v : mesh.triangles()[face]) {
      if (!mesh.is_constrained(v) && mesh.home_label(v) != mesh.label(face)) escaped[v] = true;
    }
  }
  return static_cast<int>(std::count(escaped.begin(), escaped.end(), true));
}

}  // namespace kinemesh
