#include "tests/untangle/properties.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <set>

#include "kinemesh/measure.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/random_tangles.h"

namespace kinemesh::test {
namespace {

using std::to_string;

constexpr RepairOptions allowing{.allow_escaped = true};

RepairOutcome repair(Mesh& mesh, const char* strategy) {
  return make_strategy(strategy)->repair(mesh, allowing);
}

std::vector<bool> replaced_faces(const Mesh& mesh, const RepairRecord& record) {
  std::vector<bool> replaced(mesh.n_faces(), false);
  for (const auto& region : record.regions) {
    for (const Face f : region.faces) replaced[f] = true;
  }
  return replaced;
}

std::set<int> escaped_vertices(const Mesh& mesh) {
  std::set<int> escaped;
  for (const Face f : mesh.faces()) {
    for (const Vertex v : mesh.triangles()[f]) {
      if (!mesh.is_constrained(v) && mesh.home_label(v) != mesh.label(f)) escaped.insert(v);
    }
  }
  return escaped;
}

std::string escaped_miscounted(const Mesh& after, const RepairRecord& record) {
  return record.escaped == static_cast<int>(escaped_vertices(after).size()) ? ""
                                                                            : "escaped vertices miscounted";
}

// Where vertices escape or come home, faces change sides; elsewhere the user's numbers are what they were.
std::string numbering_changed(const Mesh& before, const Mesh& after) {
  if (after.n_user_faces() != static_cast<int>(after.domain().triangles.size())) return "faces miscounted";
  if (!escaped_vertices(before).empty() || !escaped_vertices(after).empty()) return "";
  const auto labels_by_number = [](const Mesh& mesh) {
    std::vector<std::pair<int, int>> numbers;
    for (const Face f : mesh.faces()) {
      if (!mesh.is_padding(f)) numbers.emplace_back(mesh.user_face(f), mesh.label(f));
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  };
  if (labels_by_number(before) != labels_by_number(after)) return "changed the user's numbers";
  return "";
}

std::string not_disjoint(const RepairRecord& record) {
  std::set<int> all;
  for (const auto& region : record.regions) {
    for (const Face f : region.faces) {
      if (!all.insert(f).second) return "face " + to_string(f) + " is in two regions";
    }
  }
  return record.replaced == static_cast<int>(all.size()) ? "" : "miscounted the replaced faces";
}

std::string first_of(std::initializer_list<std::string> sentences) {
  for (const auto& s : sentences) {
    if (!s.empty()) return s;
  }
  return "";
}

// Brute-force counterparts of a region's numbers.
struct RegionCounts {
  UserFace seed;
  int inverted = 0, components = 0, border_edges = 0, crease_edges = 0;
};

RegionCounts count(const Mesh& mesh, const std::vector<Face>& faces) {
  RegionCounts counts;
  const std::set<int> region(faces.begin(), faces.end());
  const auto inverted_faces = oracle::inverted(mesh);
  const std::set<int> inverted(inverted_faces.begin(), inverted_faces.end());
  for (const Face f : faces) {
    const UserFace user = mesh.user_face(f);
    if (inverted.contains(f) && user != none && (counts.seed == none || user < counts.seed))
      counts.seed = user;
    counts.inverted += inverted.contains(f);
    for (const Side h : Mesh::sides(f)) {
      const Face across = mesh.face_across(h);
      counts.border_edges += !region.contains(across);
      counts.crease_edges += inverted.contains(f) && across != none && !inverted.contains(across);
    }
  }
  for (const auto& component : oracle::inverted_components(mesh)) {
    counts.components += region.contains(component.front());
  }
  return counts;
}

std::string region_wrong(const Mesh& before, const RegionRecord& region) {
  const auto counts = count(before, {region.faces.begin(), region.faces.end()});
  if (region.seed != counts.seed)
    return "seed is " + to_string(region.seed) + ", not " + to_string(counts.seed);
  if (region.inverted != counts.inverted) return "inverted faces miscounted";
  if (region.components != counts.components) return "components miscounted";
  if (region.border_edges != counts.border_edges) return "border edges miscounted";
  if (region.crease_edges != counts.crease_edges) return "crease edges miscounted";
  if (region.explored != static_cast<int>(region.faces.size())) return "explored outside the region";
  if (region.gamma != 1 || region.gamma_first_stable != 1) return "gamma is not 1";
  return "";
}

bool seeded_in_order(const std::vector<RegionRecord>& regions) {
  return std::is_sorted(regions.begin(), regions.end(), [](const RegionRecord& a, const RegionRecord& b) {
    return std::pair(a.seed == none, a.seed) < std::pair(b.seed == none, b.seed);
  });
}

Snapshot repaired_with_threads(Mesh mesh, std::size_t n) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, n);
  const auto outcome = repair(mesh, "global");
  return snapshot_of(mesh);
}

std::string remesh_disagrees(Mesh mesh) {
  const auto outcome = repair(mesh, "remesh");
  if (!outcome) return "remesh finds no mesh: " + outcome.defect->message();
  const auto defect = validate(mesh);
  return defect ? "remesh leaves " + defect->message() : "";
}

std::string check_repair(const Mesh& before, const Mesh& after, const RepairOutcome& outcome) {
  if (!outcome) return "failed: " + outcome.defect->message();
  if (outcome.record.retries() > 0) return to_string(outcome.record.retries()) + " retries";
  return first_of({contract_broken(before, after, outcome), remesh_disagrees(before)});
}

bool is_inside_frame(const Mesh& mesh, const Point& p) {
  const Point &low = mesh.position(mesh.frame()[0]), &high = mesh.position(mesh.frame()[2]);
  return low.x < p.x && p.x < high.x && low.y < p.y && p.y < high.y;
}

// Each culprit the defect names is one.
bool is_true(const Mesh& mesh, const Defect& defect) {
  const auto at = [&](UserVertex user) { return mesh.position(mesh.vertex_of_user(user)); };
  switch (defect.kind) {
    case DefectKind::CoincidentVertices:
      return defect.vertices.size() == 2 && at(defect.vertices[0]) == at(defect.vertices[1]);
    case DefectKind::VertexOnEdge:
    case DefectKind::CrossingEdges:
      return oracle::constraints_touch(mesh);
    case DefectKind::LabelsMeet: {  // brute force has no say, `remesh` has
      Mesh copy = mesh;
      return !repair(copy, "remesh");
    }
    case DefectKind::LeftDomain:
      return !mesh.frame().empty() && !is_inside_frame(mesh, at(defect.vertices[0]));
    default:
      return false;
  }
}

bool nothing_touches(const Mesh& mesh) {
  return oracle::coincident_vertices(mesh).first == none && !oracle::constraints_touch(mesh);
}

// Three steps, or until no valid mesh exists.
template <class Mover>
std::string check_steps(Tangle tangle, bool rigid, const Mover& move) {
  for (int step = 0; step < 3; ++step) {
    const auto wrong = check_step(tangle.mesh, rigid);
    if (!wrong.empty()) return tangle.about + ", step " + to_string(step) + ": " + wrong;
    if (validate(tangle.mesh)) break;
    move(tangle.mesh);
  }
  return "";
}

}  // namespace

