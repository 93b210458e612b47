#include "kinemesh/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/parallel.h"
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

constexpr int grain = 16384;  // things to look at that are worth a task

// What `check` finds first among n things.
template <class Check>
Found first_among(int n, const Check& check) {
  const int first = find_first(n, grain, [&](int i) { return check(i).has_value(); });
  return first == none ? std::nullopt : check(first);
}

Found check_face(const Mesh& mesh, int f) {
  const auto sides = mesh.sides(f);
  for (int k = 0; k < 3; ++k) {
    const int h = sides[k], following = sides[(k + 1) % 3];
    const bool good = mesh.face_of(h) == f && mesh.next(h) == following && mesh.prev(following) == h &&
                      mesh.from(h) == mesh.triangles()[f][k] && mesh.to(h) == mesh.from(following);
    if (!good) return broken("half-edges and mirror differ at face " + number(f));
  }
  return std::nullopt;
}

Found check_faces(const Mesh& mesh) {
  return first_among(mesh.n_faces(), [&](int f) { return check_face(mesh, f); });
}

// The half-edges that leave a vertex form one cycle.
Found check_fan(const Mesh& mesh, int v, int degree) {
  if (mesh.is_isolated(v)) return std::nullopt;
  const int first = mesh.outgoing(v);
  int h = first, seen = 0;
  do {
    if (mesh.from(h) != v)
      return broken("a half-edge has strayed from vertex " + number(mesh.user_vertex(v)));
    h = mesh.next(Mesh::opposite(h));
    ++seen;
  } while (h != first && seen <= degree);
  if (seen == degree) return std::nullopt;
  return Defect{
      .kind = DefectKind::NotPlanar,
      .detail = "the faces around vertex " + number(mesh.user_vertex(v)) + " form more than one fan"};
}

Found check_fans(const Mesh& mesh) {
  std::vector<int> degree(mesh.n_vertices(), 0);
  for (int h = 0; h < 2 * mesh.n_edges(); ++h) ++degree[mesh.from(h)];
  return first_among(mesh.n_vertices(), [&](int v) { return check_fan(mesh, v, degree[v]); });
}

// Sets of faces that are joined across edges; the face of the lowest number stands for its set.
class Parts {
 public:
  explicit Parts(int n_faces) : count_(n_faces), parent_(n_faces) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int count() const { return count_; }
  void join(int f, int g) {
    const auto [low, high] = std::minmax({representative(f), representative(g)});
    if (low == high) return;
    parent_[high] = low;
    --count_;
  }

 private:
  int representative(int f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }

  int count_;
  std::vector<int> parent_;
};

bool is_connected(const Mesh& mesh) {
  Parts parts(mesh.n_faces());
  for (int e = 0; e < mesh.n_edges(); ++e) {
    const int f = mesh.face_of(2 * e), g = mesh.face_of(2 * e + 1);
    if (f != none && g != none) parts.join(f, g);
  }
  return parts.count() == 1;
}

// Connected, one border loop, Euler characteristic 1.
Found check_disc(const Mesh& mesh) {
  if (!is_connected(mesh))
    return Defect{.kind = DefectKind::NotPlanar, .detail = "the padded mesh is not connected"};
  int vertices = 0, outer = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v) vertices += !mesh.is_isolated(v);
  for (int h = 0; h < 2 * mesh.n_edges(); ++h) outer += mesh.face_of(h) == none;
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
  for (int u = 0; u < mesh.n_user_vertices(); ++u) {
    if (mesh.user_vertex(mesh.vertex_of_user(u)) != u)
      return broken("the numbering has lost vertex " + number(u));
  }
  if (static_cast<int>(mesh.faces_in_user_order().size()) != mesh.n_user_faces()) {
    return broken("the numbering has lost a face");
  }
  return std::nullopt;
}

int label_beside(const Mesh& mesh, int h) {
  const int f = mesh.face_of(h);
  return f == none ? padding_label : mesh.label(f);
}

// Each constraint is one edge with its labels, and no other edge lies between two labels.
Found check_constraints(const Mesh& mesh) {
  std::vector<int> edge_of(mesh.constraints().size(), none);
  for (int e = 0; e < mesh.n_edges(); ++e) {
    const int c = mesh.constraint_of(e);
    if (c != none)
      edge_of[c] = e;
    else if (label_beside(mesh, 2 * e) != label_beside(mesh, 2 * e + 1)) {
      return broken("two labels meet at an edge that is not constrained");
    }
  }
  for (std::size_t i = 0; i < edge_of.size(); ++i) {
    const auto& c = mesh.constraints()[i];
    const Edge ends{mesh.user_vertex(c.from), mesh.user_vertex(c.to)};
    const auto missing = [&](const char* why) {
      return Defect{
          .kind = DefectKind::MissingEdge, .edges = {ends}, .where = mesh.position(c.from), .detail = why};
    };
    if (edge_of[i] == none) return missing("");
    const int h = mesh.from(2 * edge_of[i]) == c.from ? 2 * edge_of[i] : 2 * edge_of[i] + 1;
    if (mesh.from(h) != c.from || mesh.to(h) != c.to) return missing("its place is taken");
    if (label_beside(mesh, h) != c.left || label_beside(mesh, Mesh::opposite(h)) != c.right) {
      return missing("its labels have changed");
    }
  }
  return std::nullopt;
}

Found check_finite(const Mesh& mesh) {
  return first_among(mesh.n_vertices(), [&](int v) -> Found {
    const Point& p = mesh.position(v);
    if (std::isfinite(p.x) && std::isfinite(p.y)) return std::nullopt;
    return Defect{.kind = DefectKind::NonFinitePosition, .vertices = {mesh.user_vertex(v)}};
  });
}

Found check_upright(const Mesh& mesh) {
  return first_among(mesh.n_faces(), [&](int f) -> Found {
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
  for (int f = 0; f < mesh.n_faces(); ++f) {
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
