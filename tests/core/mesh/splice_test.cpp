// Random flips, as patches and as such: afterwards the corner table and OpenMesh's own walks agree.
#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <map>
#include <set>

#include "core/mesh/around.h"
#include "kinemesh/build.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/flips.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"

namespace kinemesh::test {
namespace {

Mesh sample(std::uint64_t seed) {
  Random random(seed);
  auto data = seed % 2 ? u_shape(30, random) : random_square(40, random);
  for (const auto& t : data.triangles) data.labels.push_back(data.points[t[0]].x < 0.5 ? 1 : 2);
  return build_mesh(data, {.frame = seed % 3 ? 0.25 : 0.0});
}

// Turns a cycle so that it starts as the other does.
void turn_to_front(std::vector<int>& cycle, const std::vector<int>& like) {
  if (like.empty()) return;
  std::rotate(cycle.begin(), std::ranges::find(cycle, like.front()), cycle.end());
}

using OpenMeshCopy = OpenMesh::TriMesh_ArrayKernelT<>;

OpenMeshCopy copy_of(const Mesh& mesh) {
  OpenMeshCopy copy;
  for (const Point& p : mesh.positions())
    copy.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), 0.0f});
  for (const auto& [a, b, c] : mesh.triangles())
    copy.add_face(OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b), OpenMesh::VertexHandle(c));
  return copy;
}

// OpenMesh finds from the corners alone who is beside whom, and walks around vertices in its own way.
void expect_openmesh_agrees(const Mesh& mesh) {
  const OpenMeshCopy copy = copy_of(mesh);
  ASSERT_EQ(static_cast<int>(copy.n_faces()), mesh.n_faces());
  ASSERT_EQ(static_cast<int>(copy.n_edges()), mesh.n_edges());
  for (const Vertex v : mesh.vertices()) {
    const OpenMesh::VertexHandle vertex(v);
    std::vector<int> neighbours, faces, theirs, their_faces;
    for_each_neighbour(mesh, v, [&](Vertex w, Side) { neighbours.push_back(w); });
    for_each_side_from(mesh, v, [&](Side side) { faces.push_back(Mesh::face_of(side)); });
    for (auto w = copy.cvv_ccwiter(vertex); w.is_valid(); ++w) theirs.push_back(w->idx());
    for (auto f = copy.cvf_ccwiter(vertex); f.is_valid(); ++f) their_faces.push_back(f->idx());
    turn_to_front(theirs, neighbours);
    turn_to_front(their_faces, faces);
    EXPECT_EQ(neighbours, theirs) << v;
    EXPECT_EQ(faces, their_faces) << v;
    std::set<int> spokes;
    for (Spokes s(mesh, v); !s.is_done(); s.advance()) spokes.insert(s.end());
    EXPECT_EQ(spokes, std::set(theirs.begin(), theirs.end())) << v;
  }
  for (const Face f : mesh.faces()) {
    for (const Side side : Mesh::sides(f)) {
      const auto h =
          copy.find_halfedge(OpenMesh::VertexHandle(mesh.from(side)), OpenMesh::VertexHandle(mesh.to(side)));
      EXPECT_EQ(copy.face_handle(h).idx(), f);
      EXPECT_EQ(copy.opposite_face_handle(h).idx(), mesh.face_across(side));
    }
  }
}

TEST(Splice, AgreesWithOpenMesh) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh mesh = sample(seed);
    Random random(seed);
    for (int flip = 0; flip < 150; ++flip) {
      const Side side = random_edge(mesh, random);
      if (!can_flip(mesh, side)) continue;
      const Vertex c = mesh.apex(side), d = mesh.apex(mesh.opposite(side));
      auto patch = flip_of(mesh, side);
      mesh.splice(patch);
      const Side turned = Mesh::side(patch.faces[0], 2);
      EXPECT_EQ(mesh.from(turned), c);
      EXPECT_EQ(mesh.to(turned), d);
      const auto defect = validate_connectivity(mesh);
      ASSERT_FALSE(defect) << defect->message();
    }
    expect_openmesh_agrees(mesh);
  }
}

