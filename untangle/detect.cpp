#include "untangle/detect.h"

#include <algorithm>
#include <bit>

#include "core/face_sweep.h"
#include "core/parallel.h"
#include "core/predicates.h"

namespace kinemesh {
namespace {

constexpr int grain = 256;  // stretches that are worth a task

void judge(const Mesh& mesh, int f, Tangles& found) {
  const auto [a, b, c] = mesh.corners(f);
  const auto turn = orientation(a, b, c);
  if (turn == Orientation::CounterClockwise) return;
  (turn == Orientation::Clockwise ? found.inverted : found.flat).push_back(f);
}

void sweep(const Mesh& mesh, int stretch, Tangles& found, FaceMinima* minima) {
  const Sight sight = look_at_stretch(mesh, stretch);
  for (auto doubtful = sight.doubtful; doubtful != 0; doubtful &= doubtful - 1)
    judge(mesh, stretch * stretch_faces + std::countr_zero(doubtful), found);
  if (minima) minima->set(stretch, {sight.twice_area, sight.tangent}, mesh);
}

void append(std::vector<int>& all, const std::vector<int>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

}  // namespace

Tangles detect(const Mesh& mesh, FaceMinima* minima) {
  if (minima) minima->reset(mesh.n_faces());
  const int n = n_stretches(mesh.n_faces());
  std::vector<Tangles> found(n_parts(n, grain));
  parallel_parts(n, grain, [&](int part, int begin, int end) {
    for (int stretch = begin; stretch < end; ++stretch) sweep(mesh, stretch, found[part], minima);
  });
  Tangles all;
  for (const auto& part : found) {
    append(all.inverted, part.inverted);
    append(all.flat, part.flat);
  }
  return all;
}

Tangles tangles_among(const Mesh& mesh, std::span<const int> faces) {
  Tangles found;
  for (const int face : faces) judge(mesh, face, found);
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
