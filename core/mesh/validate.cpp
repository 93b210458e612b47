#include "kinemesh/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/mesh/around.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using Found = std::optional<Defect>;

Found broken(std::string detail) {
  return Defect{.kind = DefectKind::Connectivity, .detail = std::move(detail)};
}

std::string number(int i) {
  return std::to_string(i);
}

// What `check` finds first among them.
template <class Number, class Check>
Found first_among(Numbers<Number> all, const Check& check) {
  const int first = find_first(all.size(), grain::items, [&](int i) { return check(Number(i)).has_value(); });
  return first == none ? std::nullopt : check(Number(first));
}

Found check_face(const Mesh& mesh, Face f) {
  for (const Side side : Mesh::sides(f)) {
    const Side across = mesh.opposite(side);
    if (across == none) continue;
    const bool good = mesh.opposite(across) == side && mesh.from(across) == mesh.to(side) &&
                      mesh.to(across) == mesh.from(side) && across != side;
    if (!good) return broken("the sides of an edge differ at face " + number(f));
  }
  return std::nullopt;
}

Found check_faces(const Mesh& mesh) {
  return first_among(mesh.faces(), [&](Face f) { return check_face(mesh, f); });
}

// The sides that start at a vertex form one fan.
Found check_fan(const Mesh& mesh, Vertex v, int degree) {
  if (mesh.is_isolated(v)) return degree == 0 ? std::nullopt : broken("a side has lost its vertex");
  int seen = 0;
  bool has_strayed = false;
  for_each_side_from(mesh, v, [&](Side side) {
    has_strayed |= mesh.from(side) != v;
    ++seen;
  });
  if (has_strayed) return broken("a side has strayed from vertex " + number(mesh.user_vertex(v)));
  if (seen == degree) return std::nullopt;
  return Defect{
      .kind = DefectKind::NotPlanar,
      .detail = "the faces around vertex " + number(mesh.user_vertex(v)) + " form more than one fan"};
}

// After check_faces: each side has at most one before it and one behind it around its vertex, so that going
// around ends.
Found check_fans(const Mesh& mesh) {
  std::vector<int> degree(mesh.n_vertices(), 0);
  for (const MeshTriangle& corners : mesh.triangles())
    for (const Vertex v : corners) ++degree[v];
  return first_among(mesh.vertices(), [&](Vertex v) { return check_fan(mesh, v, degree[v]); });
}

bool is_connected(const Mesh& mesh) {
  DisjointSets parts(mesh.n_faces());  // faces that are joined across edges
  for (const Face f : mesh.faces())
    for (const Side side : Mesh::sides(f))
      if (const Face g = mesh.face_across(side); g > f) parts.join(f, g);
  return parts.count() == 1;
}

// Connected, one border loop, Euler characteristic 1.
Found check_disc(const Mesh& mesh) {
  if (!is_connected(mesh))
    return Defect{.kind = DefectKind::NotPlanar, .detail = "the padded mesh is not connected"};
  int vertices = 0, outer = 0;
  for (const Vertex v : mesh.vertices()) vertices += !mesh.is_isolated(v);
  for (const Face f : mesh.faces())
    for (const Side side : Mesh::sides(f)) outer += mesh.opposite(side) == none;
  if (outer != static_cast<int>(mesh.hull().size())) {
    return Defect{.kind = DefectKind::NotPlanar, .detail = "the padded mesh has more than one border loop"};
  }
  const int euler = vertices - mesh.n_edges() + mesh.n_faces();
  if (euler == 1) return std::nullopt;
  return Defect{.kind = DefectKind::NotPlanar,
                .detail = "vertices - edges + faces of the padded mesh is " + number(euler) +
                          ", not 1: it has handles"};
}

Found check_numbering(const Mesh& mesh) {
  for (const UserVertex u : Numbers<UserVertex>(mesh.n_user_vertices())) {
    if (mesh.user_vertex(mesh.vertex_of_user(u)) != u)
      return broken("the numbering has lost vertex " + number(u));
  }
  if (static_cast<int>(mesh.faces_in_user_order().size()) != mesh.n_user_faces()) {
    return broken("the numbering has lost a face");
  }
  return std::nullopt;
}

int label_beside(const Mesh& mesh, Side side) {
  return side == none ? padding_label : mesh.label(Mesh::face_of(side));
}