TEST(Splice, IsTakenBackByWhatWasSaved) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh mesh = sample(seed);
    const auto before = snapshot_of(mesh);
    Random random(seed);
    std::vector<FaceState> saved;
    for (int flip = 0; flip < 50; ++flip) {
      const Side side = random_edge(mesh, random);
      if (!can_flip(mesh, side)) continue;
      auto patch = flip_of(mesh, side);
      for (const Face face : patch.faces) saved.push_back(mesh.save(face));
      mesh.splice(patch);
    }
    ASSERT_FALSE(saved.empty());
    EXPECT_FALSE(snapshot_of(mesh) == before);
    mesh.restore(saved);
    EXPECT_TRUE(snapshot_of(mesh) == before);
    const auto defect = validate_connectivity(mesh);
    EXPECT_FALSE(defect) << defect->message();
  }
}

// But for where faces start.
TEST(Flip, DoesWhatItsPatchDoes) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh flipped = sample(seed);
    Random random(seed);
    int flips = 0;
    for (int i = 0; i < 150; ++i) {
      const Side edge = random_edge(flipped, random);
      if (!can_flip(flipped, edge)) continue;
      ASSERT_TRUE(flipped.is_flippable(edge));
      auto patch = flip_of(flipped, edge);
      Mesh spliced = flipped;
      spliced.splice(patch);
      const Side turned = flipped.flip(edge);
      EXPECT_EQ(flipped.is_lower(turned), true);
      EXPECT_EQ(Mesh::face_of(turned), patch.faces[0]);
      for (const Face face : flipped.faces()) {
        auto corners = spliced.triangles()[face];
        const bool is_new = face == patch.faces[0] || face == patch.faces[1];
        if (is_new) std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        ASSERT_EQ(flipped.triangles()[face], corners);
      }
      ++flips;
    }
    EXPECT_GT(flips, 10);
    const auto defect = validate_connectivity(flipped);
    EXPECT_FALSE(defect) << defect->message();
    expect_openmesh_agrees(flipped);
  }
}

// Four times the same edge: back to where it was, but for where faces start.
TEST(Flip, IsUndoneByThreeMore) {
  Mesh mesh = sample(1);
  Side edge{0};
  for (const Side e : all_edges(mesh))
    if (can_flip(mesh, e)) edge = e;
  const auto ends = [&] { return std::pair(mesh.from(edge), mesh.to(edge)); };
  const auto first = ends();
  edge = mesh.flip(edge);
  EXPECT_NE(ends(), first);
  edge = mesh.flip(edge);
  EXPECT_EQ(ends(), std::pair(first.second, first.first));
  edge = mesh.flip(mesh.flip(edge));
  EXPECT_EQ(ends(), first);
}

TEST(Flip, IsNotForConstrainedEdgesAndTheBorder) {
  const Mesh mesh = sample(2);  // labels, a frame
  int constrained = 0, outer = 0, flippable = 0;
  for (const Side edge : all_edges(mesh)) {
    constrained += mesh.constraint_of(edge) != none;
    outer += mesh.opposite(edge) == none;
    if (!mesh.is_flippable(edge)) continue;
    ++flippable;
    EXPECT_EQ(mesh.label(Mesh::face_of(edge)), mesh.label(mesh.face_across(edge)));
    EXPECT_EQ(mesh.constraint_of(edge), none);
  }
  EXPECT_GT(constrained, 0);
  EXPECT_EQ(outer, 4);
  EXPECT_EQ(flippable + constrained + outer, mesh.n_edges());
}

TEST(Splice, CountsFacesThatChangeSides) {
  Mesh mesh = build_mesh(four_triangles());
  Side inner{0};
  while (!can_flip(mesh, inner)) ++inner;
  auto patch = flip_of(mesh, inner);
  patch.labels = {padding_label, padding_label};
  mesh.splice(patch);
  EXPECT_EQ(mesh.n_user_faces(), 2);
  EXPECT_EQ(mesh.domain().n_faces(), 2);
}

// Against a map: linear probing with gaps that are closed is easily wrong where it wraps around.
TEST(SideNumbers, AreWhatAMapHolds) {
  Random random(5);
  for (int n = 1; n <= 40; ++n) {
    SideNumbers table;
    table.reset(n);
    std::map<Side, int> expected;
    for (int i = 0; i < 400; ++i) {
      const Side side(random.below(60));
      if (expected.contains(side)) {
        table.erase(side);
        expected.erase(side);
      } else if (static_cast<int>(expected.size()) < n) {
        table.insert(side, i);
        expected[side] = i;
      }
      for (const Side s : Numbers<Side>(60))
        ASSERT_EQ(table.find(s), expected.contains(s) ? expected[s] : none);
    }
  }
}

}  // namespace
}  // namespace kinemesh::test
