#include "untangle/fill/plane_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "kinemesh/predicates.h"
#include "untangle/fill/outline_mesher.h"

namespace kinemesh {
namespace {

bool is_open(const PlaneSide& side) {
  return side.face == none && side.sub == none && side.mesh_side == none;
}

bool has_open_side(const PlanePart& part) {
  return std::ranges::any_of(part, [](const auto& face) { return std::ranges::any_of(face.sides, is_open); });
}

Seam seam_along(int edge, int a, int b) {
  return {edge, std::min(a, b), std::max(a, b)};
}

class PartsMesher {
 public:
  PartsMesher(const RemeshableSet& set, const ShadowBorder& border)
      : set_(set), mesh_(set.mesh()), border_(border), mesher_(border) {}

  std::optional<std::vector<PlanePart>> run() {
    for (const auto& [face, subs] : border_.subs_of) {
      if (!add_sheet(face, subs)) return std::nullopt;
    }
    if (!add_shadow()) return std::nullopt;
    return std::move(parts_);
  }

 private:
  // --- outside X, face by face ---

  bool add_sheet(Face face, const std::vector<int>& subs) {
    Outline outline;
    for (const int v : set_.corners(face)) outline.add_vertex(v);
    for (const int s : subs) outline.add_sub_segment(s, border_.subs[s]);
    auto part = mesher_.run(outline, OutlineMesher::Keep::Right);
    if (!part || !find_mesh_sides(face, *part)) return false;
    parts_.push_back(std::move(*part));
    return true;
  }

  // What is open lies on a side of the mesh's face. False if it cannot be told on which.
  bool find_mesh_sides(Face face, PlanePart& part) {
    for (auto& [corners, sides] : part) {
      for (int k = 0; k < 3; ++k) {
        if (!is_open(sides[k])) continue;
        const int common = sides_through(face, corners[k]) & sides_through(face, corners[(k + 1) % 3]);
        if (common != 1 && common != 2 && common != 4) return false;
        close(sides[k], mesh_.sides(face)[common >> 1]);
      }
    }
    return true;
  }

  // Bits 0 to 2: the sides of the face that the vertex lies on.
  int sides_through(Face face, int v) const {
    const auto corners = set_.corners(face);
    int sides = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      if (v == a || v == b || are_collinear(a, b, v)) sides |= 1 << k;
    }
    return sides;
  }

  bool are_collinear(int a, int b, int c) const {
    const auto& p = border_.points;
    return CGAL::collinear(p[a], p[b], p[c]);
  }

  void close(PlaneSide& side, Side mesh_side) {
    side.mesh_side = mesh_side;
    if (set_.is_inner(mesh_side)) side.constraint = mesh_.constraint_of(mesh_side);
  }

  // --- X ---

  bool add_shadow() {
    Outline outline;
    add_vertices_in_region(outline);
    for (int s = 0; s < static_cast<int>(border_.subs.size()); ++s)
      outline.add_sub_segment(s, border_.subs[s]);
    add_constraints(outline);
    auto part = mesher_.run(outline, OutlineMesher::Keep::Left);
    if (!part || has_open_side(*part)) return false;
    parts_.push_back(std::move(*part));
    return true;
  }

  void add_vertices_in_region(Outline& outline) const {
    std::vector<bool> is_inside(set_.n_vertices(), false);
    for (const auto& [inverted, faces] : set_.over()) {
      for (const int v : set_.corners(inverted)) is_inside[v] = true;
      for (const Face face : faces) {
        for (const int v : set_.corners(face)) is_inside[v] = is_inside[v] || is_over(v, inverted);
      }
    }
    for (int v = 0; v < set_.n_vertices(); ++v) {
      if (is_inside[v]) outline.add_vertex(v);
    }
  }

  bool is_over(int v, Face inverted) const {
    return strictly_inside(mesh_.position(set_.vertex(v)), mesh_.corners(inverted));
  }

  // A constrained edge is cut where the border of R crosses it; what was not met outside X is in R.
  void add_constraints(Outline& outline) const {
    const auto met = seams_met();
    for (const Side side : constrained_sides()) {
      const Side edge = mesh_.lower(side);
      const auto stops = stops_along(side);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const int a = stops[i], b = stops[i + 1];
        if (!met.contains(seam_along(edge, a, b))) outline.add_constraint(mesh_.constraint_of(edge), a, b);
      }
    }
  }

  // Along mesh edges, outside X or on its border.
  std::set<Seam> seams_met() const {
    std::set<Seam> met;
    for (const auto& sub : border_.subs) met.insert(seam_along(sub.crease, sub.from, sub.to));
    for (const auto& part : parts_) {
      for (const auto& face : part) {
        for (int k = 0; k < 3; ++k) {
          if (face.sides[k].mesh_side != none) met.insert(seam_of(mesh_, face, k));
        }
      }
    }
    return met;
  }

  // One side of each constrained edge between faces of R*.
  std::vector<Side> constrained_sides() const {
    std::vector<Side> constrained;
    for (const Face face : set_.faces()) {
      for (const Side side : Mesh::sides(face)) {
        const bool is_first = set_.is_inner(side) && face <= mesh_.face_across(side);
        if (is_first && mesh_.constraint_of(side) != none) constrained.push_back(side);
      }
    }
    return constrained;
  }

  // The border's vertices on a mesh edge, in order.
  std::vector<int> stops_along(Side mesh_side) const {
    const int a = set_.number(mesh_.from(mesh_side)), b = set_.number(mesh_.to(mesh_side));
    std::vector<int> stops{a, b};
    add_extra_on(a, b, border_.subs_of, Mesh::face_of(mesh_side), stops);
    add_extra_on(a, b, border_.subs_of, mesh_.face_across(mesh_side), stops);
    add_extra_on(a, b, border_.subs_along, mesh_.lower(mesh_side), stops);
    const auto& p = border_.points;
    std::sort(stops.begin(), stops.end(),
              [&](int v, int w) { return CGAL::has_smaller_distance_to_point(p[a], p[v], p[w]); });
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    return stops;
  }

  // Of the sub-segments of a face, or along a crease, the extra vertices on the line from a to b.
  template <class Key>
  void add_extra_on(int a, int b, const std::map<Key, std::vector<int>>& subs_by, Key key,
                    std::vector<int>& stops) const {
    const auto subs = subs_by.find(key);
    if (subs == subs_by.end()) return;
    for (const int s : subs->second) {
      for (const int v : {border_.subs[s].from, border_.subs[s].to}) {
        if (v >= set_.n_vertices() && are_collinear(a, b, v)) stops.push_back(v);
      }
    }
  }

  const RemeshableSet& set_;
  const Mesh& mesh_;
  const ShadowBorder& border_;
  OutlineMesher mesher_;
  std::vector<PlanePart> parts_;
};

}  // namespace

Seam seam_of(const Mesh& mesh, const PlaneFace& face, int side) {
  const auto& across = face.sides[side];
  if (across.sub != none) return {~across.sub, 0, 0};
  return seam_along(mesh.lower(across.mesh_side), face.corners[side], face.corners[(side + 1) % 3]);
}

std::optional<std::vector<PlanePart>> triangulate_parts(const RemeshableSet& set,
                                                        const ShadowBorder& border) {
  return PartsMesher(set, border).run();
}

}  // namespace kinemesh
