#include "tests/untangle/oracle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>

namespace kinemesh::oracle {
namespace {

using Int = std::int64_t;
__extension__ typedef __int128 Wide;

struct Grid {
  Int x, y;
  auto operator<=>(const Grid&) const = default;
};

Int on_grid(double x) {
  const double scaled = x * 0x1p24;
  if (scaled != std::floor(scaled) || std::abs(x) > 32.0)
    throw std::invalid_argument("a coordinate is not a small multiple of 2^-24");
  return static_cast<Int>(scaled);
}

Int cross(const Grid& a, const Grid& b, const Grid& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Shadow {
  std::array<Grid, 3> p;  // counter-clockwise unless flat
  int sign;               // as the face has it
};

bool boxes_apart(const Shadow& s, const Shadow& t) {
  const auto apart = [&](Int Grid::*c) {
    const auto by = [c](const Grid& a, const Grid& b) { return a.*c < b.*c; };
    const auto [s0, s1] = std::minmax_element(s.p.begin(), s.p.end(), by);
    const auto [t0, t1] = std::minmax_element(t.p.begin(), t.p.end(), by);
    return (*s1).*c <= (*t0).*c || (*t1).*c <= (*s0).*c;
  };
  return apart(&Grid::x) || apart(&Grid::y);
}

// All of t on the outer side of a side of s, or on its line.
bool separated_by_side_of(const Shadow& s, const Shadow& t) {
  for (int k = 0; k < 3; ++k) {
    const auto beyond = [&](const Grid& q) { return cross(s.p[k], s.p[(k + 1) % 3], q) <= 0; };
    if (std::all_of(t.p.begin(), t.p.end(), beyond)) return true;
  }
  return false;
}

bool interiors_overlap(const Shadow& s, const Shadow& t) {
  if (s.sign == 0 || t.sign == 0 || boxes_apart(s, t)) return false;
  return !separated_by_side_of(s, t) && !separated_by_side_of(t, s);
}

struct Fraction {
  Int over, under;  // under > 0
};
bool less(const Fraction& a, const Fraction& b) {
  return static_cast<Wide>(a.over) * b.under < static_cast<Wide>(b.over) * a.under;
}

// Some point of the segment strictly inside: the part of [0, 1] left by the three half-planes is an interval.
bool meets_interior(const Grid& a, const Grid& b, const Shadow& t) {
  if (t.sign == 0) return false;
  Fraction low{0, 1}, high{1, 1};
  for (int k = 0; k < 3; ++k) {
    const Int at_a = cross(t.p[k], t.p[(k + 1) % 3], a), at_b = cross(t.p[k], t.p[(k + 1) % 3], b);
    if (at_a <= 0 && at_b <= 0) return false;
    if (at_a < 0 || at_b < 0) {
      const Fraction crossing{std::abs(at_a), std::abs(at_a) + std::abs(at_b)};
      if (at_a < 0 && less(low, crossing)) low = crossing;
      if (at_b < 0 && less(crossing, high)) high = crossing;
    }
  }
  return less(low, high);
}

class Shadows {
 public:
  explicit Shadows(const Mesh& mesh) : mesh_(mesh) {
    for (const auto& p : mesh.positions()) places_.push_back({on_grid(p.x), on_grid(p.y)});
    for (const auto& [a, b, c] : mesh.triangles())
      shadows_.push_back(shadow(places_[a], places_[b], places_[c]));
  }

  const Grid& place(Vertex vertex) const { return places_[vertex]; }
  const Shadow& operator[](Face face) const { return shadows_[face]; }

  std::vector<Face> with_sign(int sign) const {
    std::vector<Face> faces;
    for (const Face f : mesh_.faces()) {
      if (shadows_[f].sign == sign) faces.push_back(f);
    }
    return faces;
  }

 private:
  static Shadow shadow(const Grid& a, const Grid& b, const Grid& c) {
    const Int area = cross(a, b, c);
    if (area < 0) return {{a, c, b}, -1};
    return {{a, b, c}, area > 0 ? 1 : 0};
  }

  const Mesh& mesh_;
  std::vector<Grid> places_;
  std::vector<Shadow> shadows_;
};

// Classes of `faces` under `joined(side)` for the edges between two of them.
std::vector<std::vector<Face>> classes(const Mesh& mesh, const std::vector<Face>& faces,
                                       const std::function<bool(Side)>& joined) {
  std::vector<Face> parent(mesh.n_faces());
  for (const Face f : faces) parent[f] = f;
  const auto root = [&](Face f) {
    while (parent[f] != f) f = parent[f];
    return f;
  };
  for (const Face f : faces) {
    for (const Side h : Mesh::sides(f)) {
      const Face g = mesh.face_across(h);
      if (g == none || parent[g] == none || g < f || !joined(h)) continue;
      const auto [low, high] = std::minmax({root(f), root(g)});
      parent[high] = low;
    }
  }
  std::map<Face, std::vector<Face>> by_root;
  for (const Face f : faces) by_root[root(f)].push_back(f);
  std::vector<std::vector<Face>> result;
  for (auto& [first, members] : by_root) result.push_back(std::move(members));
  return result;
}

bool on_segment(const Grid& p, const Grid& a, const Grid& b) {
  const auto within = [](Int x, Int u, Int v) { return std::min(u, v) <= x && x <= std::max(u, v); };
  return cross(a, b, p) == 0 && within(p.x, a.x, b.x) && within(p.y, a.y, b.y);
}

bool properly_cross(const Grid& a, const Grid& b, const Grid& c, const Grid& d) {
  const auto opposite = [](Int x, Int y) { return (x < 0 && y > 0) || (x > 0 && y < 0); };
  return opposite(cross(a, b, c), cross(a, b, d)) && opposite(cross(c, d, a), cross(c, d, b));
}

}  // namespace

std::vector<Face> inverted(const Mesh& mesh) {
  return Shadows(mesh).with_sign(-1);
}

std::vector<Face> flat(const Mesh& mesh) {
  return Shadows(mesh).with_sign(0);
}

std::vector<std::vector<Face>> inverted_components(const Mesh& mesh) {
  return classes(mesh, inverted(mesh), [](Side) { return true; });
}

std::vector<std::vector<Face>> conflict_pieces(const Mesh& mesh) {
  const Shadows shadows(mesh);
  const auto seeds = shadows.with_sign(-1);
  const auto is_conflicting = [&](Face f) {
    return std::any_of(seeds.begin(), seeds.end(),
                       [&](Face s) { return s == f || interiors_overlap(shadows[f], shadows[s]); });
  };
  std::vector<Face> conflict_set;
  for (const Face f : mesh.faces()) {
    if (is_conflicting(f)) conflict_set.push_back(f);
  }
  return classes(mesh, conflict_set, [&](Side h) {
    const Face left = Mesh::face_of(h), right = mesh.face_across(h);
    if (shadows[left].sign < 0 || shadows[right].sign < 0) return true;
    const Grid &a = shadows.place(mesh.from(h)), &b = shadows.place(mesh.to(h));
    return std::any_of(seeds.begin(), seeds.end(), [&](Face s) { return meets_interior(a, b, shadows[s]); });
  });
}

std::pair<Vertex, Vertex> coincident_vertices(const Mesh& mesh) {
  const Shadows shadows(mesh);
  std::map<Grid, Vertex> seen;
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    const auto [first, fresh] = seen.try_emplace(shadows.place(v), v);
    if (!fresh) return {first->second, v};
  }
  return {none, none};
}

bool constraints_touch(const Mesh& mesh) {
  const Shadows shadows(mesh);
  const auto constraints = mesh.constraints();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Grid &a = shadows.place(constraints[i].from), &b = shadows.place(constraints[i].to);
    for (const Vertex v : mesh.vertices()) {
      if (v == constraints[i].from || v == constraints[i].to || mesh.is_isolated(v)) continue;
      if (on_segment(shadows.place(v), a, b)) return true;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (properly_cross(a, b, shadows.place(constraints[j].from), shadows.place(constraints[j].to)))
        return true;
    }
  }
  return false;
}

}  // namespace kinemesh::oracle
