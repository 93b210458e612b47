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
  void flip(Side side);

  std::vector<Face> rewritten_faces() const;  // ascending, each once

  void keep() noexcept { old_.clear(); }

  // Calls look() while the mesh is as it was before; then all is there again, and kept. If look() throws, the
  // mesh stays as it was. faces: those rewritten. Takes memory before, and none afterwards.
  template <class Look>
  void look_back(std::span<const Face> faces, const Look& look) {
    std::vector<FaceState> now;
    for (const Face face : faces) now.push_back(mesh_.save(face));
    take_back();
    look();
    mesh_.restore(now);
  }
  void take_back() noexcept;  // all that was not kept, bit for bit

 private:
  void note(Face face);

  Mesh& mesh_;
  std::vector<FaceState> old_;  // the latest last
};

}  // namespace kinemesh
