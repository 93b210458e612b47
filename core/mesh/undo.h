// Changes to a mesh's connectivity that are taken back unless they are kept.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/patch.h"

namespace kinemesh {

// 44 bytes for each face that is rewritten, each time. Where memory runs out the change has not been made,
// and those before it are still taken back.
class Undo {
 public:
  explicit Undo(Mesh& mesh) : mesh_(mesh) {}
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() { take_back(); }

  const Mesh& mesh() const { return mesh_; }

  void splice(Patch& patch);
  void flip(int side);

  std::vector<int> rewritten_faces() const;  // ascending, each once

  void keep() noexcept { old_.clear(); }
  void take_back() noexcept;  // all that was not kept, bit for bit

 private:
  void note(int face);

  Mesh& mesh_;
  std::vector<FaceState> old_;  // the latest last
};

// Faces as they are, ready for Mesh::restore.
std::vector<FaceState> states_of(const Mesh& mesh, std::span<const int> faces);

}  // namespace kinemesh
