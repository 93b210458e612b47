// Vertices in blocks that lie together along the mesh's Hilbert curve, and loops over them. For .cpp files:
// brings TBB.
#pragma once

#include <numeric>

#include "core/base/parallel.h"
#include "kinemesh/types.h"

namespace kinemesh {

// Vertices 32 b to 32 b + 31 are block b.
inline constexpr int block_vertices = 32;

inline int block_of(Vertex vertex) {
  return vertex / block_vertices;
}
inline int n_blocks(int n_vertices) {
  return (n_vertices + block_vertices - 1) / block_vertices;
}

// Calls body(part, begin, end), vertices begin to end, for each part in all threads. Parts are of whole
// blocks and depend on n only.
template <class Body>
void parallel_blocks(int n_vertices, const Body& body) {
  parallel_parts(n_blocks(n_vertices), grain::stretches / 4, [&](int part, int begin, int end) {
    body(part, begin * block_vertices, std::min(end * block_vertices, n_vertices));
  });
}

// The sum of what body(begin, end) returns, in the order of the parts.
template <class Body>
double sum_over_blocks(int n_vertices, const Body& body) {
  std::array<double, most_parts> sums{};
  parallel_blocks(n_vertices, [&](int part, int begin, int end) { sums[part] = body(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace kinemesh
