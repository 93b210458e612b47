// What surrounds a vertex or lies beside an edge, as moving and flipping ask for it.
#pragma once

#include <algorithm>

#include "kinemesh/mesh.h"
#include "kinemesh/predicates.h"

namespace kinemesh {

inline bool is_upright(const Mesh& mesh, Face face) {
  const auto [a, b, c] = mesh.corners(face);
  return orientation(a, b, c) == Orientation::CounterClockwise;
}

// A vertex that may be placed anew: the user's, not fixed, on no constrained edge.
inline bool is_movable(const Mesh& mesh, Vertex v) {
  return mesh.user_vertex(v) != none && !mesh.is_isolated(v) && !mesh.is_constrained(v) && !mesh.is_fixed(v);
}

// Where a fan starts does not depend on what was replaced before: the side that leaves a vertex along the
// hull, or, inside, that of the lowest of its faces. Pre: not isolated.
inline Side start_of_fan(const Mesh& mesh, Vertex vertex) {
  const Side some = mesh.side_from(vertex);
  Side start = some;
  for (Side side = some;;) {
    const Side across = mesh.opposite(side);
    if (across == none) return side;
    side = Mesh::next(across);
    if (side == some) return start;
    start = std::min(start, side);
  }
}

// Calls visit(side) for the sides that start where one does, each of another face, counter-clockwise while
// these are upright; up to the hull.
template <class Visit>
void for_each_side_after(const Mesh& mesh, Side first, const Visit& visit) {
  Side side = first;
  do {
    visit(side);
    side = mesh.opposite(Mesh::prev(side));
  } while (side != first && side != none);
}

// Likewise for all that start at a vertex, from start_of_fan on.
template <class Visit>
void for_each_side_from(const Mesh& mesh, Vertex vertex, const Visit& visit) {
  if (!mesh.is_isolated(vertex)) for_each_side_after(mesh, start_of_fan(mesh, vertex), visit);
}

// Calls visit(neighbour, side) for each edge at a vertex, with its side that starts there; counter-clockwise,
// as above. On the hull the first is the edge that has no such side, with the one that ends there.
template <class Visit>
void for_each_neighbour(const Mesh& mesh, Vertex vertex, const Visit& visit) {
  if (mesh.is_isolated(vertex)) return;
  const Side first = start_of_fan(mesh, vertex);
  if (mesh.opposite(first) == none) {
    Side last;
    for_each_side_after(mesh, first, [&](Side side) { last = Mesh::prev(side); });
    visit(mesh.from(last), last);
  }
  for_each_side_after(mesh, first, [&](Side side) { visit(mesh.to(side), side); });
}

// The edges at a vertex, one after the other, in an order that may be any.
class Spokes {
 public:
  Spokes(const Mesh& mesh, Vertex vertex) : mesh_(mesh), first_(mesh.side_from(vertex)), side_(first_) {}

  bool is_done() const { return side_ == none; }
  Side side() const { return side_; }  // one of the edge
  Vertex end() const { return is_ending_ ? mesh_.from(side_) : mesh_.to(side_); }

  // Counter-clockwise; where that comes to the hull, to its edge, which no side starts along, and clockwise
  // from the first.
  void advance() {
    if (is_ending_ || is_back_) return turn_back();
    const Side before = Mesh::prev(side_), next = mesh_.opposite(before);
    is_ending_ = next == none;
    side_ = is_ending_ ? before : next == first_ ? none : next;
  }

 private:
  void turn_back() {
    const Side across = mesh_.opposite(is_back_ ? side_ : first_);
    is_back_ = true;
    is_ending_ = false;
    side_ = across == none ? none : Mesh::next(across);
  }

  const Mesh& mesh_;
  Side first_, side_;
  bool is_ending_ = false;  // the side at hand ends at the vertex
  bool is_back_ = false;
};

// Whether an edge joins the two. Looks around both in turn, so that one with many neighbours costs no more
// than the other.
inline bool are_joined(const Mesh& mesh, Vertex v, Vertex w) {
  for (Spokes at_v(mesh, v), at_w(mesh, w); !at_v.is_done() && !at_w.is_done();
       at_v.advance(), at_w.advance())
    if (at_v.end() == w || at_w.end() == v) return true;
  return false;
}

}  // namespace kinemesh
