#include "core/mesh/mesh_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/ascending.h"
#include "core/base/parallel.h"
#include "core/mesh/sides.h"
#include "kinemesh/validate.h"

namespace kinemesh {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw InputError(what);
}

template <class Items>
bool has_size(const Items& items, std::size_t n) {
  return items.size() == n;
}

bool are_between(std::span<const int> numbers, int first, int end) {
  return std::ranges::all_of(numbers, [=](int i) { return first <= i && i < end; });
}

Side renumbered(Side side, std::span<const int> faces) {
  return Mesh::side(Face(faces[Mesh::face_of(side)]), Mesh::corner_of(side));
}

void turn(std::vector<ListedConstraint>& constraints, std::span<const int> turned) {
  for (const int i : turned) {
    std::swap(constraints[i].from, constraints[i].to);
    std::swap(constraints[i].left, constraints[i].right);
  }
}

}  // namespace

// The only one who looks into a mesh that is there, and puts one together that was not built.
class MeshParts {
 public:
  MeshParts(const MeshBase& base, const MeshState& state) : base_(base), state_(state) {}

  static MeshBase base_of(const Mesh& mesh);
  static Side side_of(const Mesh& mesh, int constraint) { return mesh.side_of_constraint_[constraint]; }

  Mesh restore() {
    check();
    place_vertices();
    place_faces();
    connect();
    constrain();
    if (const auto defect = validate_connectivity(mesh_)) throw InputError(defect->message());
    return std::move(mesh_);
  }

 private:
  static MeshOrder order_of(const Mesh& mesh);

  int n_vertices() const { return static_cast<int>(state_.positions.size()); }
  int n_faces() const { return static_cast<int>(state_.triangles.size()); }
  int n_user_vertices() const { return n_vertices() - (base_.frame > 0.0 ? 4 : 0); }
  bool is_side(int number) const {
    const Side side(number);
    return side >= 0 && Mesh::face_of(side) < n_faces() && Mesh::corner_of(side) < 3;
  }

  void check() const;
  void check_sizes() const;
  void check_order() const;
  void check_vertices() const;
  void check_faces() const;
  void check_constraints() const;
  void check_markers() const;
  void place_vertices();
  void place_faces();
  void connect();
  void check_frame() const;
  void constrain();

  const MeshBase& base_;
  const MeshState& state_;
  std::vector<Triangle> triangles_;  // in the mesh's order and numbers
  Mesh mesh_;
};

MeshOrder MeshParts::order_of(const Mesh& mesh) {
  MeshOrder order{{mesh.vertex_of_user_.begin(), mesh.vertex_of_user_.end()},
                  inverse({mesh.user_face_.begin(), mesh.user_face_.end()}),
                  {},
                  {}};
  order.vertices.insert(order.vertices.end(), mesh.frame_.begin(), mesh.frame_.end());
  const auto numbers = inverse(order.vertices);
  const auto ends = [&](int i) {
    const Constraint& c = mesh.constraints()[i];
    return ascending(Edge{numbers[c.from], numbers[c.to]});
  };
  order.constraints.resize(mesh.constraints().size());
  std::iota(order.constraints.begin(), order.constraints.end(), 0);
  std::ranges::sort(order.constraints, {}, [&](int i) { return std::pair(ends(i), i); });
  for (std::size_t i = 0; i < order.constraints.size(); ++i) {
    const int number = order.constraints[i];
    if (numbers[mesh.constraints()[number].from] != ends(number)[0])
      order.turned.push_back(static_cast<int>(i));
  }
  return order;
}

MeshBase MeshParts::base_of(const Mesh& mesh) {
  MeshOrder order = order_of(mesh);
  MeshBase base{.frame = mesh.frame_margin(),
                .fixed = {},
                .home = in_user_order(mesh.home_label_, order.vertices),
                .constraints = {},
                .markers = mesh.markers(),
                .label_names = mesh.label_names_,
                .order = std::move(order)};
  for (const UserVertex u : Numbers<UserVertex>(mesh.n_user_vertices()))
    if (mesh.is_fixed(mesh.vertex_of_user(u))) base.fixed.push_back(u);
  const auto numbers = inverse(base.order.vertices);
  for (const int i : base.order.constraints) {
    const Constraint& c = mesh.constraints()[i];
    base.constraints.push_back({numbers[c.from], numbers[c.to], c.left, c.right, c.marker});
  }
  turn(base.constraints, base.order.turned);
  return base;
}

