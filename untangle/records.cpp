#include "untangle/records.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "core/predicates.h"
#include "untangle/detect.h"

namespace kinemesh {
namespace {

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

Tangles tangles_among(const Mesh& mesh, const std::vector<int>& faces) {
  Tangles tangles;
  for (const int face : faces) {
    const auto [a, b, c] = mesh.corners(face);
    const auto turn = orientation(a, b, c);
    if (turn == Orientation::Clockwise) tangles.inverted.push_back(face);
    if (turn == Orientation::Collinear) tangles.flat.push_back(face);
  }
  return tangles;
}

// Between inverted faces and upright ones.
int count_crease_edges(const Mesh& mesh, const Tangles& tangles) {
  int count = 0;
  for (const int face : tangles.inverted) {
    for (const int side : mesh.sides(face)) {
      const int across = mesh.face_of(Mesh::opposite(side));
      count += across != none && !contains(tangles.inverted, across) && !contains(tangles.flat, across);
    }
  }
  return count;
}

// The smallest of the user's numbers, or none.
int seed_of(const Mesh& mesh, const Tangles& tangles) {
  int seed = none;
  for (const auto* faces : {&tangles.inverted, &tangles.flat}) {
    for (const int face : *faces) {
      const int user = mesh.user_face(face);
      if (user != none && (seed == none || user < seed)) seed = user;
    }
  }
  return seed;
}

int count_border_edges(const Mesh& mesh, const FaceSets& sets, int set) {
  int count = 0;
  for (const int face : sets.faces(set)) {
    for (const int side : mesh.sides(face)) {
      const int across = mesh.face_of(Mesh::opposite(side));
      count += across == none || sets.set_of(across) != set;
    }
  }
  return count;
}

Point centre_of(const Mesh& mesh, const std::vector<int>& faces) {
  Point low = mesh.corners(faces.front())[0], high = low;
  for (const int face : faces) {
    for (const auto& p : mesh.corners(face)) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  return low + 0.5 * (high - low);
}

template <class Member>
int total(const std::vector<RegionRecord>& regions, const Member& member) {
  return std::transform_reduce(regions.begin(), regions.end(), 0, std::plus<>(), member);
}

}  // namespace

RegionRecord describe_region(const Mesh& mesh, const FaceSets& sets, int set) {
  RegionRecord record;
  record.faces = sets.faces(set);
  const auto tangles = tangles_among(mesh, record.faces);
  record.seed = seed_of(mesh, tangles);
  record.inverted = static_cast<int>(tangles.inverted.size());
  record.degenerate = static_cast<int>(tangles.flat.size());
  record.components = inverted_components(mesh, tangles.inverted).count;
  record.explored = static_cast<int>(record.faces.size());
  record.border_edges = count_border_edges(mesh, sets, set);
  record.crease_edges = count_crease_edges(mesh, tangles);
  record.centre = centre_of(mesh, record.faces);
  record.user_faces.reserve(record.faces.size());
  for (const int face : record.faces) {
    if (!mesh.is_padding(face)) record.user_faces.push_back(mesh.user_face(face));
  }
  std::sort(record.user_faces.begin(), record.user_faces.end());
  return record;
}

bool is_seeded_before(const RegionRecord& a, const RegionRecord& b) {
  return std::pair(a.seed == none, a.seed) < std::pair(b.seed == none, b.seed);
}

int count_escaped(const Mesh& mesh, const RepairOptions& options) {
  if (!options.allow_escaped) return 0;
  std::vector<bool> escaped(mesh.n_vertices(), false);
  for (int face = 0; face < mesh.n_faces(); ++face) {
    for (const int v : mesh.triangles()[face]) {
      if (!mesh.is_constrained(v) && mesh.home_label(v) != mesh.label(face)) escaped[v] = true;
    }
  }
  return static_cast<int>(std::count(escaped.begin(), escaped.end(), true));
}

int RepairRecord::region_faces() const {
  return total(regions, [](const RegionRecord& r) { return static_cast<int>(r.faces.size()); });
}

int RepairRecord::region_faces_max() const {
  int largest = 0;
  for (const auto& region : regions) largest = std::max(largest, static_cast<int>(region.faces.size()));
  return largest;
}

int RepairRecord::explored() const {
  return total(regions, [](const RegionRecord& r) { return r.explored; });
}

int RepairRecord::crease_edges() const {
  return total(regions, [](const RegionRecord& r) { return r.crease_edges; });
}

int RepairRecord::retries() const {
  return total(regions, [](const RegionRecord& r) { return r.retries; });
}

}  // namespace kinemesh
