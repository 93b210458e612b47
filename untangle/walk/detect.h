// Finds the faces a step has turned over.
#pragma once

#include <span>
#include <vector>

#include "core/sweep/face_minima.h"

namespace kinemesh {

struct Tangles {
  std::vector<Face> inverted;  // ascending
  std::vector<Face> flat;      // those of zero area, ascending

  bool empty() const { return inverted.empty() && flat.empty(); }
};

// Exact. Padding included. One sweep over all corners in all threads; the result does not depend on their
// number. Minima, where they are wanted, are measured on the way; what they know already is not looked at
// again unless it has moved since, which anything may have if `moved` is null.
Tangles detect(const Mesh& mesh, FaceMinima* minima = nullptr, const MovedBlocks* moved = nullptr);

// The same for these faces, in their order.
Tangles tangles_among(const Mesh& mesh, std::span<const Face> faces);

// Inverted components [Agarwal 2008, §2]: for each face of `tangles.inverted`, in its order, the number of
// its class under "shares an edge with", numbered by first appearance.
struct Components {
  std::vector<int> of;  // parallel to Tangles::inverted
  int count = 0;
};
Components inverted_components(const Mesh& mesh, std::span<const Face> inverted);

}  // namespace kinemesh