// So that all that follows stays within the arrays; validation sees to the rest.
void MeshParts::check() const {
  check_sizes();
  check_order();
  check_vertices();
  check_faces();
  check_constraints();
  check_markers();
}

void MeshParts::check_sizes() const {
  check_size(state_.positions.size(), "vertices");
  check_size(state_.triangles.size(), "faces");
  require(base_.frame >= 0.0 && std::isfinite(base_.frame), "a frame with a margin that none has");
  require(n_user_vertices() >= 3, "a mesh with fewer than three vertices");
  const auto n_constraints = base_.constraints.size();
  require(has_size(base_.home, state_.positions.size()) && has_size(state_.labels, state_.triangles.size()) &&
              has_size(state_.constraint_sides, n_constraints) &&
              has_size(base_.order.vertices, state_.positions.size()) &&
              has_size(base_.order.faces, state_.triangles.size()) &&
              has_size(base_.order.constraints, n_constraints),
          "parts of meshes of different sizes");
}

void MeshParts::check_order() const {
  require_permutation(base_.order.vertices);
  require_permutation(base_.order.faces);
  require_permutation(base_.order.constraints);
  require(are_between(base_.order.turned, 0, static_cast<int>(base_.constraints.size())),
          "a constrained edge turned that the mesh does not have");
}

void MeshParts::check_vertices() const {
  require(are_between(base_.fixed, 0, n_user_vertices()), "a fixed vertex that the mesh does not have");
}

void MeshParts::check_faces() const {
  for (const auto& t : state_.triangles) {
    require(are_between(t, 0, n_vertices()), "a face with a corner that the mesh does not have");
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "a face with one vertex at two corners");
  }
  require(std::ranges::any_of(state_.labels, [](int label) { return label != padding_label; }),
          "a mesh that is nothing but padding");
  for (const auto& [first, second] : state_.doubled)
    require(is_side(first) && is_side(second), "a side that the mesh does not have");
}

void MeshParts::check_constraints() const {
  const int n_markers = static_cast<int>(base_.markers.size());
  for (const ListedConstraint& c : base_.constraints)
    require(c.from >= 0 && c.from < n_vertices() && c.to >= 0 && c.to < n_vertices() && c.from != c.to &&
                c.marker >= none && c.marker < n_markers,
            "a constrained edge with an end or a marker that the mesh does not have");
  require(std::ranges::all_of(state_.constraint_sides, [this](int side) { return is_side(side); }),
          "a constrained side that the mesh does not have");
}

// Their edges are the user's, and constrained.
void MeshParts::check_markers() const {
  std::vector<Edge> constrained;
  for (const ListedConstraint& c : base_.constraints) constrained.push_back(ascending(Edge{c.from, c.to}));
  std::ranges::sort(constrained);
  for (const Marker& marker : base_.markers)
    for (const Edge& edge : marker.edges)
      require(
          are_between(edge, 0, n_user_vertices()) && std::ranges::binary_search(constrained, ascending(edge)),
          "a marker of an edge that is not constrained");
}

void MeshParts::place_vertices() {
  const auto& places = base_.order.vertices;
  const int n = n_vertices(), n_user = n_user_vertices();
  mesh_.n_user_vertices_ = n_user;
  mesh_.frame_margin_ = base_.frame;
  mesh_.positions_ = in_mesh_order(state_.positions, places);
  mesh_.home_label_ = in_mesh_order(base_.home, places);
  mesh_.user_vertex_.resize(n);
  for (int u = 0; u < n; ++u) {
    (u < n_user ? mesh_.vertex_of_user_ : mesh_.frame_).emplace_back(places[u]);
    mesh_.user_vertex_[places[u]] = u < n_user ? UserVertex(u) : none;
  }
  mesh_.fixed_.assign(n, false);
  for (const int v : base_.fixed) mesh_.fixed_[places[v]] = true;
}

void MeshParts::place_faces() {
  const auto& places = base_.order.faces;
  mesh_.user_face_.resize(places.size());
  for (std::size_t f = 0; f < places.size(); ++f) mesh_.user_face_[places[f]] = UserFace(static_cast<int>(f));
  mesh_.labels_ = in_mesh_order(state_.labels, places);
  triangles_ = in_mesh_order(state_.triangles, places);
  for (Triangle& t : triangles_) {
    for (int& v : t) v = base_.order.vertices[v];
    mesh_.triangles_.push_back(mesh_triangle(t));
  }
  mesh_.n_user_faces_ = n_faces() - static_cast<int>(std::ranges::count(mesh_.labels_, padding_label));
}

