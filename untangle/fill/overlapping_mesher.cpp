#include "untangle/fill/overlapping_mesher.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "core/cdt/cgal_triangulation.h"
#include "core/exact/overlap.h"
#include "kinemesh/predicates.h"
#include "untangle/fill/surface.h"
#include "untangle/walk/shadow_index.h"

namespace kinemesh {
namespace {

using Number = ExactKernel::FT;

// A part of the border of X, X to its left, as far as one upright face runs across it.
struct SubSegment {
  int from, to;  // vertices of the surface
  int face;      // of the mesh
};

// A place on a segment: an end of it (then edge is none), or where a mesh edge crosses it.
struct Place {
  Number parameter;
  int edge;
};

// The same edge cuts at the same place; only other ties need exact arithmetic.
bool is_before(const Place& p, const Place& q) {
  return (p.edge != q.edge || p.edge == none) && p.parameter < q.parameter;
}

bool is_same(const Place& p, const Place& q) {
  return (p.edge == q.edge && p.edge != none) || p.parameter == q.parameter;
}

struct Interval {
  Place low, high;
  int face;
};

// A crease edge, X to its left.
struct Segment {
  int from, to;  // vertices of the mesh
  int edge;
};

struct NotGeneral {};  // thrown where positions are too degenerate for the construction

class Construction {
 public:
  Construction(const Mesh& mesh, const FaceSets& sets, int set, std::span<const Cell> cells)
      : mesh_(mesh), sets_(sets), set_(set) {
    number_vertices();
    for (const auto& [face, inverted] : cells) over_[inverted].push_back(face);
    for (auto& [inverted, faces] : over_) {
      std::sort(faces.begin(), faces.end());
      pieces_.push_back(inverted);
    }
  }

  NewFaces run() {
    place_vertices_of_pieces();
    trace_border();
    triangulate_outside();
    triangulate_inside();
    check_glued();
    remove_extra_vertices();
    return convert();
  }

 private:
  // --- vertices: those of the region first, in the mesh's order, then the extra ones ---

  void number_vertices() {
    for (const int face : sets_.faces(set_)) {
      const auto& t = mesh_.triangles()[face];
      vertices_.insert(vertices_.end(), t.begin(), t.end());
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const int v : vertices_) surface_.points.emplace_back(mesh_.position(v).x, mesh_.position(v).y);
  }

  int local(int vertex) const {
    return static_cast<int>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
  }
  bool is_extra(int v) const { return v >= static_cast<int>(vertices_.size()); }
  int sheet_corner(int face, int k) const { return local(mesh_.triangles()[face][k]); }

  // An end of a sub-segment at the place of a vertex of J is that vertex.
  void place_vertices_of_pieces() {
    for (const int piece : pieces_) {
      for (int k = 0; k < 3; ++k) {
        const int v = sheet_corner(piece, k);
        const auto [it, fresh] = at_.try_emplace(surface_.points[v], v);
        if (!fresh && it->second != v) throw NotGeneral();
      }
    }
    in_region_.assign(vertices_.size(), false);
    for (const auto& [point, v] : at_) in_region_[v] = true;
  }

  int vertex_at(const ExactPoint& point) {
    const auto [it, fresh] = at_.try_emplace(point, static_cast<int>(surface_.points.size()));
    if (fresh) surface_.points.push_back(point);
    return it->second;
  }

  // --- 1 to 3: the border of X ---

  bool is_piece(int face) const { return over_.contains(face); }

  void trace_border() {
    ShadowIndex index;
    index.build(mesh_, pieces_);
    for (const int piece : pieces_) {
      for (const int side : mesh_.sides(piece)) {
        const int across = mesh_.face_across(side);
        if (across == none || !is_piece(across)) trace_crease(piece, side, index);
      }
    }
  }

