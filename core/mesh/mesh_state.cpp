#include "core/mesh/mesh_state.h"

#include <algorithm>
#include <numeric>

#include "kinemesh/validate.h"

namespace kinemesh {
namespace {

template <class Value>
std::vector<int> collect(int n, const Value& value) {
  std::vector<int> values(n);
  for (int i = 0; i < n; ++i) values[i] = value(i);
  return values;
}

std::vector<int> user_vertices_of(const Mesh& mesh) {
  return collect(mesh.n_vertices(), [&](int v) { return mesh.user_vertex(v); });
}

std::vector<int> user_faces_of(const Mesh& mesh) {
  return collect(mesh.n_faces(), [&](int f) { return mesh.user_face(f); });
}

void require(bool condition, const char* what) {
  if (!condition) throw InputError(what);
}

template <class Items>
bool has_size(const Items& items, int n) {
  return items.size() == static_cast<std::size_t>(n);
}

bool are_between(std::span<const int> numbers, int first, int end) {
  return std::ranges::all_of(numbers, [=](int i) { return first <= i && i < end; });
}

bool are_below(std::span<const Triangle> triples, int end) {
  return std::ranges::all_of(triples, [=](const Triangle& t) { return are_between(t, 0, end); });
}

bool has_same_vertices(const Mesh& mesh, std::span<const Triangle> triangles) {
  std::vector<char> is_used(mesh.n_vertices(), false);
  for (const Triangle& corners : triangles)
    for (const int v : corners) is_used[v] = true;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.is_isolated(v) == is_used[v]) return false;
  return true;
}

// Of a face there is, not the fourth.
bool is_side(const Mesh& mesh, int side) {
  return side >= 0 && Mesh::face_of(side) < mesh.n_faces() && Mesh::corner_of(side) < 3;
}

bool are_sides_or_none(const Mesh& mesh, std::span<const Triangle> triples) {
  return std::ranges::all_of(triples, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](int side) { return side == none || is_side(mesh, side); });
  });
}

// What keeps restoring within the mesh's arrays; validation sees to the rest.
void check(const Mesh& mesh, const MeshState& state) {
  const int n = mesh.n_vertices();
  require(has_size(state.positions, n) && has_size(state.triangles, mesh.n_faces()) &&
              has_size(state.across, mesh.n_faces()) && has_size(state.labels, mesh.n_faces()) &&
              state.constraint_sides.size() == mesh.constraints().size(),
          "the state of a mesh of another size");
  auto lines = state.constraint_sides;
  std::ranges::sort(lines);
  require(are_below(state.triangles, n) && has_same_vertices(mesh, state.triangles) &&
              are_sides_or_none(mesh, state.across) &&
              std::ranges::all_of(lines, [&](int side) { return is_side(mesh, side); }) &&
              std::ranges::adjacent_find(lines) == lines.end(),
          "the state of a mesh names what the mesh does not have");
}

// All faces as they are to be.
std::vector<FaceState> faces_of(const Mesh& mesh, const MeshState& state) {
  std::vector<FaceState> faces(mesh.n_faces());
  for (int f = 0; f < mesh.n_faces(); ++f) {
    faces[f] = {f, state.labels[f], state.triangles[f], state.across[f], {none, none, none}};
    for (int& word : faces[f].across) word *= 2;
  }
  const auto constrain = [&](int side, int number) {
    auto& face = faces[Mesh::face_of(side)];
    face.across[Mesh::corner_of(side)] |= 1;
    face.constraints[Mesh::corner_of(side)] = number;
  };
  for (std::size_t i = 0; i < state.constraint_sides.size(); ++i) {
    const int side = state.constraint_sides[i];
    const int across = state.across[Mesh::face_of(side)][Mesh::corner_of(side)];
    constrain(side, static_cast<int>(i));
    if (across != none) constrain(across, static_cast<int>(i));
  }
  return faces;
}

}  // namespace

MeshOrigin origin_of(const Mesh& mesh) {
  MeshOrigin origin{.data = mesh.domain(),
                    .frame = mesh.frame_margin(),
                    .fixed = {},
                    .user_vertices = user_vertices_of(mesh),
                    .user_faces = user_faces_of(mesh)};
  for (int u = 0; u < mesh.n_user_vertices(); ++u)
    if (mesh.is_fixed(mesh.vertex_of_user(u))) origin.fixed.push_back(u);
  return origin;
}

MeshState state_of(const Mesh& mesh) {
  MeshState state{.positions = {mesh.positions().begin(), mesh.positions().end()},
                  .triangles = {mesh.triangles().begin(), mesh.triangles().end()},
                  .across = std::vector<Triangle>(mesh.n_faces()),
                  .labels = collect(mesh.n_faces(), [&](int f) { return mesh.label(f); }),
                  .constraint_sides = std::vector<int>(mesh.constraints().size())};
  for (int f = 0; f < mesh.n_faces(); ++f) {
    for (const int side : Mesh::sides(f)) {
      state.across[f][Mesh::corner_of(side)] = mesh.opposite(side);
      if (mesh.has_constraint(side) && mesh.is_lower(side))
        state.constraint_sides[mesh.constraint_of(side)] = side;
    }
  }
  return state;
}

Mesh rebuild(const MeshOrigin& origin) {
  Mesh mesh = build_mesh(origin.data, {.frame = origin.frame, .fixed = origin.fixed});
  require(user_vertices_of(mesh) == origin.user_vertices && user_faces_of(mesh) == origin.user_faces,
          "this build of the program numbers the mesh in another way than the one that wrote it");
  return mesh;
}

void restore(Mesh& mesh, const MeshState& state) {
  check(mesh, state);
  mesh.restore(faces_of(mesh, state));
  std::ranges::copy(state.positions, mesh.positions().begin());
  if (const auto defect = validate_connectivity(mesh)) throw InputError(defect->message());
}

}  // namespace kinemesh
