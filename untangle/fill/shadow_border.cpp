#include "untangle/fill/shadow_border.h"

#include <algorithm>
#include <utility>

#include "core/exact/overlap.h"
#include "kinemesh/predicates.h"
#include "untangle/walk/shadow_index.h"

namespace kinemesh {
namespace {

using Number = ExactKernel::FT;

// A place on a crease edge: an end of it (then edge is none), or where a mesh edge crosses it.
struct Place {
  Number parameter;
  Side edge;
};

// The same edge cuts at the same place; only other ties need exact arithmetic.
bool is_before(const Place& p, const Place& q) {
  return (p.edge != q.edge || p.edge == none) && p.parameter < q.parameter;
}

bool is_same(const Place& p, const Place& q) {
  return (p.edge == q.edge && p.edge != none) || p.parameter == q.parameter;
}

// A part of a crease edge: in the shadow of a face, or in none.
struct Interval {
  Place low{0, none}, high{1, none};
  Face face;
};

bool starts_lower(const Interval& i, const Interval& j) {
  return is_before(i.low, j.low) || (i.face < j.face && !is_before(j.low, i.low));
}

// X to its left.
struct Crease {
  int from, to;  // vertices
  Side edge;
  Point a, b;  // the ends
};

// Of p from the line p0 p1, up to a factor; positive to its left.
Number distance(const Point& p0, const Point& p1, const Point& p) {
  return (Number(p1.x) - Number(p0.x)) * (Number(p.y) - Number(p0.y)) -
         (Number(p1.y) - Number(p0.y)) * (Number(p.x) - Number(p0.x));
}

// Takes away what lies beyond a side, given how far inside of it the ends of the crease edge are.
void clip(Interval& interval, const Number& at_a, const Number& at_b, Side edge) {
  if (at_a >= 0 && at_b >= 0) return;
  const Place cut{at_a / (at_a - at_b), edge};
  if (at_b < 0 && is_before(cut, interval.high)) interval.high = cut;
  if (at_a < 0 && is_before(interval.low, cut)) interval.low = cut;
}

// The part inside the face's shadow, if any.
std::optional<Interval> part_inside(const Mesh& mesh, const Crease& crease, Face face) {
  const auto corners = mesh.corners(face);
  if (!meets_interior(crease.a, crease.b, std::span(&corners, 1))) return std::nullopt;
  const bool upright = orientation(corners[0], corners[1], corners[2]) == Orientation::CounterClockwise;
  const auto depth = [&](int k, const Point& p) {
    const auto value = distance(corners[k], corners[(k + 1) % 3], p);
    return upright ? value : -value;
  };
  Interval interval{.face = face};
  const auto sides = mesh.sides(face);
  for (int k = 0; k < 3; ++k) clip(interval, depth(k, crease.a), depth(k, crease.b), mesh.lower(sides[k]));
  return is_before(interval.low, interval.high) ? std::optional(std::move(interval)) : std::nullopt;
}

class BorderTracer {
 public:
  explicit BorderTracer(const RemeshableSet& set) : set_(set), mesh_(set.mesh()) {}

  std::optional<ShadowBorder> run() {
    add_points();
    if (!place_vertices()) return std::nullopt;
    std::vector<Face> inverted;
    for (const auto& [face, over] : set_.over()) inverted.push_back(face);
    index_.build(mesh_, inverted);
    for (const Face face : inverted) {
      if (!trace_face(face)) return std::nullopt;
    }
    return std::move(border_);
  }

 private:
  void add_points() {
    for (int v = 0; v < set_.n_vertices(); ++v) {
      const Point& p = mesh_.position(set_.vertex(v));
      border_.points.emplace_back(p.x, p.y);
    }
  }

  // False if two vertices of J lie at the same place.
  bool place_vertices() {
    for (const auto& [inverted, over] : set_.over()) {
      for (const int v : set_.corners(inverted)) {
        if (at_.try_emplace(border_.points[v], v).first->second != v) return false;
      }
    }
    return true;
  }

  bool trace_face(Face inverted) {
    for (const Side side : Mesh::sides(inverted)) {
      const Face across = mesh_.face_across(side);
      if (!set_.is_inverted(across) && !trace_crease(inverted, side)) return false;
    }
    return true;
  }

