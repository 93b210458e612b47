// Random flips: after each the half-edges, the mirror and OpenMesh's own walks agree.
#include <gtest/gtest.h>

#include <set>

#include "core/build.h"
#include "core/validate.h"
#include "tests/core/flips.h"
#include "tests/core/sample_meshes.h"
#include "tests/core/snapshot.h"

namespace kinemesh::test {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

Mesh sample(std::uint64_t seed) {
  Random random(seed);
  auto data = seed % 2 ? u_shape(30, random) : random_square(40, random);
  for (const auto& t : data.triangles) data.labels.push_back(data.points[t[0]].x < 0.5 ? 1 : 2);
  return build_mesh(data, {.frame = seed % 3 ? 0.25 : 0.0});
}

void expect_openmesh_agrees(const Mesh& mesh) {
  const auto& topology = mesh.connectivity();
  std::vector<std::set<int>> around(mesh.n_vertices()), faces_at(mesh.n_vertices());
  for (int f = 0; f < mesh.n_faces(); ++f) {
    const auto& t = mesh.triangles()[f];
    for (int k = 0; k < 3; ++k) {
      faces_at[t[k]].insert(f);
      around[t[k]].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    int k = 0;  // OpenMesh starts where the face's half-edge ends
    for (auto v = topology.cfv_ccwiter(FaceHandle(f)); v.is_valid(); ++v)
      EXPECT_EQ(v->idx(), t[++k % 3]) << f;
    EXPECT_EQ(k, 3);
  }
  const std::set<int> hull(mesh.hull().begin(), mesh.hull().end());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    std::set<int> neighbours, faces;
    for (auto n = topology.cvv_iter(VertexHandle(v)); n.is_valid(); ++n) neighbours.insert(n->idx());
    for (auto f = topology.cvf_iter(VertexHandle(v)); f.is_valid(); ++f) faces.insert(f->idx());
    EXPECT_EQ(neighbours, around[v]) << v;
    EXPECT_EQ(faces, faces_at[v]) << v;
    EXPECT_EQ(topology.is_boundary(VertexHandle(v)), mesh.is_isolated(v) || hull.contains(v)) << v;
  }
}

TEST(Splice, KeepsHalfEdgesMirrorAndOpenMeshInStep) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh mesh = sample(seed);
    Random random(seed);
    for (int flip = 0; flip < 150; ++flip) {
      const int h = random.below(2 * mesh.n_edges());
      if (!can_flip(mesh, h)) continue;
      const int c = mesh.to(mesh.next(h)), d = mesh.to(mesh.next(Mesh::opposite(h)));
      mesh.splice(flip_of(mesh, h));
      EXPECT_EQ(mesh.from(h), c);
      EXPECT_EQ(mesh.to(h), d);
      const auto defect = validate_connectivity(mesh);
      ASSERT_FALSE(defect) << defect->message();
    }
    expect_openmesh_agrees(mesh);
  }
}

TEST(Splice, IsTakenBackByItsInverse) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh mesh = sample(seed);
    const auto before = snapshot_of(mesh);
    Random random(seed);
    std::vector<Patch> inverses;
    for (int flip = 0; flip < 50; ++flip) {
      const int h = random.below(2 * mesh.n_edges());
      if (!can_flip(mesh, h)) continue;
      const auto patch = flip_of(mesh, h);
      inverses.push_back(mesh.inverse_of(patch));
      mesh.splice(patch);
    }
    ASSERT_FALSE(inverses.empty());
    for (; !inverses.empty(); inverses.pop_back()) mesh.splice(inverses.back());
    auto after = snapshot_of(mesh);
    // Where a fan starts is no property of the mesh, but at the border.
    for (int v = 0; v < mesh.n_vertices(); ++v) EXPECT_EQ(mesh.from(after.outgoing[v]), v);
    after.outgoing = before.outgoing;
    EXPECT_TRUE(after == before);
  }
}

TEST(Splice, CountsFacesThatChangeSides) {
  Mesh mesh = build_mesh(four_triangles());
  const int h = mesh.halfedge_of(0);
  int inner = h;
  while (!can_flip(mesh, inner)) ++inner;
  auto patch = flip_of(mesh, inner);
  patch.labels = {padding_label, padding_label};
  mesh.splice(patch);
  EXPECT_EQ(mesh.n_user_faces(), 2);
  EXPECT_EQ(mesh.domain().n_faces(), 2);
}

}  // namespace
}  // namespace kinemesh::test
