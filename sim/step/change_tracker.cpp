#include "sim/step/change_tracker.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/base/disjoint_sets.h"

namespace kinemesh {
namespace {

// Calls visit(face) for those that the region has replaced.
template <class Visit>
void for_each_replaced(const RegionRecord& region, const Visit& visit) {
  for (const Face face : region.faces)
    if (!std::binary_search(region.kept.begin(), region.kept.end(), face)) visit(face);
}

Face first_replaced(const RegionRecord& region) {
  Face first;
  for_each_replaced(region, [&](Face face) { first = first == none ? face : first; });
  return first;
}

void sort_unique(std::vector<UserVertex>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Sorts the faces and collects their corners.
void finish(ChangedPatch& patch) {
  std::sort(patch.faces.begin(), patch.faces.end(),
            [](const FaceChange& a, const FaceChange& b) { return a.face < b.face; });
  for (const auto& change : patch.faces) {
    for (const auto& corners : {change.before, change.after})
      std::copy_if(corners.begin(), corners.end(), std::back_inserter(patch.vertices),
                   [](UserVertex v) { return v != none; });
  }
  sort_unique(patch.vertices);
}

}  // namespace

ChangeTracker::ChangeTracker(const Mesh& mesh)
    : faces_(mesh.n_faces()),
      user_face_(mesh.n_faces()),
      slot_(mesh.n_faces(), none),
      is_flipped_(mesh.n_faces(), false) {
  changed_.reserve(mesh.n_faces());
  for (const Face face : mesh.faces()) copy_face(mesh, face);
}

void ChangeTracker::copy_face(const Mesh& mesh, Face face) noexcept {
  faces_[face] = mesh.save(face);
  user_face_[face] = mesh.user_face(face);
}

void ChangeTracker::note(std::span<const RegionRecord> regions, std::span<const Face> flipped) noexcept {
  forget();
  for (const auto& region : regions) for_each_replaced(region, [&](Face face) { note(face, false); });
  for (const Face face : flipped) note(face, true);
}

void ChangeTracker::note(Face face, bool is_flipped) noexcept {
  is_flipped_[face] = is_flipped;
  if (slot_[face] != none) return;
  slot_[face] = static_cast<int>(changed_.size());
  changed_.push_back(face);
}

void ChangeTracker::forget() noexcept {
  for (const Face face : changed_) slot_[face] = none;
  changed_.clear();
}

void ChangeTracker::accept(const Mesh& mesh) noexcept {
  for (const Face face : changed_) {
    copy_face(mesh, face);
    for (const Side side : Mesh::sides(face))  // what lies across from a neighbour has changed, too
      if (const Face across = mesh.face_across(side); across != none) copy_face(mesh, across);
  }
  forget();
}

void ChangeTracker::take_back(Mesh& mesh) noexcept {
  mesh.restore(faces_, changed_);
  forget();
}

std::vector<ChangedPatch> ChangeTracker::patches(const Mesh& mesh,
                                                 std::span<const RegionRecord> regions) const {
  const auto number = patch_numbers(mesh, regions);
  const int count = number.empty() ? 0 : 1 + *std::max_element(number.begin(), number.end());
  std::vector<ChangedPatch> all(count);
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const auto change = change_of(mesh, changed_[i]);
    if (change.face != none) all[number[i]].faces.push_back(change);
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Face some = first_replaced(regions[r]);
    if (some != none) all[number[slot_[some]]].regions.push_back(static_cast<int>(r));
  }
  std::erase_if(all, [](const ChangedPatch& patch) { return patch.faces.empty(); });
  for (auto& patch : all) finish(patch);
  std::sort(all.begin(), all.end(), [](const ChangedPatch& a, const ChangedPatch& b) {
    return a.faces.front().face < b.faces.front().face;
  });
  return all;
}

// Of the faces in changed_. A region stays together. A flipped face belongs together with whatever changed
// beside it: the faces that connected flips have rewritten cover one polygon, and so hang together across
// their edges afterwards.
std::vector<int> ChangeTracker::patch_numbers(const Mesh& mesh, std::span<const RegionRecord> regions) const {
  DisjointSets sets(static_cast<int>(changed_.size()));
  for (const auto& region : regions) {
    const Face some = first_replaced(region);
    for_each_replaced(region, [&](Face face) { sets.join(slot_[some], slot_[face]); });
  }
  for (const Face face : changed_) {
    if (!is_flipped_[face]) continue;
    for (const Side side : mesh.sides(face)) {
      const Face across = mesh.face_across(side);
      if (across != none && slot_[across] != none) sets.join(slot_[face], slot_[across]);
    }
  }
  std::vector<int> numbers(changed_.size());
  int count = 0;
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i) {
    const int root = sets.root(i);  // the smallest of its set, and so numbered already
    numbers[i] = root == i ? count++ : numbers[root];
  }
  return numbers;
}

// Without a number where the face is padding before and after.
FaceChange ChangeTracker::change_of(const Mesh& mesh, Face face) const {
  const auto in_users = [&](const MeshTriangle& t) {
    return UserTriangle{mesh.user_vertex(t[0]), mesh.user_vertex(t[1]), mesh.user_vertex(t[2])};
  };
  const auto& old = faces_[face];
  const UserFace number = mesh.user_face(face);
  return {.face = number != none ? number : user_face_[face],
          .before = in_users(old.corners),
          .after = in_users(mesh.triangles()[face]),
          .label_before = old.label,
          .label_after = mesh.label(face)};
}

}  // namespace kinemesh