void MeshParts::connect() {
  auto opposite = pair_sides(triangles_, n_vertices()).opposite;
  const auto pair_of_side = [&](int number) {
    const Side side(number);
    return 3 * base_.order.faces[Mesh::face_of(side)] + Mesh::corner_of(side);
  };
  for (const auto& [first, second] : state_.doubled) {
    opposite[pair_of_side(first)] = pair_of_side(second);
    opposite[pair_of_side(second)] = pair_of_side(first);
  }
  mesh_.connect(opposite);
  require(!mesh_.hull_.empty(), "a mesh without a border");
  if (!mesh_.frame_.empty()) check_frame();
}

void MeshParts::check_frame() const {
  auto corners = mesh_.frame_;
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  require(corners == mesh_.hull_, "a frame that is not the border of its mesh");
}

void MeshParts::constrain() {
  const auto& order = base_.order;
  mesh_.markers_ = base_.markers;
  for (const Marker& marker : base_.markers) mesh_.marker_names_.push_back(marker.name);
  mesh_.label_names_ = base_.label_names;
  auto constraints = base_.constraints;
  turn(constraints, order.turned);
  mesh_.constraints_.resize(constraints.size());
  mesh_.on_constraint_.assign(n_vertices(), false);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto& [a, b, left, right, marker] = constraints[i];
    const Vertex from(order.vertices[a]), to(order.vertices[b]);
    mesh_.constraints_[order.constraints[i]] = {from, to, left, right, marker};
    mesh_.on_constraint_[from] = mesh_.on_constraint_[to] = true;
  }
  mesh_.side_of_constraint_.resize(mesh_.constraints_.size());
  mesh_.constraint_at_.reset(mesh_.constraints_.size());
  for (std::size_t i = 0; i < order.constraints.size(); ++i) {
    const int number = order.constraints[i];
    const Side side = renumbered(Side(state_.constraint_sides[i]), order.faces);
    require(!mesh_.has_constraint(side), "an edge that is constrained twice");
    mesh_.link(side, mesh_.word(side) | 1);
    mesh_.remember_constraint(number, side);
  }
}

MeshBase base_of(const Mesh& mesh) {
  return MeshParts::base_of(mesh);
}

MeshState state_of(const Mesh& mesh, const MeshOrder& order) {
  const int n_faces = mesh.n_faces();
  const auto vertices = inverse(order.vertices), faces = inverse(order.faces);
  MeshState state{.positions = std::vector<Point>(mesh.n_vertices()),
                  .triangles = std::vector<Triangle>(n_faces),
                  .labels = std::vector<int>(n_faces),
                  .constraint_sides = {},
                  .doubled = {}};
  parallel_parts(mesh.n_vertices(), grain::items, [&](int, int begin, int end) {
    for (int v = begin; v < end; ++v) state.positions[v] = mesh.position(Vertex(order.vertices[v]));
  });
  parallel_parts(n_faces, grain::items, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) {
      const Face face(order.faces[f]);
      const auto& [a, b, c] = mesh.triangles()[face];
      state.triangles[f] = {vertices[a], vertices[b], vertices[c]};
      state.labels[f] = mesh.label(face);
    }
  });
  const auto by_ends = pair_sides(state.triangles, mesh.n_vertices()).opposite;
  for (int f = 0; f < n_faces; ++f) {
    for (int k = 0; k < 3; ++k) {
      const Side across = mesh.opposite(Mesh::side(Face(order.faces[f]), k));
      if (across == none) continue;
      const Side one = Mesh::side(Face(f), k), other = renumbered(across, faces);
      if (one < other && side_of_pair(by_ends[3 * f + k]) != other) state.doubled.push_back({one, other});
    }
  }
  std::ranges::sort(state.doubled);
  for (const int i : order.constraints) {
    const Side side = MeshParts::side_of(mesh, i), across = mesh.opposite(side);
    const Side one = renumbered(side, faces);
    state.constraint_sides.push_back(across == none ? one : std::min(one, renumbered(across, faces)));
  }
  return state;
}

Mesh restore(const MeshBase& base, const MeshState& state) {
  return MeshParts(base, state).restore();
}

void require_permutation(const std::vector<int>& order) {
  std::vector<char> is_there(order.size(), false);
  for (const int i : order) {
    require(i >= 0 && i < static_cast<int>(order.size()) && !is_there[i], "an order that is no permutation");
    is_there[i] = true;
  }
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<int>(i);
  return places;
}

}  // namespace kinemesh
