#include "untangle/fill/small_region_mesher.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/base/box.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

// Of a side, around its face.
constexpr int following(int side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

constexpr int preceding(int side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

bool is_left(const Point& a, const Point& b, const Point& p) {
  return orientation(a, b, p) == Orientation::CounterClockwise;
}

}  // namespace

bool SmallRegionMesher::run(const Mesh& mesh, const Hole& hole) {
  if (!collect(mesh, hole) || !trace_border() || !is_border_simple() || !is_counter_clockwise()) return false;
  clip_ears();
  if (!insert_inner_vertices()) return false;
  flip_to_delaunay();
  convert();
  return true;
}

// --- the polygon ---

// False for what is not of this mesher's kind.
bool SmallRegionMesher::collect(const Mesh& mesh, const Hole& hole) {
  n_faces_ = hole.size();
  if (n_faces_ > max_faces || !hole.inner_constraints.empty()) return false;
  number_vertices(mesh, hole);
  if (n_vertices_ > max_vertices) return false;
  std::fill_n(side_from_.begin(), n_vertices_, Side());
  for (const auto& side : hole.border) {
    const int from = local(side.from);
    if (side_from_[from] != none) return false;  // a pinch
    side_from_[from] = side.side;
    border_next_[from] = local(side.to);
  }
  return true;
}

void SmallRegionMesher::number_vertices(const Mesh& mesh, const Hole& hole) {
  std::array<Vertex, 3 * max_faces> corners;
  auto end = corners.begin();
  constexpr int n_recent = 64;
  std::array<Vertex, n_recent> recent;  // most that come again are here
  recent.fill(none);
  for (const Face face : hole.faces) {
    for (const Vertex v : mesh.triangles()[face]) {
      if (std::exchange(recent[v % n_recent], v) != v) *end++ = v;
    }
  }
  std::sort(corners.begin(), end);
  end = std::unique(corners.begin(), end);
  n_vertices_ = static_cast<int>(end - corners.begin());
  if (n_vertices_ > max_vertices) return;
  std::copy(corners.begin(), end, vertices_.begin());
  for (int v = 0; v < n_vertices_; ++v) points_[v] = mesh.position(vertices_[v]);
}

int SmallRegionMesher::local(Vertex vertex) const {
  const auto end = vertices_.begin() + n_vertices_;
  return static_cast<int>(std::lower_bound(vertices_.begin(), end, vertex) - vertices_.begin());
}

// False unless the border is one loop around a disc.
bool SmallRegionMesher::trace_border() {
  const auto is_on_border = [](Side side) { return side != none; };
  const auto end = side_from_.begin() + n_vertices_;
  const auto n_border = static_cast<int>(std::count_if(side_from_.begin(), end, is_on_border));
  if (n_border + 2 * (n_vertices_ - n_border) - 2 != n_faces_) return false;
  const int first =
      static_cast<int>(std::find_if(side_from_.begin(), end, is_on_border) - side_from_.begin());
  loop_.clear();
  int v = first;
  do {
    loop_.push_back({v, ~v, Orientation::Collinear});
    v = border_next_[v];
  } while (v != first && static_cast<int>(loop_.size()) < n_border);
  if (v != first || static_cast<int>(loop_.size()) != n_border) return false;
  for (std::size_t i = 0; i < loop_.size(); ++i) find_turn(i);
  return true;
}

bool SmallRegionMesher::is_border_simple() const {
  const std::size_t n = loop_.size();
  // Neighbours not on one line meet at their common end only.
  const auto is_bend = [&](std::size_t i, std::size_t j) {
    return (after(j) == i && loop_[i].turn != Orientation::Collinear) ||
           (after(i) == j && loop_[j].turn != Orientation::Collinear);
  };
  std::array<Segment, max_vertices> edges;
  std::array<Box, max_vertices> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const int from = loop_[i].vertex, to = loop_[after(i)].vertex;
    edges[i] = {points_[from], points_[to], from, to};
    boxes[i] = box_of(points_[from], points_[to]);
    for (std::size_t j = 0; j < i; ++j) {
      if (meet(boxes[i], boxes[j]) && !is_bend(i, j) && segments_touch(edges[i], edges[j])) return false;
    }
  }
  return true;
}