  // An inverted face lies to the right of its sides.
  void trace_crease(int piece, int side, const ShadowIndex& index) {
    const int from = mesh_.to(side), to = mesh_.from(side);
    const Point &a = mesh_.position(from), &b = mesh_.position(to);
    std::vector<Interval> covered;
    index.any_near(a, b, [&](int other) {
      if (other != piece) add_interval(a, b, other, covered);
      return false;
    });
    const auto low_first = [](const Interval& i, const Interval& j) {
      return is_before(i.low, j.low) || (i.face < j.face && !is_before(j.low, i.low));
    };
    std::sort(covered.begin(), covered.end(), low_first);
    std::vector<Interval> sheets;
    for (const int face : over_[piece]) {
      if (!is_piece(face)) add_interval(a, b, face, sheets);
    }
    std::sort(sheets.begin(), sheets.end(), low_first);
    const Segment crease{from, to, mesh_.lower(side)};
    const Place end{1, none};
    Place free_from{0, none};
    for (const auto& cover : covered) {
      if (is_before(free_from, cover.low)) add_sub_segments(crease, {free_from, cover.low, none}, sheets);
      if (is_before(free_from, cover.high)) free_from = cover.high;
    }
    if (is_before(free_from, end)) add_sub_segments(crease, {free_from, end, none}, sheets);
  }

  // The part of a -> b inside the face's shadow, if any.
  void add_interval(const Point& a, const Point& b, int face, std::vector<Interval>& intervals) const {
    const auto corners = mesh_.corners(face);
    if (!meets_interior(a, b, std::span(&corners, 1))) return;
    const bool upright = orientation(corners[0], corners[1], corners[2]) == Orientation::CounterClockwise;
    Interval interval{{0, none}, {1, none}, face};
    const auto sides = mesh_.sides(face);
    for (int k = 0; k < 3; ++k) {
      const Number u = distance(corners[k], corners[(k + 1) % 3], a, upright);
      const Number w = distance(corners[k], corners[(k + 1) % 3], b, upright);
      if (u >= 0 && w >= 0) continue;
      const Place cut{u / (u - w), mesh_.lower(sides[k])};
      if (w < 0 && is_before(cut, interval.high)) interval.high = cut;
      if (u < 0 && is_before(interval.low, cut)) interval.low = cut;
    }
    if (is_before(interval.low, interval.high)) intervals.push_back(std::move(interval));
  }

  // Of p from the line p0 p1, up to a factor; positive inside.
  static Number distance(const Point& p0, const Point& p1, const Point& p, bool upright) {
    const Number value = (Number(p1.x) - Number(p0.x)) * (Number(p.y) - Number(p0.y)) -
                         (Number(p1.y) - Number(p0.y)) * (Number(p.x) - Number(p0.x));
    return upright ? value : -value;
  }

  // The sheets over the part tile it exactly once (Lemma 3.1).
  void add_sub_segments(const Segment& crease, const Interval& part, const std::vector<Interval>& sheets) {
    Place reached = part.low;
    for (const auto& sheet : sheets) {
      const Place& low = is_before(sheet.low, part.low) ? part.low : sheet.low;
      const Place& high = is_before(part.high, sheet.high) ? part.high : sheet.high;
      if (!is_before(low, high)) continue;
      if (!is_same(low, reached)) throw NotGeneral();
      subs_of_[sheet.face].push_back(static_cast<int>(subs_.size()));
      subs_.push_back({vertex_on(crease, low), vertex_on(crease, high), sheet.face});
      reached = high;
    }
    if (!is_same(reached, part.high)) throw NotGeneral();
  }

  int vertex_on(const Segment& crease, const Place& place) {
    const int a = local(crease.from), b = local(crease.to);
    if (place.edge == none) return place.parameter == 0 ? a : b;
    const auto [it, fresh] = crossings_.try_emplace(std::minmax(crease.edge, place.edge), none);
    const auto& p = surface_.points;
    if (fresh) it->second = vertex_at(p[a] + place.parameter * (p[b] - p[a]));
    return it->second;
  }

  // --- 4: outside X, face by face ---

  void triangulate_outside() {
    for (const auto& [face, subs] : subs_of_) triangulate_sheet(face, subs);
  }

  void triangulate_sheet(int face, const std::vector<int>& subs) {
    std::vector<int> used{sheet_corner(face, 0), sheet_corner(face, 1), sheet_corner(face, 2)};
    const std::vector<Edge> edges = edges_of(subs, used);
    const auto triangulation = triangulate(used, edges);
    const auto kept = flood(triangulation, subs, edges.size(), used, false);
    std::vector<int> sides_on(used.size());  // bit k: on side k of the face
    for (std::size_t i = 0; i < used.size(); ++i) sides_on[i] = sides_through(face, used[i]);
    add_faces(triangulation, kept, used, subs, [&](int side, int a, int b) {
      const int common = sides_on[a] & sides_on[b];
      if (common != 1 && common != 2 && common != 4) throw NotGeneral();
      glue_along_mesh(face, common >> 1, side);
    });
  }

