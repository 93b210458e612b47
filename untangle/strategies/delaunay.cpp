#include "kinemesh/delaunay.h"

#include <algorithm>
#include <array>

#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

// An inverted or flat face beside the edge, the lower one first, or none.
Face tangled_face_beside(const Mesh& mesh, Side edge) {
  for (const Side side : {edge, mesh.opposite(edge)})
    if (side != none && !is_upright(mesh, Mesh::face_of(side))) return Mesh::face_of(side);
  return none;
}

// Pre: both faces are upright. If not, the two form a strictly convex quadrilateral, so that a flip leaves
// upright faces: the angles opposite the edge add up to more than two right ones.
bool is_locally_delaunay(const Mesh& mesh, Side edge) {
  const auto at = [&](Vertex vertex) { return mesh.position(vertex); };
  return in_circle(at(mesh.from(edge)), at(mesh.to(edge)), at(mesh.apex(edge)),
                   at(mesh.apex(mesh.opposite(edge)))) != InCircle::Inside;
}

}  // namespace

// It ends. A repair takes at least one inverted or flat face out of the mesh, and neither repairs nor flips
// make new ones: there are finitely many repairs. Between two, lift each vertex (x, y) to x^2 + y^2 and add
// up the volumes under the lifted faces, negative for inverted ones: a flip takes a tetrahedron of positive
// volume off this sum and changes nothing else. So no set of faces comes twice, and there are finitely many.
FlipOutcome DelaunayFlipping::run(Mesh& mesh, const RepairOptions& options) {
  reset(mesh);
  for (int face = mesh.n_faces(); face-- > 0;)
    for (int k = 3; k-- > 0;)
      if (const Side side = Mesh::side(Face(face), k); mesh.is_lower(side)) push(side);
  return run_pending(mesh, options);
}

FlipOutcome DelaunayFlipping::run(Mesh& mesh, std::span<const Side> sides, const RepairOptions& options) {
  for (const Side side : sides) {
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
  for (const Face face : flipped_faces_) is_flipped_[face] = false;
  flipped_faces_.clear();
  reserve(mesh);
}

void DelaunayFlipping::push(Side side) {
  if (is_pending_[side]) return;
  pending_.push_back(side);
  is_pending_[side] = true;
}

Side DelaunayFlipping::pop() {
  const Side side = pending_.back();
  pending_.pop_back();
  is_pending_[side] = false;
  return side;
}

// A side that waits while its face is rewritten is looked at all the same: the new one may be another edge's.
void DelaunayFlipping::visit(Mesh& mesh, Side side, const RepairOptions& options, FlipOutcome& outcome) {
  ++outcome.visits;
  const Side edge = mesh.lower(side);
  const Face tangled = tangled_face_beside(mesh, edge);
  if (tangled != none) {
    untangle(mesh, tangled, options, outcome);
  } else if (mesh.is_flippable(edge) && !is_locally_delaunay(mesh, edge)) {
    flip(mesh, edge);
    ++outcome.flips;
  }
}

// The edge at hand is a side of the region's and so looked at again.
void DelaunayFlipping::untangle(Mesh& mesh, Face face, const RepairOptions& options, FlipOutcome& outcome) {
  auto repaired = untangler_.repair_seeds(mesh, std::array{face}, options);
  outcome.defect = std::move(repaired.defect);
  for (const auto& region : repaired.record.regions) {
    ++outcome.untangled;
    outcome.replaced += static_cast<int>(region.faces.size());
    for (const Face replaced : region.faces)
      for (const Side its : Mesh::sides(replaced)) push(its);
  }
}

// The four edges around it are looked at again.
void DelaunayFlipping::flip(Mesh& mesh, Side edge) {
  const Side turned = mesh.flip(edge);
  for (const Side side : {turned, mesh.opposite(turned)}) {
    note_flipped(Mesh::face_of(side));
    push(Mesh::next(side));
    push(Mesh::prev(side));
  }
}

void DelaunayFlipping::note_flipped(Face face) {
  if (is_flipped_[face]) return;
  flipped_faces_.push_back(face);
  is_flipped_[face] = true;
}

std::vector<Side> sides_of(const Mesh& mesh, std::span<const Face> faces) {
  std::vector<Side> sides;
  for (const Face face : faces)
    for (const Side side : Mesh::sides(face)) sides.push_back(mesh.lower(side));
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

}  // namespace kinemesh
