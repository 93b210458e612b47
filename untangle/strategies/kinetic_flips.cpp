#include "untangle/strategies/kinetic_flips.h"

#include <algorithm>
#include <tuple>

#include "core/base/ascending.h"
#include "core/base/parallel.h"
#include "core/mesh/around.h"
#include "core/sweep/face_sweep.h"
#include "untangle/walk/detect.h"

namespace kinemesh {
namespace {

bool may_collapse(const MeshTriangle& t, const Point* x0, const Point* x1) {
  const auto [a, b, c] = t;
  if (x0[a] == x1[a] && x0[b] == x1[b] && x0[c] == x1[c]) return false;
  return !is_surely_positive(rounded_product(x0[b] - x0[a], x1[b] - x1[a], x0[c] - x0[a], x1[c] - x1[a]));
}

// Ascending.
std::vector<Face> faces_that_may_collapse(const Mesh& mesh, std::span<const Point> before) {
  const auto triangles = mesh.triangles();
  std::vector<std::vector<Face>> found(n_parts(mesh.n_faces(), grain::items));
  parallel_parts(mesh.n_faces(), grain::items, [&](int part, int begin, int end) {
    for (Face f(begin); f < end; ++f) {
      fetch_ahead(triangles, before, f);
      fetch_ahead(triangles, mesh.positions(), f);
      if (may_collapse(triangles[f], before.data(), mesh.positions().data())) found[part].push_back(f);
    }
  });
  std::vector<Face> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Around an edge: from a to b, c to the left and d to the right.
struct Quadrilateral {
  Vertex a, b, c, d;
};

Quadrilateral around(const Mesh& mesh, Side edge) {
  return {mesh.from(edge), mesh.to(edge), mesh.apex(edge), mesh.apex(mesh.opposite(edge))};
}

// While something is tangled an edge may be there already.
bool can_be_flipped(const Mesh& mesh, Side edge) {
  if (!mesh.is_flippable(edge)) return false;
  const auto q = around(mesh, edge);
  return q.c != q.d && !are_joined(mesh, q.c, q.d);
}

}  // namespace

bool KineticFlips::Later::operator()(const Event& e, const Event& f) const {
  const int order = compare(e.when, f.when);
  return order != 0 ? order > 0 : e.face > f.face;
}

KineticFlips::KineticFlips(Undo& undo, std::span<const Point> before)
    : undo_(undo), mesh_(undo.mesh()), before_(before) {}

bool KineticFlips::run() {
  follow();
  return finish();
}

void KineticFlips::follow() {
  for (const Face face : faces_that_may_collapse(mesh_, before_)) schedule(face, nullptr);
  while (!events_.empty()) {
    const Event event = events_.top();
    events_.pop();
    if (mesh_.triangles()[event.face] == event.corners) handle(event);
  }
}

bool KineticFlips::finish() {
  const auto tangles = detect(mesh_);
  if (tangles.empty()) return true;
  start_instant(CollapseTime::end());
  is_at_end_ = true;
  doubtful_ = tangles.flat;
  doubtful_.insert(doubtful_.end(), tangles.inverted.begin(), tangles.inverted.end());
  settle();
  return false;
}

void KineticFlips::handle(const Event& event) {
  ++counts_.events;
  if (compare(event.when, now_) != 0) start_instant(event.when);
  if (!improve(event.face)) ++counts_.stuck;
  settle();
}

void KineticFlips::start_instant(const CollapseTime& time) {
  now_ = time;
  gone_.clear();
}

void KineticFlips::schedule(Face face, const CollapseTime* from) {
  const auto& corners = mesh_.triangles()[face];
  if (auto time = area(corners).collapse_after(from)) events_.push({std::move(*time), face, corners});
}

// Faces that are in need of a flip, until there is none that helps.
void KineticFlips::settle() {
  while (!doubtful_.empty()) {
    const Face face = doubtful_.back();
    doubtful_.pop_back();
    if (!is_upright(mesh_.triangles()[face])) improve(face);
  }
}

bool KineticFlips::improve(Face face) {
  for (const Side side : Mesh::sides(face)) {
    if (!leaves_upright_faces(side)) continue;
    flip(side);
    return true;
  }
  return flip_on_line(face) || flip_beside_meeting(face);
}

bool KineticFlips::leaves_upright_faces(Side edge) const {
  if (!mesh_.is_flippable(edge)) return false;
  const auto [a, b, c, d] = around(mesh_, edge);
  return is_upright({d, b, c}) && is_upright({c, a, d}) && can_be_flipped(mesh_, edge);
}

bool KineticFlips::flip_on_line(Face face) {
  const MeshTriangle corners = mesh_.triangles()[face];
  if (!is_flat(corners)) return false;
  const int inner = inner_corner(corners);
  if (inner == none) return false;
  const Side longest = Mesh::side(face, (inner + 1) % 3);
  if (!can_be_flipped(mesh_, longest)) return false;
  const auto [a, b, c, d] = around(mesh_, longest);
  if (!is_flat({a, b, c}) || !is_flat({b, a, d}) || !gone_.insert(ascending(MeshEdge{a, b})).second)
    return false;
  flip(longest);
  return true;
}

// Of a face whose corners u and v have met: turns one of them around the other by one edge, so that the face
// between them is another one.
bool KineticFlips::flip_beside_meeting(Face face) {
  const MeshTriangle corners = mesh_.triangles()[face];
  const Sides sides = Mesh::sides(face);
  for (int k = 0; k < 3; ++k) {
    const Vertex u = corners[k], v = corners[(k + 1) % 3];
    if (!have_met(u, v)) continue;
    for (const Side side : {sides[(k + 1) % 3], sides[(k + 2) % 3]}) {
      if (!can_be_flipped(mesh_, side)) continue;
      const auto [a, b, c, d] = around(mesh_, side);
      const bool starts_there = a == u || a == v;
      if (!is_upright(starts_there ? MeshTriangle{d, b, c} : MeshTriangle{c, a, d})) continue;
      if (!gone_.insert(ascending(MeshEdge{a, b})).second) continue;
      flip(side);
      return true;
    }
  }
  return false;
}

void KineticFlips::flip(Side edge) {
  const auto [low, high] = std::minmax({Mesh::face_of(edge), mesh_.face_across(edge)});
  undo_.flip(edge);
  ++counts_.flips;
  for (const Face face : {low, high}) {
    if (!is_at_end_) schedule(face, &now_);
    doubtful_.push_back(face);
    for (const Side side : Mesh::sides(face)) {
      const Face across = mesh_.face_across(side);
      if (across != none) doubtful_.push_back(across);
    }
  }
}

KineticQuadratic KineticFlips::area(const MeshTriangle& corners) const {
  return KineticQuadratic::area(moving(corners[0]), moving(corners[1]), moving(corners[2]));
}

bool KineticFlips::is_upright(const MeshTriangle& corners) const {
  const auto a = area(corners);
  return (is_at_end_ ? a.sign_at(now_) : a.sign_after(now_)) > 0;
}

bool KineticFlips::is_flat(const MeshTriangle& corners) const {
  return area(corners).sign_at(now_) == 0;
}

bool KineticFlips::have_met(Vertex u, Vertex v) const {
  return KineticQuadratic::dot(moving(u), moving(v), moving(v)).sign_at(now_) == 0;
}

// Which of three corners on a line lies between the others; none if two are at one place.
int KineticFlips::inner_corner(const MeshTriangle& t) const {
  for (int k = 0; k < 3; ++k) {
    const auto dot = KineticQuadratic::dot(moving(t[k]), moving(t[(k + 1) % 3]), moving(t[(k + 2) % 3]));
    if (dot.sign_at(now_) < 0) return k;
  }
  return none;
}

}  // namespace kinemesh