// A simple polygon turns at its lowest vertex the way it goes around.
bool SmallRegionMesher::is_counter_clockwise() const {
  const auto is_lower = [&](const Tip& s, const Tip& t) {
    const Point &p = points_[s.vertex], &q = points_[t.vertex];
    return std::pair(p.x, p.y) < std::pair(q.x, q.y);
  };
  return std::ranges::min_element(loop_, is_lower)->turn == Orientation::CounterClockwise;
}

// --- a triangulation of it ---

// Every triangulation of what is left has two ears, the last leaves of its dual tree.
void SmallRegionMesher::clip_ears() {
  n_new_ = 0;
  for (std::size_t i = 0, refused = 0; loop_.size() > 3;) {
    if (refused == loop_.size()) throw std::logic_error("a simple polygon has no ear");
    if (i >= loop_.size()) i -= loop_.size();
    if (is_ear(i)) {
      clip(i);
      refused = 0;
    } else {
      ++i;
      ++refused;
    }
  }
  add({loop_[0].vertex, loop_[1].vertex, loop_[2].vertex},
      {loop_[0].across, loop_[1].across, loop_[2].across});
}

// What reaches into it has, where it reaches farthest, a vertex that does not turn left.
bool SmallRegionMesher::is_ear(std::size_t i) const {
  const Tip &first = loop_[before(i)], &tip = loop_[i], &last = loop_[after(i)];
  if (tip.turn != Orientation::CounterClockwise) return false;
  const Point &a = points_[first.vertex], &b = points_[tip.vertex], &c = points_[last.vertex];
  return std::ranges::none_of(loop_, [&](const Tip& other) {
    if (other.turn == Orientation::CounterClockwise) return false;
    if (other.vertex == first.vertex || other.vertex == last.vertex) return false;
    const Point& p = points_[other.vertex];
    return !is_left(b, a, p) && !is_left(c, b, p) && !is_left(a, c, p);
  });
}

// The face goes from the vertex before over the tip to the one after; its third side takes the place of two.
void SmallRegionMesher::clip(std::size_t i) {
  Tip& first = loop_[before(i)];
  const Tip &tip = loop_[i], &last = loop_[after(i)];
  const int face = add({first.vertex, tip.vertex, last.vertex}, {first.across, tip.across, none});
  first.across = 3 * face + 2;
  loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(i));
  if (i == loop_.size()) i = 0;
  find_turn(before(i));
  find_turn(i);
}

void SmallRegionMesher::find_turn(std::size_t i) {
  loop_[i].turn = orientation(points_[loop_[before(i)].vertex], points_[loop_[i].vertex],
                              points_[loop_[after(i)].vertex]);
}

// --- the vertices inside ---

bool SmallRegionMesher::insert_inner_vertices() {
  for (int v = 0; v < n_vertices_; ++v) {
    if (side_from_[v] == none && !insert(v)) return false;
  }
  return true;
}

// False if no face has it inside or on a side that may be split.
bool SmallRegionMesher::insert(int vertex) {
  const Point& p = points_[vertex];
  int face = walk_towards(p);
  for (int next = 0; face == none && next < n_new_; ++next) {
    if (side_away_from(p, next) == none) face = next;
  }
  if (face == none) return false;
  const auto is_on = [&](int side) {
    return orientation(points_[start_[side]], points_[start_[following(side)]], p) == Orientation::Collinear;
  };
  const std::array<int, 3> sides{3 * face, 3 * face + 1, 3 * face + 2};
  const auto n_on = std::ranges::count_if(sides, is_on);
  if (n_on > 1) return false;  // at a corner
  if (n_on == 1) return split_side(*std::ranges::find_if(sides, is_on), vertex);
  split_face(face, vertex);
  return true;
}

// The face that has the point, or none where the walk from the newest one comes to the border.
int SmallRegionMesher::walk_towards(const Point& p) const {
  int face = n_new_ - 1;
  for (int steps = 0; steps < n_new_; ++steps) {
    const int side = side_away_from(p, face);
    if (side == none) return face;
    if (across_[side] < 0) return none;
    face = across_[side] / 3;
  }
  return none;
}