  // Bits 0 to 2: the sides of the face that the vertex lies on.
  int sides_through(int face, int v) const {
    int sides = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = sheet_corner(face, k), b = sheet_corner(face, (k + 1) % 3);
      const auto& p = surface_.points;
      if (v == a || v == b || CGAL::orientation(p[a], p[b], p[v]) == CGAL::COLLINEAR) sides |= 1 << k;
    }
    return sides;
  }

  void glue_along_mesh(int face, int k, int side) {
    const int halfedge = mesh_.sides(face)[k];
    const int across = mesh_.face_across(halfedge);
    if (across == none || sets_.set_of(across) != set_) {
      surface_.glue(side, ~halfedge);
      return;
    }
    const int edge = mesh_.lower(halfedge);
    const int a = surface_.corners[side], b = surface_.corners[Surface::next(side)];
    surface_.constraints[side] = mesh_.constraint_of(edge);
    glue_by_key({edge, std::min(a, b), std::max(a, b)}, side);
  }

  // --- 5: X ---

  void triangulate_inside() {
    std::vector<int> subs(subs_.size());
    std::iota(subs.begin(), subs.end(), 0);
    find_vertices_in_region();
    std::vector<int> used;
    for (int v = 0; v < static_cast<int>(vertices_.size()); ++v) {
      if (in_region_[v]) used.push_back(v);
    }
    std::vector<Edge> edges = edges_of(subs, used);
    inner_constraints_.clear();
    add_constraints_inside(used, edges);
    const auto triangulation = triangulate(used, edges);
    const auto kept = flood(triangulation, subs, subs.size(), used, true);
    add_faces(triangulation, kept, used, subs, [](int, int, int) { throw NotGeneral(); });
  }

  void find_vertices_in_region() {
    for (const auto& [inverted, faces] : over_) {
      const auto piece = mesh_.corners(inverted);
      for (const int face : faces) {
        for (const int v : mesh_.triangles()[face]) {
          if (!in_region_[local(v)] && strictly_inside(mesh_.position(v), piece)) in_region_[local(v)] = true;
        }
      }
    }
  }

  // A constrained edge is cut where the border of R crosses it; what was not met outside X is in R.
  void add_constraints_inside(std::vector<int>& used, std::vector<Edge>& edges) {
    for (const int face : sets_.faces(set_)) {
      for (const int side : mesh_.sides(face)) {
        const int constraint = mesh_.constraint_of(side);
        const int across = mesh_.face_across(side);
        const bool inner = across != none && sets_.set_of(across) == set_;
        if (constraint == none || !inner || face > across) continue;
        const auto stops = stops_along(side);
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
          const Key key{mesh_.lower(side), std::min(stops[i], stops[i + 1]),
                        std::max(stops[i], stops[i + 1])};
          if (open_sides_.contains(key) || glued_.contains(key)) continue;
          edges.push_back({place_of(used, stops[i]), place_of(used, stops[i + 1])});
          inner_constraints_.push_back(constraint);
        }
      }
    }
  }

  // The surface's vertices on a mesh edge, in order.
  std::vector<int> stops_along(int halfedge) const {
    const int a = local(mesh_.from(halfedge)), b = local(mesh_.to(halfedge));
    std::vector<int> stops{a, b};
    for (const int face : {Mesh::face_of(halfedge), mesh_.face_across(halfedge)}) {
      const auto subs = subs_of_.find(face);
      if (subs == subs_of_.end()) continue;
      for (const int s : subs->second) {
        for (const int v : {subs_[s].from, subs_[s].to}) {
          const auto& p = surface_.points;
          if (is_extra(v) && CGAL::collinear(p[a], p[b], p[v])) stops.push_back(v);
        }
      }
    }
    const auto nearer = [&](int v, int w) {
      return CGAL::has_smaller_distance_to_point(surface_.points[a], surface_.points[v], surface_.points[w]);
    };
    std::sort(stops.begin(), stops.end(), nearer);
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    return stops;
  }

