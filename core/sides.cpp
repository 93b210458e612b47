#include "core/sides.h"

#include <algorithm>

namespace kinemesh {
namespace {

// Seen from the side's lower vertex.
struct Entry {
  int other;  // its higher vertex
  int side;
};

// All sides, grouped by lower vertex: those of v are entries[first[v]] to entries[first[v + 1]].
struct SidesByVertex {
  std::vector<int> first;
  std::vector<Entry> entries;
};

SidesByVertex group(std::span<const Triangle> triangles, int n_vertices) {
  const int n_sides = 3 * static_cast<int>(triangles.size());
  SidesByVertex result{std::vector<int>(n_vertices + 2, 0), std::vector<Entry>(n_sides)};
  const auto low = [&](int side) {
    const auto [a, b] = ends_of_side(triangles, side);
    return std::min(a, b);
  };
  // Counts go two places up, so that the fill below leaves each start where it belongs.
  for (int s = 0; s < n_sides; ++s) ++result.first[low(s) + 2];
  for (int v = 2; v <= n_vertices + 1; ++v) result.first[v] += result.first[v - 1];
  for (int s = 0; s < n_sides; ++s) {
    const auto [a, b] = ends_of_side(triangles, s);
    result.entries[result.first[std::min(a, b) + 1]++] = {std::max(a, b), s};
  }
  return result;
}

bool same_direction(std::span<const Triangle> triangles, int s, int t) {
  return ends_of_side(triangles, s) == ends_of_side(triangles, t);
}

}  // namespace

SidePairs pair_sides(std::span<const Triangle> triangles, int n_vertices) {
  auto sides = group(triangles, n_vertices);
  SidePairs pairs{std::vector<int>(3 * triangles.size(), none), none};
  for (int v = 0; v < n_vertices; ++v) {
    const auto begin = sides.entries.begin() + sides.first[v],
               end = sides.entries.begin() + sides.first[v + 1];
    std::sort(begin, end, [](const Entry& a, const Entry& b) {
      return a.other != b.other ? a.other < b.other : a.side < b.side;
    });
    for (auto it = begin; it != end;) {
      const auto last = std::find_if(it, end, [&](const Entry& e) { return e.other != it->other; });
      if (last - it == 2 && !same_direction(triangles, it->side, it[1].side)) {
        pairs.opposite[it->side] = it[1].side;
        pairs.opposite[it[1].side] = it->side;
      } else if (last - it > 1 && pairs.conflict == none) {
        pairs.conflict = last[-1].side / 3;
      }
      it = last;
    }
  }
  return pairs;
}

}  // namespace kinemesh
