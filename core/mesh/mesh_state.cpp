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

bool has_same_isolated(const Mesh& mesh, std::span<const int> outgoing) {
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.is_isolated(v) != (outgoing[v] == none)) return false;
  return true;
}

bool are_below(std::span<const Triangle> triples, int end) {
  return std::ranges::all_of(triples, [=](const Triangle& t) { return are_between(t, 0, end); });
}

// What keeps restoring within the mesh's arrays; validation sees to the rest.
void check(const Mesh& mesh, const MeshState& state) {
  const int n = mesh.n_vertices();
  require(has_size(state.positions, n) && has_size(state.outgoing, n) &&
              has_size(state.triangles, mesh.n_faces()) && has_size(state.sides, mesh.n_faces()) &&
              has_size(state.labels, mesh.n_faces()) && has_size(state.edge_constraints, mesh.n_edges()),
          "the state of a mesh of another size");
  require(has_same_isolated(mesh, state.outgoing) && are_between(state.outgoing, none, 2 * mesh.n_edges()) &&
              are_below(state.triangles, n) && are_below(state.sides, 2 * mesh.n_edges()) &&
              are_between(state.edge_constraints, none, static_cast<int>(mesh.constraints().size())),
          "the state of a mesh names what the mesh does not have");
}

// The patch that replaces every face.
Patch whole(const Mesh& mesh, const MeshState& state) {
  Patch patch{.faces = std::vector<int>(mesh.n_faces()),
              .triangles = state.triangles,
              .labels = state.labels,
              .halfedges = state.sides,
              .edges = std::vector<int>(mesh.n_edges()),
              .constraints = state.edge_constraints};
  std::iota(patch.faces.begin(), patch.faces.end(), 0);
  std::iota(patch.edges.begin(), patch.edges.end(), 0);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!mesh.is_isolated(v)) patch.outgoing.push_back({v, state.outgoing[v]});
  return patch;
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
                  .outgoing = collect(mesh.n_vertices(), [&](int v) { return mesh.outgoing(v); }),
                  .triangles = {mesh.triangles().begin(), mesh.triangles().end()},
                  .sides = std::vector<Triangle>(mesh.n_faces()),
                  .labels = collect(mesh.n_faces(), [&](int f) { return mesh.label(f); }),
                  .edge_constraints = collect(mesh.n_edges(), [&](int e) { return mesh.constraint_of(e); })};
  for (int f = 0; f < mesh.n_faces(); ++f) state.sides[f] = mesh.sides(f);
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
  mesh.splice(whole(mesh, state));
  std::ranges::copy(state.positions, mesh.positions().begin());
  if (const auto defect = validate_connectivity(mesh)) throw InputError(defect->message());
}

}  // namespace kinemesh
