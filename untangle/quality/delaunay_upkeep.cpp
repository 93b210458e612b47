#include "untangle/quality/delaunay_upkeep.h"

#include <algorithm>
#include <new>

#include "core/parallel.h"
#include "core/predicates.h"

namespace kinemesh {
namespace {

// Calls f(i) for 0 <= i < n in all threads; where there is no memory left to start them, in this one. So f
// may come twice for an i.
template <class F>
void for_all(int n, const F& f) {
  const auto sweep = [&](int, int begin, int end) {
    for (int i = begin; i != end; ++i) f(i);
  };
  try {
    parallel_parts(n, 1 << 14, sweep);
  } catch (const std::bad_alloc&) {
    sweep(0, 0, n);
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

// An edge between two changed faces is left to the one with the smaller number. Corners are read from the
// flat mirror of the faces, which is closer together than the half-edges.
void DelaunayUpkeep::judge_sides(const Mesh& mesh, int face) {
  const auto x = mesh.positions();
  const auto& t = mesh.triangles()[face];
  const Triangle sides = mesh.sides(face);
  for (int k = 0; k < 3; ++k) {
    const int edge = Mesh::edge_of(sides[k]), other = mesh.face_of(Mesh::opposite(sides[k]));
    if (other == none || (other < face && has_changed_[other]) || mesh.constraint_of(edge) != none) continue;
    const auto& o = mesh.triangles()[other];
    const int apex = o[0] ^ o[1] ^ o[2] ^ t[k] ^ t[(k + 1) % 3];  // what is left of its corners
    is_wrong_[edge] = in_circle(x[t[0]], x[t[1]], x[t[2]], x[apex]) == Side::Inside;
  }
}

}  // namespace kinemesh
