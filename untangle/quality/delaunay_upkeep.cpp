#include "untangle/quality/delaunay_upkeep.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <new>

namespace kinemesh {
namespace {

// Calls f(i) for 0 <= i < n in all threads; where there is no memory left to start them, in this one. So f
// may come twice for an i.
template <class F>
void for_all(int n, const F& f) {
  const auto sweep = [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i != range.end(); ++i) f(i);
  };
  const tbb::blocked_range<int> all(0, n, 1 << 14);
  try {
    tbb::parallel_for(all, sweep);
  } catch (const std::bad_alloc&) {
    sweep(all);
  }
}

}  // namespace

DelaunayUpkeep::DelaunayUpkeep(const Mesh& mesh)
    : has_moved_(mesh.n_vertices(), false),
      has_changed_(mesh.n_faces(), false),
      is_wrong_(mesh.n_edges(), false) {
  wrong_.reserve(mesh.n_edges());
  flipping_.reserve(mesh);
}

// The mesh is valid, so flips meet no tangle, which alone could stop them.
int DelaunayUpkeep::improve(Mesh& mesh, std::span<const Point> before,
                            std::span<const RegionRecord> replaced) {
  find_changed_faces(mesh, before, replaced);
  find_wrong_edges(mesh);
  return flipping_.run(mesh, wrong_).flips;
}

void DelaunayUpkeep::find_changed_faces(const Mesh& mesh, std::span<const Point> before,
                                        std::span<const RegionRecord> replaced) {
  if (before.empty()) {
    std::fill(has_changed_.begin(), has_changed_.end(), true);
    return;
  }
  const Point* const now = mesh.positions().data();
  const Triangle* const triangles = mesh.triangles().data();
  for_all(mesh.n_vertices(), [&](int v) { has_moved_[v] = now[v] != before[v]; });
  for_all(mesh.n_faces(), [&](int f) {
    const auto& [a, b, c] = triangles[f];
    has_changed_[f] = has_moved_[a] | has_moved_[b] | has_moved_[c];
  });
  for (const auto& region : replaced)
    for (const int face : region.faces) has_changed_[face] = true;
}

void DelaunayUpkeep::find_wrong_edges(const Mesh& mesh) {
  for_all(mesh.n_faces(), [&](int f) {
    if (has_changed_[f]) judge_sides(mesh, f);
  });
  wrong_.clear();
  for (int edge = 0; edge < mesh.n_edges(); ++edge) {
    if (!is_wrong_[edge]) continue;
    wrong_.push_back(edge);
    is_wrong_[edge] = false;
  }
}

// An edge between two changed faces is left to the one with the smaller number.
void DelaunayUpkeep::judge_sides(const Mesh& mesh, int face) {
  for (const int side : mesh.sides(face)) {
    const int edge = Mesh::edge_of(side), other = mesh.face_of(Mesh::opposite(side));
    if (!mesh.is_flippable(edge) || (other < face && has_changed_[other])) continue;
    is_wrong_[edge] = !is_locally_delaunay(mesh, edge);
  }
}

}  // namespace kinemesh
