#include "untangle/quality/delaunay_upkeep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/base/parallel.h"
#include "core/sweep/face_sweep.h"
#include "kinemesh/predicates.h"
#include "untangle/quality/cotangents.h"

namespace kinemesh {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

// True of constrained edges and those of the hull.
bool is_locally_delaunay(const Mesh& mesh, Side side) {
  if (!mesh.is_flippable(side)) return true;
  const auto [a, b, c] = mesh.corners(Mesh::face_of(side));
  return in_circle(a, b, c, mesh.position(mesh.apex(mesh.opposite(side)))) != InCircle::Inside;
}

// Of an edge of a changed face; not if it is proved to be locally Delaunay.
bool needs_judgement(float left, float right) {
  return !(std::isnan(left) && std::isnan(right)) && !(left + right >= 0.0f);
}

// Calls f(i) for all of them in all threads; where there is no memory left to start them, in this one. So f
// may come twice for an i.
template <class Number, class F>
void for_all(Numbers<Number> all, const F& f) {
  const auto sweep = [&](int, int begin, int end) {
    for (Number i(begin); i != end; ++i) f(i);
  };
  try {
    parallel_parts(all.size(), 1 << 14, sweep);
  } catch (const std::bad_alloc&) {
    sweep(0, 0, all.size());
  }
}

}  // namespace

DelaunayUpkeep::DelaunayUpkeep(const Mesh& mesh)
    : has_moved_(mesh.n_vertices(), false),
      has_changed_(mesh.n_faces(), false),
      cotangent_(mesh.n_faces(), {unknown, unknown, unknown}),
      is_wrong_(mesh.n_faces(), 0) {
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
  const MeshTriangle* const triangles = mesh.triangles().data();
  for_all(mesh.vertices(), [&](Vertex v) { has_moved_[v] = now[v] != before[v]; });
  for_all(mesh.faces(), [&](Face f) {
    const auto& [a, b, c] = triangles[f];
    has_changed_[f] = has_moved_[a] | has_moved_[b] | has_moved_[c];
  });
  for (const auto& region : replaced)
    for (const Face face : region.faces) has_changed_[face] = true;
}

void DelaunayUpkeep::find_wrong_edges(const Mesh& mesh) {
  for_all(mesh.faces(), [&](Face f) {
    if (has_changed_[f]) bound_angles(mesh, f);
  });
  for_all(mesh.faces(),
          [&](Face f) { is_wrong_[f] = static_cast<char>(is_wrong_[f] | wrong_sides(mesh, f)); });
  wrong_.clear();
  for (const Face f : mesh.faces()) {
    for (int k = 0; k < 3; ++k)
      if ((is_wrong_[f] & 1 << k) != 0) wrong_.push_back(Mesh::side(f, k));
    is_wrong_[f] = 0;
    if (has_changed_[f]) cotangent_[f] = {unknown, unknown, unknown};
  }
}

void DelaunayUpkeep::bound_angles(const Mesh& mesh, Face face) {
  fetch_ahead(mesh.triangles(), mesh.positions(), face);
  cotangent_[face] = cotangent_bounds(mesh.corners(face));
}

// Bit k: side k is the lower one of its edge, which has been judged and is wrong.
char DelaunayUpkeep::wrong_sides(const Mesh& mesh, Face face) const {
  int wrong = 0;
  for (const Side side : Mesh::sides(face)) {
    const Side across = mesh.opposite(side);
    if (across < side) continue;  // the hull is always right
    const float left = cotangent_[face][Mesh::corner_of(side)];
    const float right = cotangent_[Mesh::face_of(across)][Mesh::corner_of(across)];
    if (needs_judgement(left, right) && !is_locally_delaunay(mesh, side)) wrong |= 1 << Mesh::corner_of(side);
  }
  return static_cast<char>(wrong);
}

}  // namespace kinemesh
