#include "untangle/records.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace kinemesh {
namespace {

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

int count_distinct(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  return static_cast<int>(std::unique(values.begin(), values.end()) - values.begin());
}

// Between an inverted face and an upright one, seen from the inverted one.
int count_crease_edges(const Mesh& mesh, int inverted_face, const Tangles& tangles) {
  int count = 0;
  for (const int side : mesh.sides(inverted_face)) {
    const int across = mesh.face_of(Mesh::opposite(side));
    count += across != none && !contains(tangles.inverted, across) && !contains(tangles.flat, across);
  }
  return count;
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

RegionRecord describe_region(const Mesh& mesh, const FaceSets& sets, int set, const Tangles& tangles,
                             const Components& components) {
  const auto& faces = sets.faces(set);
  RegionRecord record;
  record.faces = faces;
  record.border_edges = count_border_edges(mesh, sets, set);
  record.centre = centre_of(mesh, faces);
  record.explored = static_cast<int>(faces.size());
  std::vector<int> numbers;
  for (const int face : faces) {
    const int user = mesh.user_face(face);
    if (user != none) record.user_faces.push_back(user);
    const auto found = std::lower_bound(tangles.inverted.begin(), tangles.inverted.end(), face);
    const bool inverted = found != tangles.inverted.end() && *found == face;
    const bool flat = !inverted && contains(tangles.flat, face);
    if (inverted) {
      numbers.push_back(components.of[found - tangles.inverted.begin()]);
      record.crease_edges += count_crease_edges(mesh, face, tangles);
    }
    record.inverted += inverted;
    record.degenerate += flat;
    if ((inverted || flat) && user != none && (record.seed == none || user < record.seed)) record.seed = user;
  }
  record.components = count_distinct(std::move(numbers));
  std::sort(record.user_faces.begin(), record.user_faces.end());
  return record;
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
