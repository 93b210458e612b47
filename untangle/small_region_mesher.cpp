#include "untangle/small_region_mesher.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/predicates.h"

namespace kinemesh {
namespace {

constexpr int following(int k) {
  return k == 2 ? 0 : k + 1;
}

constexpr int preceding(int k) {
  return k == 0 ? 2 : k - 1;
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
  std::fill_n(halfedge_from_.begin(), n_vertices_, none);
  for (const auto& side : hole.border) {
    const int from = local(side.from);
    if (halfedge_from_[from] != none) return false;  // a pinch
    halfedge_from_[from] = side.halfedge;
    border_next_[from] = local(side.to);
  }
  return true;
}

void SmallRegionMesher::number_vertices(const Mesh& mesh, const Hole& hole) {
  std::array<int, 3 * max_faces> corners;
  auto end = corners.begin();
  for (const int face : hole.faces) end = std::ranges::copy(mesh.triangles()[face], end).out;
  std::sort(corners.begin(), end);
  end = std::unique(corners.begin(), end);
  n_vertices_ = static_cast<int>(end - corners.begin());
  if (n_vertices_ > max_vertices) return;
  std::copy(corners.begin(), end, vertices_.begin());
  for (int v = 0; v < n_vertices_; ++v) points_[v] = mesh.position(vertices_[v]);
}

int SmallRegionMesher::local(int vertex) const {
  const auto end = vertices_.begin() + n_vertices_;
  return static_cast<int>(std::lower_bound(vertices_.begin(), end, vertex) - vertices_.begin());
}

// False unless the border is one loop around a disc.
bool SmallRegionMesher::trace_border() {
  const auto is_on_border = [](int halfedge) { return halfedge != none; };
  const auto end = halfedge_from_.begin() + n_vertices_;
  const auto n_border = static_cast<int>(std::count_if(halfedge_from_.begin(), end, is_on_border));
  if (n_border + 2 * (n_vertices_ - n_border) - 2 != n_faces_) return false;
  const int first =
      static_cast<int>(std::find_if(halfedge_from_.begin(), end, is_on_border) - halfedge_from_.begin());
  loop_.clear();
  int v = first;
  do {
    loop_.push_back(v);
    v = border_next_[v];
  } while (v != first && static_cast<int>(loop_.size()) < n_border);
  return v == first && static_cast<int>(loop_.size()) == n_border;
}

bool SmallRegionMesher::is_border_simple() const {
  const auto edge_from = [&](int v) {
    return Segment{points_[v], points_[border_next_[v]], v, border_next_[v]};
  };
  for (std::size_t i = 0; i < loop_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (segments_touch(edge_from(loop_[i]), edge_from(loop_[j]))) return false;
    }
  }
  return true;
}

// A simple polygon turns at its lowest vertex the way it goes around.
bool SmallRegionMesher::is_counter_clockwise() const {
  const auto is_lower = [&](int v, int w) {
    return std::pair(points_[v].x, points_[v].y) < std::pair(points_[w].x, points_[w].y);
  };
  const auto lowest = static_cast<std::size_t>(std::ranges::min_element(loop_, is_lower) - loop_.begin());
  const int before = loop_[(lowest + loop_.size() - 1) % loop_.size()];
  const int after = loop_[(lowest + 1) % loop_.size()];
  return is_left(points_[before], points_[loop_[lowest]], points_[after]);
}

// --- a triangulation of it ---

// Every triangulation of what is left has two ears, the last leaves of its dual tree.
void SmallRegionMesher::clip_ears() {
  faces_.clear();
  across_.clear();
  for (const int v : loop_) across_.push_back(~v);
  for (std::size_t i = 0, refused = 0; loop_.size() > 3;) {
    const std::size_t n = loop_.size();
    if (refused == n) throw std::logic_error("a simple polygon has no ear");
    i %= n;
    if (is_ear(loop_[(i + n - 1) % n], loop_[i], loop_[(i + 1) % n])) {
      clip(i);
      refused = 0;
    } else {
      ++i;
      ++refused;
    }
  }
  add({loop_[0], loop_[1], loop_[2]}, {across_[0], across_[1], across_[2]});
}

bool SmallRegionMesher::is_ear(int before, int tip, int after) const {
  const Point &a = points_[before], &b = points_[tip], &c = points_[after];
  if (!is_left(a, b, c)) return false;
  return std::ranges::none_of(loop_, [&](int v) {
    if (v == before || v == tip || v == after) return false;
    const Point& p = points_[v];
    return !is_left(b, a, p) && !is_left(c, b, p) && !is_left(a, c, p);
  });
}

// The face goes from the vertex before over the tip to the one after; its third side takes the place of two.
void SmallRegionMesher::clip(std::size_t i) {
  const std::size_t before = (i + loop_.size() - 1) % loop_.size(), after = (i + 1) % loop_.size();
  across_[before] = add({loop_[before], loop_[i], loop_[after]}, {across_[before], across_[i], none});
  loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(i));
  across_.erase(across_.begin() + static_cast<std::ptrdiff_t>(i));
}

// --- the vertices inside ---

bool SmallRegionMesher::insert_inner_vertices() {
  for (int v = 0; v < n_vertices_; ++v) {
    if (halfedge_from_[v] == none && !insert(v)) return false;
  }
  return true;
}

