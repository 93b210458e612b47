#include "core/check/adjacency.h"

#include <algorithm>
#include <utility>

#include "core/base/ascending.h"
#include "core/mesh/sides.h"

namespace kinemesh {
namespace {

int next_in_face(int side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

// Turns about the vertex where `side` ends until the border is met again.
int next_on_border(std::span<const int> opposite, int side) {
  int next = next_in_face(side);
  while (opposite[next] != none) next = next_in_face(opposite[next]);
  return next;
}

void close_part(std::span<const int> opposite, int first, std::vector<bool>& open) {
  std::vector<int> stack{first};
  open[first] = false;
  while (!stack.empty()) {
    const int face = stack.back();
    stack.pop_back();
    for (int side = 3 * face; side < 3 * face + 3; ++side) {
      const int other = opposite[side] == none ? none : opposite[side] / 3;
      if (other == none || !open[other]) continue;
      open[other] = false;
      stack.push_back(other);
    }
  }
}

}  // namespace

int count_parts(std::span<const int> opposite, const std::vector<bool>& in) {
  std::vector<bool> open = in;  // not visited yet
  int count = 0;
  for (int face = 0; face < static_cast<int>(in.size()); ++face) {
    if (!open[face]) continue;
    close_part(opposite, face, open);
    ++count;
  }
  return count;
}

int count_border_loops(std::span<const int> opposite) {
  std::vector<bool> seen(opposite.size(), false);
  int count = 0;
  for (int first = 0; first < static_cast<int>(opposite.size()); ++first) {
    if (opposite[first] != none || seen[first]) continue;
    ++count;
    for (int side = first; !seen[side]; side = next_on_border(opposite, side)) seen[side] = true;
  }
  return count;
}

std::vector<int> missing_edges(std::span<const Triangle> triangles, std::span<const Edge> edges) {
  std::vector<std::pair<Edge, int>> wanted;
  for (int i = 0; i < static_cast<int>(edges.size()); ++i) wanted.emplace_back(ascending(edges[i]), i);
  std::sort(wanted.begin(), wanted.end());
  std::vector<bool> found(edges.size(), false);
  for (int side = 0; side < 3 * static_cast<int>(triangles.size()); ++side) {
    const Edge edge = ascending(ends_of_side(triangles, side));
    auto it = std::lower_bound(wanted.begin(), wanted.end(), std::pair(edge, 0));
    for (; it != wanted.end() && it->first == edge; ++it) found[it->second] = true;
  }
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(edges.size()); ++i)
    if (!found[i]) result.push_back(i);
  return result;
}

}  // namespace kinemesh