// A side of the face beyond which the point lies, or none.
int SmallRegionMesher::side_away_from(const Point& p, int face) const {
  for (int side = 3 * face; side < 3 * face + 3; ++side) {
    if (is_left(points_[start_[following(side)]], points_[start_[side]], p)) return side;
  }
  return none;
}

void SmallRegionMesher::split_face(int face, int vertex) {
  const int side = 3 * face, a = start_[side], b = start_[side + 1], c = start_[side + 2];
  const int bc = across_[side + 1], ca = across_[side + 2];
  set(face, {a, b, vertex}, {across_[side], none, none});
  const int second = add({b, c, vertex}, {bc, none, side + 1});
  add({c, a, vertex}, {ca, side + 2, 3 * second + 1});
}

// Both faces beside it become two; false on the border.
bool SmallRegionMesher::split_side(int side, int vertex) {
  const int back = across_[side];
  if (back < 0) return false;
  const int face = side / 3, other = back / 3;
  const int a = start_[side], b = start_[back];
  const int apex = start_[preceding(side)], far = start_[preceding(back)];
  const int b_apex = across_[following(side)], apex_a = across_[preceding(side)];
  const int a_far = across_[following(back)], far_b = across_[preceding(back)];
  set(face, {vertex, b, apex}, {none, b_apex, none});
  set(other, {b, vertex, far}, {3 * face, none, far_b});
  const int left = add({a, vertex, apex}, {none, 3 * face + 2, apex_a});
  add({vertex, a, far}, {3 * left, a_far, 3 * other + 1});
  return true;
}

// --- the Delaunay one ---

// Each edge is looked at once, and again when a face beside it has become another [Lawson 1977].
void SmallRegionMesher::flip_to_delaunay() {
  suspects_.clear();  // an exception may have left some behind
  for (int side = 0; side < 3 * n_new_; ++side) {
    if (across_[side] > side) suspects_.push_back(side);
  }
  while (!suspects_.empty()) {
    const int side = suspects_.back();
    suspects_.pop_back();
    flip_if_better(side);
  }
}

//      c             c
//    /   \         / | \       .
//   a --> b  ->   a  |  b
//    \   /         \ | /
//      d             d
void SmallRegionMesher::flip_if_better(int side) {
  const int back = across_[side];
  if (back < 0) return;
  const int a = start_[side], b = start_[back];
  const int c = start_[preceding(side)], d = start_[preceding(back)];
  if (in_circle(points_[a], points_[b], points_[c], points_[d]) != InCircle::Inside) return;
  const int bc = across_[following(side)], ca = across_[preceding(side)];
  const int ad = across_[following(back)], db = across_[preceding(back)];
  const int face = side / 3, other = back / 3;
  set(face, {a, d, c}, {ad, none, ca});
  set(other, {d, b, c}, {db, bc, 3 * face + 1});
  suspects_.insert(suspects_.end(), {3 * face, 3 * face + 2, 3 * other, 3 * other + 1});
}

// --- faces and their neighbours ---

// Across a side whose neighbour is yet to come: none.
int SmallRegionMesher::add(const Triangle& corners, const Triangle& across) {
  set(n_new_, corners, across);
  return n_new_++;
}

void SmallRegionMesher::set(int face, const Triangle& corners, const Triangle& across) {
  for (int k = 0; k < 3; ++k) {
    const int side = 3 * face + k;
    start_[side] = corners[k];
    across_[side] = across[k];
    if (across[k] >= 0) across_[across[k]] = side;
  }
}

void SmallRegionMesher::convert() {
  new_faces_.clear();
  for (int face = 0; face < n_new_; ++face) {
    MeshTriangle corners;
    Triangle neighbours;
    for (int k = 0; k < 3; ++k) {
      const int across = across_[3 * face + k];
      corners[k] = vertices_[start_[3 * face + k]];
      neighbours[k] = across >= 0 ? across / 3 : ~side_from_[~across];
    }
    new_faces_.add(corners, neighbours, {none, none, none});
  }
}

}  // namespace kinemesh