  // --- triangulations ---

  static int place_of(std::vector<int>& used, int v) {
    const auto found = std::find(used.begin(), used.end(), v);
    if (found == used.end()) used.push_back(v);
    return static_cast<int>(std::find(used.begin(), used.end(), v) - used.begin());
  }

  // The sub-segments as edges between places in `used`, which gets their ends.
  std::vector<Edge> edges_of(const std::vector<int>& subs, std::vector<int>& used) const {
    std::map<int, int> place;
    for (std::size_t i = 0; i < used.size(); ++i) place[used[i]] = static_cast<int>(i);
    const auto place_in = [&](int v) {
      const auto [it, fresh] = place.try_emplace(v, static_cast<int>(used.size()));
      if (fresh) used.push_back(v);
      return it->second;
    };
    std::vector<Edge> edges;
    for (const int s : subs) {
      const int from = place_in(subs_[s].from), to = place_in(subs_[s].to);
      edges.push_back({from, to});
    }
    return edges;
  }

  Triangulation triangulate(const std::vector<int>& used, const std::vector<Edge>& edges) {
    std::vector<int> order(used.size());
    std::iota(order.begin(), order.end(), 0);
    Triangulation triangulation;
    const auto point_at = [&](int i) -> const ExactPoint& { return surface_.points[used[i]]; };
    const bool good =
        cgal_.insert_points(order, point_at) && cgal_.insert_edges(edges) && cgal_.extract(triangulation);
    if (!good) throw NotGeneral();
    return triangulation;
  }

  // The triangles that can be reached from the left or from the right of the first n_subs edges without
  // crossing one.
  std::vector<bool> flood(const Triangulation& triangulation, const std::vector<int>& subs,
                          std::size_t n_subs, const std::vector<int>& used, bool left) const {
    std::vector<bool> reached(triangulation.triangles.size(), false);
    std::vector<int> pending;
    const auto reach = [&](int t) {
      if (t == none || reached[t]) return;
      reached[t] = true;
      pending.push_back(t);
    };
    const auto is_sub = [&](int e) { return e != none && e < static_cast<int>(n_subs); };
    const auto is_left = [&](int t, int k) {
      return used[triangulation.triangles[t][k]] == subs_[subs[triangulation.edges[t][k]]].from;
    };
    for (int t = 0; t < static_cast<int>(reached.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (is_sub(triangulation.edges[t][k]) && is_left(t, k) == left) reach(t);
      }
    }
    while (!pending.empty()) {
      const int t = pending.back();
      pending.pop_back();
      for (int k = 0; k < 3; ++k) {
        if (!is_sub(triangulation.edges[t][k]))
          reach(triangulation.neighbours[t][k]);
        else if (is_left(t, k) != left)
          throw NotGeneral();
      }
    }
    return reached;
  }

  // --- 6: gluing ---

  using Key = std::tuple<int, int, int>;  // mesh edge, end, end; or ~sub-segment, 0, 0

  void glue_by_key(const Key& key, int side) {
    if (glued_.contains(key)) throw NotGeneral();
    const auto [it, fresh] = open_sides_.try_emplace(key, side);
    if (fresh) return;
    surface_.glue(side, it->second);
    open_sides_.erase(it);
    glued_.emplace(key, side);
  }

  template <class OnHull>
  void add_faces(const Triangulation& triangulation, const std::vector<bool>& kept,
                 const std::vector<int>& used, const std::vector<int>& subs, const OnHull& on_hull) {
    std::vector<int> first_side(kept.size(), none);
    for (std::size_t t = 0; t < kept.size(); ++t) {
      const auto& [a, b, c] = triangulation.triangles[t];
      if (kept[t]) first_side[t] = surface_.add_face(used[a], used[b], used[c]);
    }
    for (std::size_t t = 0; t < kept.size(); ++t) {
      for (int k = 0; kept[t] && k < 3; ++k) {
        const int side = first_side[t] + k;
        const int edge = triangulation.edges[t][k], across = triangulation.neighbours[t][k];
        if (edge >= static_cast<int>(subs.size()))
          surface_.constraints[side] = inner_constraints_[edge - subs.size()];
        if (edge != none && edge < static_cast<int>(subs.size())) {
          glue_by_key({~subs[edge], 0, 0}, side);
        } else if (across == none) {
          on_hull(side, triangulation.triangles[t][k], triangulation.triangles[t][(k + 1) % 3]);
        } else {
          const auto& back = triangulation.triangles[across];
          const int b = triangulation.triangles[t][(k + 1) % 3];
          surface_.glue(side, first_side[across] +
                                  static_cast<int>(std::find(back.begin(), back.end(), b) - back.begin()));
        }
      }
    }
  }