std::string outside_changed(const Mesh& before, const Mesh& after, const RepairRecord& record) {
  const auto replaced = replaced_faces(before, record);
  const auto old_state = snapshot_of(before), new_state = snapshot_of(after);
  for (const Face f : before.faces()) {
    if (replaced[f]) continue;
    auto old_face = old_state.faces[f], new_face = new_state.faces[f];
    for (int k = 0; k < 3; ++k) {
      const Face across = before.face_across(Mesh::side(f, k));
      if (across != none && replaced[across]) old_face.opposite[k] = new_face.opposite[k] = none;
    }
    if (old_face != new_face) return "changed face " + to_string(f);
  }
  if (old_state.coordinates != new_state.coordinates) return "moved a vertex";
  return "";
}

std::string contract_broken(const Mesh& before, const Mesh& after, const RepairOutcome& outcome) {
  if (const auto defect = validate(after)) return "not valid: " + defect->message();
  Mesh again = after;
  const auto second = repair(again, "global");
  if (!second || !second.record.regions.empty() || !(snapshot_of(again) == snapshot_of(after)))
    return "a second repair did something";
  return first_of({outside_changed(before, after, outcome.record), numbering_changed(before, after),
                   escaped_miscounted(after, outcome.record), not_disjoint(outcome.record)});
}

std::string regions_wrong(const Mesh& before, const RepairRecord& record) {
  std::vector<std::vector<Face>> found;
  for (const auto& region : record.regions) found.emplace_back(region.faces.begin(), region.faces.end());
  std::sort(found.begin(), found.end());
  if (found != oracle::conflict_pieces(before)) return "the regions are not the pieces of phi(I)*";
  if (!seeded_in_order(record.regions)) return "the regions are not in the order of their seeds";
  if (record.components != static_cast<int>(oracle::inverted_components(before).size()))
    return "components miscounted";
  for (const auto& region : record.regions) {
    if (const auto wrong = region_wrong(before, region); !wrong.empty()) return wrong;
  }
  return "";
}

std::string check_step(Mesh& mesh, bool rigid) {
  const Mesh before = mesh;
  const auto outcome = repair(mesh, "global");
  const bool may_exist = nothing_touches(before);
  if (outcome) return may_exist ? check_repair(before, mesh, outcome) : "claims a mesh where none exists";
  if (!(snapshot_of(before) == snapshot_of(mesh))) return "a failure left its traces";
  if (may_exist && rigid) return "failed: " + outcome.defect->message();
  return is_true(before, *outcome.defect) ? "" : "untrue: " + outcome.defect->message();
}

std::string check_random_tangle(std::uint64_t seed) {
  const auto tangle = random_tangle(seed);
  Mesh mesh = tangle.mesh;
  const auto outcome = repair(mesh, "global");
  auto wrong = check_repair(tangle.mesh, mesh, outcome);
  const bool is_general = oracle::flat(tangle.mesh).empty();
  if (wrong.empty() && is_general) wrong = regions_wrong(tangle.mesh, outcome.record);
  if (wrong.empty() && !(snapshot_of(mesh) == repaired_with_threads(tangle.mesh, 1 + seed % 2)))
    wrong = "another number of threads, another mesh";
  return wrong.empty() ? "" : tangle.about + " " + to_string(seed) + ": " + wrong;
}

std::string check_lattice_tangle(std::uint64_t seed) {
  Random random(seed + 1);
  const auto wrong =
      check_steps(lattice_tangle(seed), true, [&](Mesh& mesh) { jump_on_lattice(mesh, random); });
  return wrong.empty() ? "" : to_string(seed) + ": " + wrong;
}

std::string check_polyomino_tangle(std::uint64_t seed) {
  Random random(seed + 1);
  const auto wrong =
      check_steps(polyomino_tangle(seed), false, [&](Mesh& mesh) { jump_anywhere(mesh, random); });
  return wrong.empty() ? "" : to_string(seed) + ": " + wrong;
}

}  // namespace kinemesh::test
