#include "untangle/quality/delaunay_upkeep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/base/parallel.h"
#include "core/mesh/around.h"
#include "core/sweep/face_sweep.h"
#include "kinemesh/predicates.h"
#include "untangle/quality/cotangents.h"

namespace kinemesh {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

// True of constrained edges and those of the hull. Corners are read from the flat mirror of the faces, which is
// closer together than the half-edges.
bool is_locally_delaunay(const Mesh& mesh, int edge) {
  if (!mesh.is_flippable(edge)) return true;
  const auto x = mesh.positions();
  const auto& t = mesh.triangles()[mesh.face_of(2 * edge)];
  const auto& o = mesh.triangles()[mesh.face_of(2 * edge + 1)];
  const int apex =
      o[0] ^ o[1] ^ o[2] ^ mesh.from(2 * edge) ^ mesh.to(2 * edge);  // what is left of its corners
  return in_circle(x[t[0]], x[t[1]], x[t[2]], x[apex]) != Side::Inside;
}

// Asks for what sides() reads.
void fetch_side(const Mesh& mesh, int face) {
  __builtin_prefetch(&mesh.connectivity().halfedge(OpenMesh::HalfedgeHandle(mesh.halfedge_of(face))));
}

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
      cotangent_(2 * mesh.n_edges(), unknown),
      is_wrong_(mesh.n_edges(), false) {
  wrong_.reserve(mesh.n_edges());
  flipping_.reserve(mesh);
}

// The mesh is valid, so flips meet no tangle, which alone could stop them.
QualityCounts DelaunayUpkeep::improve(Mesh& mesh, const QualityInputs& inputs) {
  find_changed_faces(mesh, inputs.before, inputs.replaced);
  find_wrong_edges(mesh);
  return {.flips = flipping_.run(mesh, wrong_).flips};
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
    if (has_changed_[f]) bound_angles(mesh, f);
  });
  for_all(mesh.n_edges(), [&](int e) {
    if (needs_judgement(e)) is_wrong_[e] = !is_locally_delaunay(mesh, e);
  });
  wrong_.clear();
  for (int edge = 0; edge < mesh.n_edges(); ++edge) {
    if (!is_wrong_[edge]) continue;
    wrong_.push_back(side_along(mesh, lower_side(mesh, edge)));
    is_wrong_[edge] = false;
  }
  std::sort(wrong_.begin(), wrong_.end());  // in no order that depends on what was flipped before
}

void DelaunayUpkeep::bound_angles(const Mesh& mesh, int face) {
  fetch_ahead(mesh.triangles(), mesh.positions(), face);
  fetch_side(mesh, std::min(face + 32, mesh.n_faces() - 1));
  const auto bounds = cotangent_bounds(mesh.corners(face));
  const Triangle sides = mesh.sides(face);
  for (int k = 0; k < 3; ++k) cotangent_[sides[k]] = bounds[k];
}

// Of an edge of a changed face; not if it is proved to be locally Delaunay. Forgets what is known of it, so
// that a second call, where memory was short, is true once more only for an edge that has not been judged.
bool DelaunayUpkeep::needs_judgement(int edge) {
  float& left = cotangent_[2 * edge];
  float& right = cotangent_[2 * edge + 1];
  if (std::isnan(left) && std::isnan(right)) return false;
  const bool is_proved = left + right >= 0.0f;
  left = right = unknown;
  return !is_proved;
}

}  // namespace kinemesh