  void check_glued() const {
    if (!open_sides_.empty()) throw NotGeneral();
  }

  // --- 7: only vertices of the mesh ---

  void remove_extra_vertices() {
    std::vector<int> side_at(surface_.points.size(), none);
    const auto note_faces_from = [&](int first_face) {
      for (int f = first_face; f < surface_.n_faces(); ++f) {
        for (int s = 3 * f; s < 3 * f + 3; ++s) side_at[surface_.corners[s]] = s;
      }
    };
    note_faces_from(0);
    for (int v = static_cast<int>(vertices_.size()); v < static_cast<int>(surface_.points.size()); ++v) {
      const int before = surface_.n_faces();
      if (!surface_.remove_vertex(side_at[v])) throw NotGeneral();
      note_faces_from(before);
    }
  }

  // Each half-edge of the border of R* bounds one new face, from end to end.
  void check_border(const NewFaces& faces) const {
    std::vector<int> found, expected;
    for (int f = 0; f < faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int halfedge = ~faces.neighbours[f][k];
        if (halfedge < 0) continue;
        const bool fits = faces.triangles[f][k] == mesh_.from(halfedge) &&
                          faces.triangles[f][(k + 1) % 3] == mesh_.to(halfedge);
        if (!fits) throw NotGeneral();
        found.push_back(halfedge);
      }
    }
    for (const int face : sets_.faces(set_)) {
      for (const int side : mesh_.sides(face)) {
        const int across = mesh_.face_across(side);
        if (across == none || sets_.set_of(across) != set_) expected.push_back(side);
      }
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    if (found != expected) throw NotGeneral();
  }

  NewFaces convert() const {
    std::vector<int> number(surface_.n_faces(), none);
    int n = 0;
    for (int f = 0; f < surface_.n_faces(); ++f) {
      if (surface_.alive[f]) number[f] = n++;
    }
    if (n != static_cast<int>(sets_.faces(set_).size())) throw NotGeneral();
    NewFaces faces;
    for (int f = 0; f < surface_.n_faces(); ++f) {
      if (number[f] == none) continue;
      Triangle corners, neighbours, constraints;
      for (int k = 0; k < 3; ++k) {
        const int mate = surface_.mates[3 * f + k];
        corners[k] = vertices_[surface_.corners[3 * f + k]];
        neighbours[k] = mate < 0 ? mate : number[mate / 3];
        constraints[k] = surface_.constraints[3 * f + k];
      }
      faces.add(corners, neighbours, constraints);
    }
    check_border(faces);
    return faces;
  }

  const Mesh& mesh_;
  const FaceSets& sets_;
  int set_;
  std::vector<int> vertices_;                     // of the mesh, ascending: the surface's first
  std::map<int, std::vector<int>> over_;          // by inverted face of J: the faces of R* over it
  std::vector<int> pieces_;                       // the inverted faces of J
  std::map<ExactPoint, int> at_;                  // vertices of J and extra ones by place
  std::map<std::pair<int, int>, int> crossings_;  // extra vertices by the two mesh edges, ascending
  std::vector<bool> in_region_;                   // by vertex of the mesh: in R
  std::vector<SubSegment> subs_;
  std::map<int, std::vector<int>> subs_of_;  // by face
  std::vector<int> inner_constraints_;       // of the edges behind the sub-segments, inside X
  std::map<Key, int> open_sides_;
  std::map<Key, int> glued_;
  CgalTriangulation<ExactKernel> cgal_;
  Surface surface_;
};

}  // namespace

std::optional<NewFaces> mesh_overlapping(const Mesh& mesh, const FaceSets& sets, int set,
                                         std::span<const Cell> cells) {
  try {
    return Construction(mesh, sets, set, cells).run();
  } catch (const NotGeneral&) {
    return std::nullopt;
  }
}

}  // namespace kinemesh
