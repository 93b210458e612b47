#include "core/mesh/curve.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/base/parallel.h"

namespace kinemesh {
namespace {

struct Keyed {
  std::uint64_t key;
  int number;
  auto operator<=>(const Keyed&) const = default;
};

// Cells of a square grid over the box.
class Grid {
 public:
  // Halved, so that nothing overflows.
  explicit Grid(const Box& box)
      : low_(0.5 * box.low), half_size_(std::max(0.5 * box.high.x - low_.x, 0.5 * box.high.y - low_.y)) {}

  std::uint64_t key(const Point& p) const {
    return distance_on_curve(cell(0.5 * p.x - low_.x), cell(0.5 * p.y - low_.y));
  }

 private:
  std::uint32_t cell(double half_way) const {
    if (!(half_way > 0.0)) return 0;
    if (half_way >= half_size_) return ~std::uint32_t{0};
    return static_cast<std::uint32_t>(std::min(half_way / half_size_ * 0x1p32, 0x1p32 - 1.0));
  }

  // From the first bit on: which quarter of the square, and how the curve lies in it.
  static std::uint64_t distance_on_curve(std::uint32_t x, std::uint32_t y) {
    std::uint64_t distance = 0;
    for (int bit = 31; bit >= 0; --bit) {
      const std::uint32_t right = x >> bit & 1, upper = y >> bit & 1;
      distance = distance << 2 | ((3 * right) ^ upper);
      if (upper != 0) continue;
      if (right != 0) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
    return distance;
  }

  Point low_;
  double half_size_;
};

void sort_in_parallel(std::span<Keyed> points, int depth) {
  if (depth == 0 || points.size() < 2 * grain::items) return std::sort(points.begin(), points.end());
  const auto half = points.size() / 2;
  parallel_pair([&] { sort_in_parallel(points.first(half), depth - 1); },
                [&] { sort_in_parallel(points.subspan(half), depth - 1); });
  std::inplace_merge(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end());
}

}  // namespace

std::vector<int> order_along_curve(std::span<const Point> points, const Box& box) {
  const Grid grid(box);
  const int n = static_cast<int>(points.size());
  std::vector<Keyed> keyed(points.size());
  parallel_parts(n, grain::items, [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) keyed[i] = {grid.key(points[i]), i};
  });
  sort_in_parallel(keyed, 3);
  std::vector<int> order(points.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& p) { return p.number; });
  return order;
}

}  // namespace kinemesh
