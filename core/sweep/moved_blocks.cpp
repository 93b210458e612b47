#include "core/sweep/moved_blocks.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace kinemesh {
namespace {

bool differ(std::span<const Point> a, std::span<const Point> b) {
  int n = 0;  // counted to the end: the compiler takes several at a time
  for (std::size_t i = 0; i < a.size(); ++i) n += int{a[i].x != b[i].x} | int{a[i].y != b[i].y};
  return n > 0;
}

}  // namespace

void MovedBlocks::find(std::span<const Point> before, std::span<const Point> now) {
  const std::size_t n = now.size();
  is_moved_.resize((n + block_vertices - 1) / block_vertices);
  parallel_parts(static_cast<int>(is_moved_.size()), grain::stretches, [&](int, int begin, int end) {
    for (int block = begin; block < end; ++block) {
      const std::size_t first = std::size_t{block_vertices} * block;
      const std::size_t size = std::min<std::size_t>(block_vertices, n - first);
      is_moved_[block] = differ(before.subspan(first, size), now.subspan(first, size));
    }
  });
}

bool MovedBlocks::contain_all() const {
  return std::ranges::all_of(is_moved_, [](char moved) { return moved != 0; });
}

}  // namespace kinemesh