  bool trace_crease(Face inverted, Side side) {
    const auto crease = crease_along(side);
    const auto sheets = sheets_over(crease, inverted);
    const auto parts = uncovered(crease, inverted);
    return std::ranges::all_of(parts, [&](const Interval& part) { return cut(crease, part, sheets); });
  }

  // An inverted face lies to the right of its sides.
  Crease crease_along(Side side) const {
    const Vertex from = mesh_.to(side), to = mesh_.from(side);
    return {set_.number(from), set_.number(to), mesh_.lower(side), mesh_.position(from), mesh_.position(to)};
  }

  std::vector<Interval> sheets_over(const Crease& crease, Face inverted) const {
    std::vector<Interval> sheets;
    for (const Face face : set_.over().at(inverted)) {
      if (set_.is_inverted(face)) continue;
      if (auto sheet = part_inside(mesh_, crease, face)) sheets.push_back(std::move(*sheet));
    }
    std::sort(sheets.begin(), sheets.end(), starts_lower);
    return sheets;
  }

  // What no other inverted face of J covers, in order.
  std::vector<Interval> uncovered(const Crease& crease, Face inverted) const {
    std::vector<Interval> parts;
    Place reached{0, none};
    const Place end{1, none};
    for (const auto& cover : covers(crease, inverted)) {
      if (is_before(reached, cover.low)) parts.push_back({reached, cover.low, none});
      if (is_before(reached, cover.high)) reached = cover.high;
    }
    if (is_before(reached, end)) parts.push_back({reached, end, none});
    return parts;
  }

  std::vector<Interval> covers(const Crease& crease, Face inverted) const {
    std::vector<Interval> covers;
    index_.any_near(crease.a, crease.b, [&](Face other) {
      auto cover = other == inverted ? std::nullopt : part_inside(mesh_, crease, other);
      if (cover) covers.push_back(std::move(*cover));
      return false;
    });
    std::sort(covers.begin(), covers.end(), starts_lower);
    return covers;
  }

  // False if the sheets over the part do not tile it exactly once (Lemma 3.1).
  bool cut(const Crease& crease, const Interval& part, const std::vector<Interval>& sheets) {
    Place reached = part.low;
    for (const auto& sheet : sheets) {
      const Place& low = std::max(sheet.low, part.low, is_before);
      const Place& high = std::min(sheet.high, part.high, is_before);
      if (!is_before(low, high)) continue;
      if (!is_same(low, reached)) return false;
      add_sub_segment(crease, low, high, sheet.face);
      reached = high;
    }
    return is_same(reached, part.high);
  }

  void add_sub_segment(const Crease& crease, const Place& low, const Place& high, Face face) {
    const int from = vertex_on(crease, low), to = vertex_on(crease, high);
    border_.subs_of[face].push_back(static_cast<int>(border_.subs.size()));
    border_.subs_along[crease.edge].push_back(static_cast<int>(border_.subs.size()));
    border_.subs.push_back({from, to, face, crease.edge});
  }

  int vertex_on(const Crease& crease, const Place& place) {
    if (place.edge == none) return place.parameter == 0 ? crease.from : crease.to;
    const auto [it, fresh] = crossings_.try_emplace(std::minmax(crease.edge, place.edge), int{none});
    const ExactPoint &a = border_.points[crease.from], &b = border_.points[crease.to];
    if (fresh) it->second = vertex_at(a + place.parameter * (b - a));
    return it->second;
  }

  int vertex_at(const ExactPoint& point) {
    const auto [it, fresh] = at_.try_emplace(point, static_cast<int>(border_.points.size()));
    if (fresh) border_.points.push_back(point);
    return it->second;
  }

  const RemeshableSet& set_;
  const Mesh& mesh_;
  ShadowIndex index_;                               // of the inverted faces of J
  std::map<ExactPoint, int> at_;                    // vertices of J and extra ones by place
  std::map<std::pair<Side, Side>, int> crossings_;  // vertices by the two mesh edges, ascending
  ShadowBorder border_;
};

}  // namespace

std::optional<ShadowBorder> trace_shadow_border(const RemeshableSet& set) {
  return BorderTracer(set).run();
}

}  // namespace kinemesh
