#include "untangle/detect.h"

#include <algorithm>

#include "core/face_sweep.h"
#include "core/parallel.h"
#include "core/predicates.h"

namespace kinemesh {
namespace {

constexpr int grain = 1 << 14;  // faces that are worth a task

// The two products of orientation(), {l, r}.
Pair products(const Point* x, const Triangle& t) {
  return difference(x[t[0]], x[t[2]]) * swapped(difference(x[t[1]], x[t[2]]));
}

// Of each of two faces: -1 if the filter of orientation() proves it upright.
PairMask proves_upright(const Point* x, const Triangle& t, const Triangle& u) {
  const Pair p = products(x, t), q = products(x, u);
  const Pair l = firsts(p, q), r = seconds(p, q);
  return l - r > orientation_error * (magnitude(l) + magnitude(r)) + underflow_error;
}

void judge(const Point* x, const Triangle* triangles, int f, Tangles& found) {
  const auto [a, b, c] = triangles[f];
  const auto turn = orientation(x[a], x[b], x[c]);
  if (turn == Orientation::CounterClockwise) return;
  (turn == Orientation::Clockwise ? found.inverted : found.flat).push_back(f);
}

void sweep(const Mesh& mesh, int begin, int end, Tangles& found) {
  const Point* const x = mesh.positions().data();
  const Triangle* const triangles = mesh.triangles().data();
  int f = begin;
  for (; f + 1 < end; f += 2) {
    fetch_ahead(mesh.triangles(), mesh.positions(), f);
    fetch_ahead(mesh.triangles(), mesh.positions(), f + 1);
    const PairMask upright = proves_upright(x, triangles[f], triangles[f + 1]);
    if (upright[0] & upright[1]) [[likely]]
      continue;
    judge(x, triangles, f, found);
    judge(x, triangles, f + 1, found);
  }
  if (f < end) judge(x, triangles, f, found);
}

void append(std::vector<int>& all, const std::vector<int>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

}  // namespace

Tangles detect(const Mesh& mesh) {
  std::vector<Tangles> found(n_parts(mesh.n_faces(), grain));
  parallel_parts(mesh.n_faces(), grain,
                 [&](int part, int begin, int end) { sweep(mesh, begin, end, found[part]); });
  Tangles all;
  for (const auto& part : found) {
    append(all.inverted, part.inverted);
    append(all.flat, part.flat);
  }
  return all;
}

Tangles tangles_among(const Mesh& mesh, std::span<const int> faces) {
  Tangles found;
  for (const int face : faces) judge(mesh.positions().data(), mesh.triangles().data(), face, found);
  return found;
}

Components inverted_components(const Mesh& mesh, std::span<const int> inverted) {
  const auto rank_of = [&](int face) {
    const auto found = std::lower_bound(inverted.begin(), inverted.end(), face);
    return found != inverted.end() && *found == face ? static_cast<int>(found - inverted.begin()) : none;
  };
  Components components{std::vector<int>(inverted.size(), none), 0};
  std::vector<int> pending;
  for (std::size_t first = 0; first < inverted.size(); ++first) {
    if (components.of[first] != none) continue;
    components.of[first] = components.count;
    pending.push_back(static_cast<int>(first));
    while (!pending.empty()) {
      const int face = inverted[pending.back()];
      pending.pop_back();
      for (const int h : mesh.sides(face)) {
        const int neighbour = mesh.face_of(Mesh::opposite(h));
        const int rank = neighbour == none ? none : rank_of(neighbour);
        if (rank == none || components.of[rank] != none) continue;
        components.of[rank] = components.count;
        pending.push_back(rank);
      }
    }
    ++components.count;
  }
  return components;
}

}  // namespace kinemesh
