// Changes to a mesh's connectivity that are taken back unless they are kept.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

// 60 bytes for each face that is rewritten, each time. Where memory runs out the change has not been made, and
// those before it are still taken back.
class Undo {
 public:
  explicit Undo(Mesh& mesh);
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() { take_back(); }

  const Mesh& mesh() const { return mesh_; }

  void splice(const Patch& patch);
  void flip(int edge);

  std::vector<int> rewritten_faces() const;  // ascending, each once

  void keep() noexcept { old_.clear(); }
  void take_back() noexcept;  // all that was not kept, bit for bit

 private:
  struct Face {
    int face, label;
    Triangle corners, sides, constraints, outgoing;
  };

  void note(int face);

  Mesh& mesh_;
  std::vector<Face> old_;  // the latest last
  Patch one_;              // a face on its way back
};

}  // namespace kinemesh
