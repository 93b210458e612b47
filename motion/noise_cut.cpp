#include "motion/noise_cut.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace kinemesh {
namespace {

constexpr double most_cells = 1024.0;  // along a side of the grid: a megabyte at most
constexpr double slack = 1.0 + 1e-6;   // for the rounding of distances and cells

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

NoiseCut::NoiseCut(std::span<const Point> points, std::span<const Edge> edges, double longest, double closest)
    : edges_(points, edges), closest_(closest) {
  const double reach = 2.0 * longest * slack;
  all_near_ = !std::isfinite(reach);
  if (edges.empty() || !(reach > 0.0) || all_near_) return;
  Point low(infinity, infinity), high(-infinity, -infinity);
  for (const auto& edge : edges)
    for (const int v : edge) {
      low = glm::min(low, points[v]);
      high = glm::max(high, points[v]);
    }
  const Point extent = high - low + 2.0 * reach;
  low_ = low - reach;
  cell_ = std::max(reach, std::max(extent.x, extent.y) / most_cells);
  columns_ = static_cast<int>(extent.x / cell_) + 1;
  rows_ = static_cast<int>(extent.y / cell_) + 1;
  near_.assign(static_cast<std::size_t>(columns_) * rows_, 0);
  for (const auto& [from, to] : edges) mark(points[from], points[to], reach);
}

Point NoiseCut::operator()(const Point& x, const Point& noise) const {
  if (!is_near(x)) return noise;
  const double length = glm::length(noise), distance = edges_.distance(x), most = 0.5 * distance;
  const Point way = length <= most ? noise : noise * (most / length);
  // Half the distance at most is left.
  if (distance >= 2.0 * closest_ || edges_.distance(x + way) >= std::min(distance, closest_)) return way;
  return {0.0, 0.0};
}

// Row by row, the cells within reach of the part of the segment that is within reach of the row.
void NoiseCut::mark(const Point& a, const Point& b, double reach) {
  const double wide = reach + 1e-6 * cell_;
  const Point& lower = a.y <= b.y ? a : b;
  const Point& upper = a.y <= b.y ? b : a;
  const double rise = upper.y - lower.y;
  const auto x_at = [&](double y) {
    const double s = rise > 0.0 ? std::clamp((y - lower.y) / rise, 0.0, 1.0) : 0.0;
    return lower.x + s * (upper.x - lower.x);
  };
  for (int j = row(lower.y - wide); j <= row(upper.y + wide); ++j) {
    const double bottom = low_.y + j * cell_;
    const double x0 = rise > 0.0 ? x_at(bottom - wide) : a.x;
    const double x1 = rise > 0.0 ? x_at(bottom + cell_ + wide) : b.x;
    const auto first = near_.begin() + static_cast<std::ptrdiff_t>(j) * columns_;
    std::fill(first + column(std::min(x0, x1) - wide), first + column(std::max(x0, x1) + wide) + 1, 1);
  }
}

bool NoiseCut::is_near(const Point& x) const {
  if (all_near_) return true;
  const Point p = (x - low_) / cell_;
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < columns_ && p.y < rows_)) return false;
  return near_[static_cast<std::size_t>(p.y) * columns_ + static_cast<std::size_t>(p.x)] != 0;
}

int NoiseCut::column(double x) const {
  return static_cast<int>(std::clamp((x - low_.x) / cell_, 0.0, columns_ - 1.0));
}
int NoiseCut::row(double y) const {
  return static_cast<int>(std::clamp((y - low_.y) / cell_, 0.0, rows_ - 1.0));
}

}  // namespace kinemesh
