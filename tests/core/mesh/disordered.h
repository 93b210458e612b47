// The same mesh, stored in another order.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "core/mesh/ordered_build.h"

namespace kinemesh::test {

inline Mesh disordered(const MeshData& data, const BuildOptions& options, std::uint64_t seed) {
  std::vector<int> order(data.points.size() + (options.frame > 0.0 ? 4 : 0));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  return build_mesh(data, options, order);
}

}  // namespace kinemesh::test