// False if no face has it inside or on a side that may be split.
bool SmallRegionMesher::insert(int vertex) {
  const Point& p = points_[vertex];
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    const auto& c = faces_[f].corners;
    std::array<Orientation, 3> at;
    for (int k = 0; k < 3; ++k) at[k] = orientation(points_[c[k]], points_[c[following(k)]], p);
    if (std::ranges::count(at, Orientation::Clockwise) > 0) continue;
    const auto n_on = std::ranges::count(at, Orientation::Collinear);
    if (n_on > 1) return false;  // at a corner
    if (n_on == 1)
      return split_side(f, static_cast<int>(std::ranges::find(at, Orientation::Collinear) - at.begin()),
                        vertex);
    split_face(f, vertex);
    return true;
  }
  return false;
}

void SmallRegionMesher::split_face(int face, int vertex) {
  const auto [c, n] = faces_[face];
  const int second = static_cast<int>(faces_.size()), third = second + 1;
  faces_[face] = {{c[0], c[1], vertex}, {n[0], second, third}};
  faces_.push_back({{c[1], c[2], vertex}, {n[1], third, face}});
  faces_.push_back({{c[2], c[0], vertex}, {n[2], face, second}});
  relink(n[1], face, second);
  relink(n[2], face, third);
}

// Both faces beside it become two; false on the border.
bool SmallRegionMesher::split_side(int face, int side, int vertex) {
  const int other = faces_[face].neighbours[side];
  if (other < 0) return false;
  const int back = side_towards(other, face);
  const auto [c, n] = faces_[face];
  const auto [d, m] = faces_[other];
  const int a = c[side], b = c[following(side)], apex = c[preceding(side)], far = d[preceding(back)];
  const int left = static_cast<int>(faces_.size()), right = left + 1;
  faces_[face] = {{vertex, b, apex}, {other, n[following(side)], left}};
  faces_[other] = {{b, vertex, far}, {face, right, m[preceding(back)]}};
  faces_.push_back({{a, vertex, apex}, {right, face, n[preceding(side)]}});
  faces_.push_back({{vertex, a, far}, {left, m[following(back)], other}});
  relink(n[preceding(side)], face, left);
  relink(m[following(back)], other, right);
  return true;
}

// --- the Delaunay one ---

// Each edge is looked at once, and again when a face beside it has become another [Lawson 1977].
void SmallRegionMesher::flip_to_delaunay() {
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (faces_[f].neighbours[k] > f) suspects_.push_back({f, k});
    }
  }
  while (!suspects_.empty()) {
    const auto [face, side] = suspects_.back();
    suspects_.pop_back();
    flip_if_better(face, side);
  }
}

//      c             c
//    /   \         / | \       .
//   a --> b  ->   a  |  b
//    \   /         \ | /
//      d             d
void SmallRegionMesher::flip_if_better(int face, int side) {
  const int other = faces_[face].neighbours[side];
  if (other < 0) return;
  const int back = side_towards(other, face);
  const int a = faces_[face].corners[side], b = faces_[face].corners[following(side)];
  const int c = faces_[face].corners[preceding(side)], d = faces_[other].corners[preceding(back)];
  if (in_circle(points_[a], points_[b], points_[c], points_[d]) != Side::Inside) return;
  const int bc = faces_[face].neighbours[following(side)], ca = faces_[face].neighbours[preceding(side)];
  const int ad = faces_[other].neighbours[following(back)], db = faces_[other].neighbours[preceding(back)];
  faces_[face] = {{a, d, c}, {ad, other, ca}};
  faces_[other] = {{d, b, c}, {db, bc, face}};
  relink(ad, other, face);
  relink(bc, face, other);
  suspects_.insert(suspects_.end(), {{face, 0}, {face, 2}, {other, 0}, {other, 1}});
}

// --- faces and their neighbours ---

int SmallRegionMesher::add(const std::array<int, 3>& corners, const std::array<int, 3>& neighbours) {
  const int face = static_cast<int>(faces_.size());
  faces_.push_back({corners, neighbours});
  for (int k = 0; k < 3; ++k) {
    const int other = neighbours[k];
    if (other < 0) continue;
    auto& towards = faces_[other];
    towards.neighbours[std::ranges::find(towards.corners, corners[following(k)]) - towards.corners.begin()] =
        face;
  }
  return face;
}

void SmallRegionMesher::relink(int neighbour, int from, int to) {
  if (neighbour >= 0) faces_[neighbour].neighbours[side_towards(neighbour, from)] = to;
}

int SmallRegionMesher::side_towards(int face, int neighbour) const {
  const auto& n = faces_[face].neighbours;
  return static_cast<int>(std::ranges::find(n, neighbour) - n.begin());
}

void SmallRegionMesher::convert() {
  new_faces_.clear();
  for (const auto& [corners, neighbours] : faces_) {
    Triangle global, across;
    for (int k = 0; k < 3; ++k) {
      global[k] = vertices_[corners[k]];
      across[k] = neighbours[k] >= 0 ? neighbours[k] : ~halfedge_from_[~neighbours[k]];
    }
    new_faces_.add(global, across, {none, none, none});
  }
}

}  // namespace kinemesh
