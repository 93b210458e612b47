#include "tests/untangle/explore/sheets.h"
#include "tests/core/mesh/edges.h"

#include <algorithm>

#include "kinemesh/predicates.h"

namespace kinemesh::test {
namespace {

Orientation turn(const Mesh& mesh, Face face) {
  const auto [a, b, c] = mesh.corners(face);
  return orientation(a, b, c);
}

bool is_smaller(const Point& a, const Point& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

bool is_side(const Mesh& mesh, Face face, Side edge) {
  return std::ranges::any_of(mesh.sides(face), [&](Side side) { return mesh.lower(side) == edge; });
}

}  // namespace

Sheets::Sheets(const Mesh& mesh, Subdivision plane) : mesh_(mesh), plane_(std::move(plane)) {
  for (const Face face : mesh.faces()) {
    inverted_.push_back(turn(mesh, face) == Orientation::Clockwise);
  }
  find_components();
  segments_of_edge_.resize(4 * static_cast<std::size_t>(mesh.n_faces()));
  segments_of_cell_.resize(plane_.n_cells);
  for (int s = 0; s < static_cast<int>(plane_.segments.size()); ++s) {
    const auto& segment = plane_.segments[s];
    segments_of_edge_[segment.edges.front()].push_back(s);
    segments_of_cell_[segment.left].push_back(s);
    segments_of_cell_[segment.right].push_back(s);
  }
  of_face_.resize(mesh.n_faces());
  of_cell_.resize(plane_.n_cells);
  seen_.assign(plane_.n_cells, none);
  for (const Face face : mesh.faces()) cover(face);
  for (const Lift& lift : lifts_) {
    auto& steps = steps_.emplace_back();
    for (const int segment : segments_of_cell_[lift.cell]) steps.push_back(step(lift, segment));
  }
}

bool Sheets::is_crease(Side edge) const {
  const Face across = mesh_.face_across(edge);
  return across != none && inverted_[Mesh::face_of(edge)] != inverted_[across];
}

void Sheets::find_components() {
  component_.assign(mesh_.n_faces(), none);
  for (const Face seed : mesh_.faces()) {
    if (!inverted_[seed] || component_[seed] != none) continue;
    std::vector<Face> pending{seed};
    component_[seed] = n_components_;
    while (!pending.empty()) {
      const Face face = pending.back();
      pending.pop_back();
      for (const Side side : mesh_.sides(face)) {
        const Face beyond = mesh_.face_across(side);
        if (beyond == none || !inverted_[beyond] || component_[beyond] != none) continue;
        component_[beyond] = n_components_;
        pending.push_back(beyond);
      }
    }
    ++n_components_;
  }
}

// The cells of the face's shadow: from its sides inwards, never across a side.
void Sheets::cover(Face face) {
  auto pending = first_cells(face);
  std::vector<int> cells;
  while (!pending.empty()) {
    const int cell = pending.back();
    pending.pop_back();
    if (seen_[cell] == face) continue;
    seen_[cell] = face;
    cells.push_back(cell);
    for (const int s : segments_of_cell_[cell]) {
      const auto& segment = plane_.segments[s];
      if (!is_side(mesh_, face, segment.edges.front())) {
        pending.push_back(segment.left == cell ? segment.right : segment.left);
      }
    }
  }
  std::ranges::sort(cells);
  for (const int cell : cells) {
    of_face_[face].push_back(n_lifts());
    of_cell_[cell].push_back(n_lifts());
    lifts_.push_back({face, cell});
  }
}

std::vector<int> Sheets::first_cells(Face face) const {
  std::vector<int> cells;
  for (const Side side : mesh_.sides(face)) {
    for (const int s : segments_of_edge_[mesh_.lower(side)]) {
      cells.push_back(inner_cell(plane_.segments[s], side));
    }
  }
  return cells;
}

// Where the side's face lies: in the plane to the left if that is upright, to the right if inverted.
int Sheets::inner_cell(const Subdivision::Segment& segment, Side side) const {
  const bool forward = is_smaller(mesh_.position(mesh_.from(side)), mesh_.position(mesh_.to(side)));
  return forward != inverted_[Mesh::face_of(side)] ? segment.left : segment.right;
}

int Sheets::lift_at(Face face, int cell) const {
  const auto& own = of_face_[face];
  return *std::ranges::lower_bound(own, cell, {}, [&](int i) { return lifts_[i].cell; });
}

Sheets::Step Sheets::step(const Lift& from, int s) const {
  const auto& segment = plane_.segments[s];
  const Side edge = segment.edges.front();
  const int across = segment.left == from.cell ? segment.right : segment.left;
  if (!is_side(mesh_, from.face, edge)) return {lift_at(from.face, across), s, none};
  const Face f = Mesh::face_of(edge), g = mesh_.face_across(edge);
  const Face beyond = f == from.face ? g : f;
  if (beyond == none) return {none, s, edge};
  return {lift_at(beyond, is_crease(edge) ? from.cell : across), s, edge};
}

bool is_general(const Mesh& mesh, const Subdivision& plane) {
  for (const Face face : mesh.faces()) {
    if (turn(mesh, face) == Orientation::Collinear) return false;
  }
  std::vector<int> degree(plane.n_vertices, 0), expected(plane.n_vertices, 0);
  for (const auto& segment : plane.segments) {
    if (segment.edges.size() != 1) return false;
    for (const int end : segment.ends) ++degree[end];
  }
  std::vector<int> valence(mesh.n_vertices(), 0);
  for (const Side edge : all_edges(mesh))
    for (const Vertex v : {mesh.from(edge), mesh.to(edge)}) ++valence[v];
  for (const Vertex v : mesh.vertices()) {
    const int place = plane.place_of[v];
    if (place == none) continue;
    if (expected[place] != 0) return false;
    expected[place] = valence[v];
  }
  // Where two edges cross four segments meet.
  for (int place = 0; place < plane.n_vertices; ++place) {
    if (degree[place] != (expected[place] == 0 ? 4 : expected[place])) return false;
  }
  return true;
}

}  // namespace kinemesh::test
