// Random flips, as patches and as such: after each the half-edges, the mirror and OpenMesh's own walks agree.
#include <gtest/gtest.h>

#include <set>

#include "kinemesh/build.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/flips.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"

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
      const int c = mesh.apex(h), d = mesh.to(mesh.next(Mesh::opposite(h)));
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
    EXPECT_TRUE(snapshot_of(mesh) == before);
  }
}

TEST(Flip, DoesWhatItsPatchDoes) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh flipped = sample(seed), spliced = flipped;
    Random random(seed);
    int flips = 0;
    for (int i = 0; i < 150; ++i) {
      const int edge = random.below(flipped.n_edges());
      if (!can_flip(flipped, 2 * edge)) continue;
      ASSERT_TRUE(flipped.is_flippable(edge));
      spliced.splice(flip_of(spliced, 2 * edge));
      flipped.flip(edge);
      ASSERT_TRUE(snapshot_of(flipped) == snapshot_of(spliced));
      ++flips;
    }
    EXPECT_GT(flips, 10);
    const auto defect = validate_connectivity(flipped);
    EXPECT_FALSE(defect) << defect->message();
    EXPECT_EQ(flipped.domain().triangles, spliced.domain().triangles);
  }
}

// Four times the same edge: back to where it was, but for where faces start.
TEST(Flip, IsUndoneByThreeMore) {
  Mesh mesh = sample(1);
  int edge = 0;
  while (!can_flip(mesh, 2 * edge)) ++edge;
  const auto ends = [&] { return std::pair(mesh.from(2 * edge), mesh.to(2 * edge)); };
  const auto first = ends();
  mesh.flip(edge);
  EXPECT_NE(ends(), first);
  mesh.flip(edge);
  EXPECT_EQ(ends(), std::pair(first.second, first.first));
  mesh.flip(edge);
  mesh.flip(edge);
  EXPECT_EQ(ends(), first);
}

TEST(Flip, IsNotForConstrainedEdgesAndTheBorder) {
  const Mesh mesh = sample(2);  // labels, a frame
  int constrained = 0, outer = 0, flippable = 0;
  for (int edge = 0; edge < mesh.n_edges(); ++edge) {
    const int left = mesh.face_of(2 * edge), right = mesh.face_of(2 * edge + 1);
    constrained += mesh.constraint_of(edge) != none;
    outer += left == none || right == none;
    if (!mesh.is_flippable(edge)) continue;
    ++flippable;
    EXPECT_EQ(mesh.label(left), mesh.label(right));
    EXPECT_EQ(mesh.constraint_of(edge), none);
  }
  EXPECT_GT(constrained, 0);
  EXPECT_EQ(outer, 4);
  EXPECT_EQ(flippable + constrained + outer, mesh.n_edges());
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
