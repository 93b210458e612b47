#include "kinemesh/delaunay.h"

#include <algorithm>
#include <array>

#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

// An inverted or flat face beside the edge, the lower one first, or none.
int tangled_face_beside(const Mesh& mesh, int edge) {
  const int h = lower_side(mesh, edge);
  for (const int side : {h, Mesh::opposite(h)}) {
    const int face = mesh.face_of(side);
    if (face != none && !is_upright(mesh, face)) return face;
  }
  return none;
}

bool is_lower(const Mesh& mesh, int halfedge) {
  const int across = mesh.face_of(Mesh::opposite(halfedge));
  return across == none || mesh.face_of(halfedge) < across;
}

// Pre: both faces are upright. If not, the two form a strictly convex quadrilateral, so that a flip leaves
// upright faces: the angles opposite the edge add up to more than two right ones.
bool is_locally_delaunay(const Mesh& mesh, int edge) {
  const int h = 2 * edge, o = Mesh::opposite(h);
  const auto at = [&](int halfedge) { return mesh.position(mesh.to(halfedge)); };
  return in_circle(at(o), at(h), at(mesh.next(h)), at(mesh.next(o))) != Side::Inside;
}

}  // namespace

// It ends. A repair takes at least one inverted or flat face out of the mesh, and neither repairs nor flips
// make new ones: there are finitely many repairs. Between two, lift each vertex (x, y) to x^2 + y^2 and add
// up the volumes under the lifted faces, negative for inverted ones: a flip takes a tetrahedron of positive
// volume off this sum and changes nothing else. So no set of faces comes twice, and there are finitely many.
FlipOutcome DelaunayFlipping::run(Mesh& mesh, const RepairOptions& options) {
  reset(mesh);
  for (int face = mesh.n_faces(); face-- > 0;) {
    const auto sides = mesh.sides(face);
    for (int k = 3; k-- > 0;)
      if (is_lower(mesh, sides[k])) push(4 * face + k);
  }
  return run_pending(mesh, options);
}

FlipOutcome DelaunayFlipping::run(Mesh& mesh, std::span<const int> sides, const RepairOptions& options) {
  for (const int side : sides) {
    if (side < 0 || side >= 4 * mesh.n_faces() || side % 4 == 3)
      throw InputError("there is no side " + std::to_string(side));
  }
  reset(mesh);
  for (auto side = sides.rbegin(); side != sides.rend(); ++side) push(*side);
  return run_pending(mesh, options);
}

FlipOutcome DelaunayFlipping::run_pending(Mesh& mesh, const RepairOptions& options) {
  FlipOutcome outcome;
  while (!pending_.empty() && !outcome.defect) visit(mesh, pop(), options, outcome);
  return outcome;
}

// A side waits, and a face is noted, once at most.
void DelaunayFlipping::reserve(const Mesh& mesh) {
  pending_.reserve(3 * static_cast<std::size_t>(mesh.n_faces()));
  flipped_faces_.reserve(mesh.n_faces());
  if (is_pending_.size() < 4 * static_cast<std::size_t>(mesh.n_faces()))
    is_pending_.resize(4 * static_cast<std::size_t>(mesh.n_faces()), false);
  if (static_cast<int>(is_flipped_.size()) < mesh.n_faces()) is_flipped_.resize(mesh.n_faces(), false);
}

// A defect or an exception may have left sides behind.
void DelaunayFlipping::reset(const Mesh& mesh) {
  while (!pending_.empty()) pop();
  for (const int face : flipped_faces_) is_flipped_[face] = false;
  flipped_faces_.clear();
  reserve(mesh);
}

void DelaunayFlipping::push(int side) {
  if (is_pending_[side]) return;
  pending_.push_back(side);
  is_pending_[side] = true;
}

int DelaunayFlipping::pop() {
  const int side = pending_.back();
  pending_.pop_back();
  is_pending_[side] = false;
  return side;
}

// A side that waits while its face is rewritten is looked at all the same: the new one may be another edge's.
void DelaunayFlipping::visit(Mesh& mesh, int side, const RepairOptions& options, FlipOutcome& outcome) {
  ++outcome.visits;
  const int edge = Mesh::edge_of(halfedge_at(mesh, side));
  const int tangled = tangled_face_beside(mesh, edge);
  if (tangled != none) {
    untangle(mesh, tangled, options, outcome);
  } else if (mesh.is_flippable(edge) && !is_locally_delaunay(mesh, edge)) {
    flip(mesh, edge);
    ++outcome.flips;
  }
}

// The edge at hand is a side of the region's and so looked at again.
void DelaunayFlipping::untangle(Mesh& mesh, int face, const RepairOptions& options, FlipOutcome& outcome) {
  auto repaired = untangler_.repair_seeds(mesh, std::array{face}, options);
  outcome.defect = std::move(repaired.defect);
  for (const auto& region : repaired.record.regions) {
    ++outcome.untangled;
    outcome.replaced += static_cast<int>(region.faces.size());
    for (const int replaced : region.faces)
      for (int k = 0; k < 3; ++k) push(4 * replaced + k);
  }
}

// The four edges around it are looked at again.
void DelaunayFlipping::flip(Mesh& mesh, int edge) {
  mesh.flip(edge);
  const int h = lower_side(mesh, edge);
  for (const int diagonal : {h, Mesh::opposite(h)}) {
    const int side = side_along(mesh, diagonal), face = side >> 2, k = side & 3;
    note_flipped(face);
    push(4 * face + (k + 1) % 3);
    push(4 * face + (k + 2) % 3);
  }
}

void DelaunayFlipping::note_flipped(int face) {
  if (is_flipped_[face]) return;
  flipped_faces_.push_back(face);
  is_flipped_[face] = true;
}

std::vector<int> sides_of(const Mesh& mesh, std::span<const int> faces) {
  std::vector<int> sides;
  for (const int face : faces)
    for (const int h : mesh.sides(face))
      sides.push_back(side_along(mesh, lower_side(mesh, Mesh::edge_of(h))));
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

std::vector<int> edges_of(const Mesh& mesh, std::span<const int> faces) {
  std::vector<int> edges;
  for (const int face : faces) {
    for (const int side : mesh.sides(face)) edges.push_back(Mesh::edge_of(side));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace kinemesh