// Each constraint is one edge with its labels, and no other edge lies between two labels.
Found check_constraints(const Mesh& mesh) {
  std::vector<Side> side_of(mesh.constraints().size());
  for (const Face f : mesh.faces()) {
    for (const Side side : Mesh::sides(f)) {
      const Side across = mesh.opposite(side);
      if (mesh.has_constraint(side)) {
        if (across != none && !mesh.has_constraint(across))
          return broken("an edge is constrained on one side only");
        const int number = mesh.constraint_of(side);
        if (number == none) return broken("a constrained edge has no constraint");
        side_of[number] = side;
      } else if (label_beside(mesh, side) != label_beside(mesh, across)) {
        return broken("two labels meet at an edge that is not constrained");
      }
    }
  }
  for (std::size_t i = 0; i < side_of.size(); ++i) {
    const auto& c = mesh.constraints()[i];
    const UserEdge ends{mesh.user_vertex(c.from), mesh.user_vertex(c.to)};
    const auto missing = [&](const char* why) {
      return Defect{
          .kind = DefectKind::MissingEdge, .edges = {ends}, .where = mesh.position(c.from), .detail = why};
    };
    const Side side = side_of[i];
    if (side == none) return missing("");
    const bool is_along = mesh.from(side) == c.from && mesh.to(side) == c.to;
    if (!is_along && (mesh.from(side) != c.to || mesh.to(side) != c.from))
      return missing("its place is taken");
    const Side left = is_along ? side : mesh.opposite(side), right = is_along ? mesh.opposite(side) : side;
    if (label_beside(mesh, left) != c.left || label_beside(mesh, right) != c.right)
      return missing("its labels have changed");
  }
  return std::nullopt;
}

Found check_finite(const Mesh& mesh) {
  return first_among(mesh.vertices(), [&](Vertex v) -> Found {
    const Point& p = mesh.position(v);
    if (is_finite(p)) return std::nullopt;
    return Defect{.kind = DefectKind::NonFinitePosition, .vertices = {mesh.user_vertex(v)}};
  });
}

Found check_upright(const Mesh& mesh) {
  return first_among(mesh.faces(), [&](Face f) -> Found {
    const auto [a, b, c] = mesh.corners(f);
    const auto turn = orientation(a, b, c);
    if (turn == Orientation::CounterClockwise) return std::nullopt;
    const auto& t = mesh.triangles()[f];
    return Defect{.kind = turn == Orientation::Collinear ? DefectKind::FlatFace : DefectKind::InvertedFace,
                  .vertices = {mesh.user_vertex(t[0]), mesh.user_vertex(t[1]), mesh.user_vertex(t[2])},
                  .faces = {mesh.user_face(f)},
                  .where = a};
  });
}

// Turns left everywhere and goes around once: the sense along x changes twice.
Found check_hull(const Mesh& mesh) {
  const auto hull = mesh.hull();
  const auto at = [&](std::size_t i) { return mesh.position(hull[i % hull.size()]); };
  int changes = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = at(i), b = at(i + 1), c = at(i + 2);
    const bool folds = orientation(a, b, c) == Orientation::Collinear && !on_segment(b, a, c);
    if (orientation(a, b, c) == Orientation::Clockwise || folds) {
      return Defect{.kind = DefectKind::HullMoved,
                    .vertices = {mesh.user_vertex(hull[(i + 1) % hull.size()])},
                    .where = b,
                    .detail = "the border of the padded mesh is not convex"};
    }
    const auto upper = [](const Point& p, const Point& q) {
      return std::pair(p.x, p.y) < std::pair(q.x, q.y);
    };
    changes += upper(a, b) != upper(b, c);
  }
  if (changes == 2) return std::nullopt;
  return Defect{.kind = DefectKind::HullMoved,
                .detail = "the border of the padded mesh goes around more than once"};
}

// A sum of areas, and of the sizes of the products in it, which bound its rounding error. long double:
// neither overflows.
struct AreaSum {
  long double area = 0, size = 0;

  void add(const Point& origin, const Point& a, const Point& b) {
    using Wide = glm::vec<2, long double>;
    const Wide o(origin), u = Wide(a) - o, v = Wide(b) - o;
    const long double l = 0.5L * u.x * v.y, r = 0.5L * u.y * v.x;
    area += l - r;
    size += std::abs(l) + std::abs(r);
  }
};

// With every face upright the areas can only add up if nothing overlaps and nothing is missing.
Found check_coverage(const Mesh& mesh) {
  const Point origin = mesh.position(mesh.hull()[0]);
  AreaSum faces, border;
  for (const Face f : mesh.faces()) {
    const auto [a, b, c] = mesh.corners(f);
    if (!mesh.is_padding(f)) faces.add(a, b, c);
  }
  for (const auto& c : mesh.constraints()) {
    if (c.is_border()) border.add(origin, mesh.position(c.from), mesh.position(c.to));
  }
  if (std::abs(faces.area - border.area) <= 1e-12L * (faces.size + border.size)) return std::nullopt;
  return Defect{.kind = DefectKind::Coverage,
                .detail = fmt::format("{} against {}", faces.area, border.area)};
}

template <class... Checks>
Found first_of(const Mesh& mesh, Checks... checks) {
  Found found;
  static_cast<void>(((found = checks(mesh), found.has_value()) || ...));
  return found;
}

}  // namespace

std::optional<Defect> validate_connectivity(const Mesh& mesh) {
  Found first, disc, last;
  parallel_pair([&] { disc = check_disc(mesh); },
                [&] {
                  first = first_of(mesh, check_faces, check_fans);
                  if (!first) last = first_of(mesh, check_numbering, check_constraints);
                });
  return first ? first : disc ? disc : last;
}

std::optional<Defect> validate(const Mesh& mesh) {
  return first_of(mesh, validate_connectivity, check_finite, check_upright, check_hull, check_coverage);
}

}  // namespace kinemesh
