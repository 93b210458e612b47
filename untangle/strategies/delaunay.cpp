#include "kinemesh/delaunay.h"

#include <algorithm>
#include <array>

#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

// An inverted or flat face beside the edge, or none.
int tangled_face_beside(const Mesh& mesh, int edge) {
  for (const int side : {2 * edge, 2 * edge + 1}) {
    const int face = mesh.face_of(side);
    if (face != none && !is_upright(mesh, face)) return face;
  }
  return none;
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
  for (int edge = mesh.n_edges(); edge-- > 0;) push(edge);
  return run_pending(mesh, options);
}

FlipOutcome DelaunayFlipping::run(Mesh& mesh, std::span<const int> edges, const RepairOptions& options) {
  for (const int edge : edges) {
    if (edge < 0 || edge >= mesh.n_edges()) throw InputError("there is no edge " + std::to_string(edge));
  }
  reset(mesh);
  for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) push(*edge);
  return run_pending(mesh, options);
}

FlipOutcome DelaunayFlipping::run_pending(Mesh& mesh, const RepairOptions& options) {
  FlipOutcome outcome;
  while (!pending_.empty() && !outcome.defect) visit(mesh, pop(), options, outcome);
  return outcome;
}

// An edge waits, and a face is noted, once at most.
void DelaunayFlipping::reserve(const Mesh& mesh) {
  pending_.reserve(mesh.n_edges());
  flipped_faces_.reserve(mesh.n_faces());
  if (static_cast<int>(is_pending_.size()) < mesh.n_edges()) is_pending_.resize(mesh.n_edges(), false);
  if (static_cast<int>(is_flipped_.size()) < mesh.n_faces()) is_flipped_.resize(mesh.n_faces(), false);
}

// A defect or an exception may have left edges behind.
void DelaunayFlipping::reset(const Mesh& mesh) {
  while (!pending_.empty()) pop();
  for (const int face : flipped_faces_) is_flipped_[face] = false;
  flipped_faces_.clear();
  reserve(mesh);
}

void DelaunayFlipping::push(int edge) {
  if (is_pending_[edge]) return;
  pending_.push_back(edge);
  is_pending_[edge] = true;
}

int DelaunayFlipping::pop() {
  const int edge = pending_.back();
  pending_.pop_back();
  is_pending_[edge] = false;
  return edge;
}

void DelaunayFlipping::visit(Mesh& mesh, int edge, const RepairOptions& options, FlipOutcome& outcome) {
  ++outcome.visits;
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
    for (const int replaced : region.faces) {
      for (const int side : mesh.sides(replaced)) push(Mesh::edge_of(side));
    }
  }
}

void DelaunayFlipping::flip(Mesh& mesh, int edge) {
  mesh.flip(edge);
  for (const int h : {2 * edge, 2 * edge + 1}) {
    note_flipped(mesh.face_of(h));
    push(Mesh::edge_of(mesh.next(h)));
    push(Mesh::edge_of(mesh.prev(h)));
  }
}

void DelaunayFlipping::note_flipped(int face) {
  if (is_flipped_[face]) return;
  flipped_faces_.push_back(face);
  is_flipped_[face] = true;
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
