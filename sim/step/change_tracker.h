// Remembers a mesh's connectivity from one accepted step to the next, to tell what a step has changed and to
// take it back.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/step_changes.h"
#include "kinemesh/strategy.h"

namespace kinemesh {

// Holds a copy of all faces, 48 bytes each, and keeps it up to date at a cost that follows what changes.
// Works for whatever rewrites faces, if it says which.
class ChangeTracker {
 public:
  explicit ChangeTracker(const Mesh& mesh);

  // Names the faces that may differ from the copy: those that the regions replaced and those that flips
  // rewrote. Takes no memory.
  void note(std::span<const RegionRecord> regions, std::span<const Face> flipped) noexcept;

  // What became of those of the domain, in patches by their smallest face. `regions` as noted.
  std::vector<ChangedPatch> patches(const Mesh& mesh, std::span<const RegionRecord> regions) const;

  void accept(const Mesh& mesh) noexcept;  // the copy follows the mesh
  void take_back(Mesh& mesh) noexcept;     // the mesh goes back to the copy, bit for bit, positions apart

 private:
  void note(Face face, bool is_flipped) noexcept;
  void forget() noexcept;
  void copy_face(const Mesh& mesh, Face face) noexcept;
  std::vector<int> patch_numbers(const Mesh& mesh, std::span<const RegionRecord> regions) const;
  FaceChange change_of(const Mesh& mesh, Face face) const;

  std::vector<FaceState> faces_;
  std::vector<UserFace> user_face_;  // per face
  std::vector<Face> changed_;        // has room for all
  std::vector<int> slot_;            // per face: where in changed_, or none
  std::vector<char> is_flipped_;     // per face
};

}  // namespace kinemesh
