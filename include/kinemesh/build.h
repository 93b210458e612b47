// From plain arrays to a mesh that can be moved and repaired.
#pragma once

#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/error.h"
#include "kinemesh/mesh.h"
#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

struct BuildOptions {
  double frame =
      0.0;  // margin of the outer padding in bounding-box diagonals; 0: none, the convex hull must not move
  std::vector<int> fixed = {};  // user's vertices that no motion moves
};

// The domain has no embedding as given: its borders cross, touch or overlap.
class NoEmbedding : public InputError {
 public:
  explicit NoEmbedding(Defect defect) : InputError(defect.message()), defect_(std::move(defect)) {}
  const Defect& defect() const { return defect_; }

 private:
  Defect defect_;
};

// Embeds `data` in padding, renumbers along a Hilbert curve, constrains borders, markers and label
// interfaces. Faces may be tangled; borders may not. Pre: consistent winding, as make_consistent
// (kinemesh/orient.h) leaves it. Throws InputError for wrong indices and non-manifold faces, NoEmbedding
// where borders or constrained edges cross, touch or are inside out.
Mesh build_mesh(const MeshData& data, const BuildOptions& options = {});

}  // namespace kinemesh
#pragma GCC visibility pop
