// Flips end at the constrained Delaunay triangulation, from valid meshes and from tangled ones.
#include "kinemesh/delaunay.h"

#include <gtest/gtest.h>

#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/shapes.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/quality/delaunay.h"
#include "tests/untangle/quality/scattered.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

constexpr RepairOptions allowing{.allow_escaped = true};

// Both faces upright afterwards.
bool can_flip_in_place(const Mesh& mesh, Side edge) {
  if (!mesh.is_flippable(edge)) return false;
  return segments_cross(mesh.position(mesh.from(edge)), mesh.position(mesh.to(edge)),
                        mesh.position(mesh.apex(edge)), mesh.position(mesh.apex(mesh.opposite(edge))));
}

int flip_at_random(Mesh& mesh, int attempts, std::uint64_t seed) {
  Random random(seed);
  int flips = 0;
  for (int i = 0; i < attempts; ++i) {
    const Side edge = random_edge(mesh, random);
    if (!can_flip_in_place(mesh, edge)) continue;
    mesh.flip(edge);
    ++flips;
  }
  return flips;
}

void expect_delaunay(const Mesh& mesh, const std::string& about) {
  EXPECT_EQ(message(validate(mesh)), "") << about;
  EXPECT_EQ(not_delaunay(mesh), "") << about;
  EXPECT_EQ(n_not_locally_delaunay(mesh), 0) << about;
}

// What a failure leaves.
void expect_sound(const Mesh& before, const Mesh& after) {
  EXPECT_EQ(message(validate_connectivity(after)), "");
  EXPECT_EQ(snapshot_of(after).coordinates, snapshot_of(before).coordinates);
  EXPECT_LE(n_tangled(after), n_tangled(before));
  EXPECT_GT(n_tangled(after), 0);
}

TEST(DelaunayFlipping, UndoesRandomFlips) {
  for (int number = 0; number < n_domains; ++number) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto [about, mesh] = domain_number(number, seed);
      ASSERT_GT(flip_at_random(mesh, 3000, seed), 500) << about;
      ASSERT_EQ(message(validate(mesh)), "") << about;
      const auto positions = snapshot_of(mesh).coordinates;
      const int wrong = n_foreign_edges(mesh);
      const auto outcome = DelaunayFlipping().run(mesh);
      ASSERT_TRUE(outcome);
      EXPECT_GT(wrong, 100) << about;
      EXPECT_GE(outcome.flips, wrong / 2) << about;
      EXPECT_EQ(outcome.untangled, 0);
      EXPECT_LE(outcome.visits, mesh.n_edges() + 4 * outcome.flips);
      expect_delaunay(mesh, about);
      EXPECT_EQ(snapshot_of(mesh).coordinates, positions);
    }
  }
}

TEST(DelaunayFlipping, LeavesADelaunayTriangulationAlone) {
  for (int number = 0; number < n_domains; ++number) {
    auto [about, mesh] = domain_number(number, 5);
    ASSERT_TRUE(DelaunayFlipping().run(mesh));
    const auto before = snapshot_of(mesh);
    const auto outcome = DelaunayFlipping().run(mesh);
    EXPECT_EQ(outcome.flips, 0) << about;
    EXPECT_EQ(outcome.visits, mesh.n_edges()) << about;
    EXPECT_TRUE(snapshot_of(mesh) == before) << about;
  }
}

// All cells of a grid are cocircular: each keeps the diagonal it has, or has it turned by flips next to it.
TEST(DelaunayFlipping, EndsWhereAllVerticesAreCocircular) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Mesh mesh = build_mesh(make_grid(12, 9));
    flip_at_random(mesh, 2000, seed);
    ASSERT_TRUE(DelaunayFlipping().run(mesh));
    expect_delaunay(mesh, "grid");
  }
}

TEST(DelaunayFlipping, UntanglesRandomTangles) {
  int untangled = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    auto [about, mesh, was_at] = random_tangle(seed);
    const Mesh before = mesh;
    const auto outcome = DelaunayFlipping().run(mesh, allowing);
    ASSERT_TRUE(outcome) << about << " " << seed << ": " << message(outcome.defect);
    EXPECT_EQ(outcome.untangled > 0, n_tangled(before) > 0) << seed;
    untangled += outcome.untangled;
    expect_delaunay(mesh, about + " " + std::to_string(seed));
    EXPECT_EQ(snapshot_of(mesh).coordinates, snapshot_of(before).coordinates);
  }
  EXPECT_GT(untangled, 1000);
}

// In degenerate positions, too; where two vertices coincide there is no mesh, and they are named.
TEST(DelaunayFlipping, UntanglesLattices) {
  int untangled = 0, failed = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    auto [about, mesh, was_at] = lattice_tangle(seed);
    const Mesh before = mesh;
    const auto outcome = DelaunayFlipping().run(mesh, allowing);
    if (outcome) {
      untangled += outcome.untangled > 0;
      expect_delaunay(mesh, about + " " + std::to_string(seed));
      continue;
    }
    ++failed;
    Mesh again = before;
    EXPECT_FALSE(repair(again, true)) << seed;
    expect_sound(before, mesh);
  }
  EXPECT_GT(untangled, 200);
  EXPECT_GT(failed, 50);
}

TEST(DelaunayFlipping, KeepsConstrainedEdgesAndLabelsOfScatteredMeshes) {
  for (int number = 0; number < n_domains; ++number) {
    const auto [about, good] = domain_number(number, 2);
    Mesh mesh = exchanged(good, 3);
    ASSERT_GT(n_tangled(mesh), 50) << about;
    const auto outcome = DelaunayFlipping().run(mesh);
    ASSERT_TRUE(outcome) << about << ": " << message(outcome.defect);
    EXPECT_GT(outcome.untangled, 0);
    EXPECT_EQ(mesh.n_user_faces(), good.n_user_faces());
    expect_delaunay(mesh, about);
  }
}

// Free vertices move a little, as in a step that tangles nothing: flips from what can have changed find all.
TEST(DelaunayFlipping, FindsFromChangedFacesWhatItFindsFromAll) {
  int flips = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const std::string about = "seed " + std::to_string(seed);
    Mesh mesh = domain_number(static_cast<int>(seed) % n_domains, seed).mesh;
    DelaunayFlipping flipping;
    ASSERT_TRUE(flipping.run(mesh));
    Random random(seed);
    std::vector<Face> faces;
    for (int i = 0; i < 4; ++i) {
      const Vertex v(random.below(mesh.n_vertices()));
      if (!is_free(mesh, v)) continue;
      const Mesh before = mesh;
      mesh.positions()[v] = scattered(mesh, 1.0, seed).position(v);
      if (n_tangled(mesh) > 0) mesh = before;
      for_each_side_from(mesh, v, [&](Side side) { faces.push_back(Mesh::face_of(side)); });
    }
    const auto sides = sides_of(mesh, faces);
    const auto outcome = flipping.run(mesh, sides);
    ASSERT_TRUE(outcome);
    flips += outcome.flips;
    EXPECT_LE(outcome.visits, static_cast<int>(sides.size()) + 4 * outcome.flips);
    expect_delaunay(mesh, about);
    EXPECT_EQ(flipping.run(mesh).flips, 0) << about;
  }
  EXPECT_GT(flips, 100);
}

// Two tangles far apart; flips start beside one of them.
TEST(DelaunayFlipping, LeavesTanglesAloneThatItDoesNotMeet) {
  Mesh mesh = build_mesh(make_grid(20, 20));
  const auto at = [](int i, int j) { return 21 * j + i; };
  place(mesh, at(4, 4), {0.33, 0.21});
  place(mesh, at(16, 16), {0.87, 0.81});
  const Mesh before = mesh;
  std::vector<Face> faces;
  for_each_side_from(mesh, mesh.vertex_of_user(UserVertex(at(4, 4))),
                     [&](Side side) { faces.push_back(Mesh::face_of(side)); });
  const auto outcome = DelaunayFlipping().run(mesh, sides_of(mesh, faces));
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome.untangled, 1);
  EXPECT_GT(outcome.flips, 0);
  EXPECT_LT(outcome.visits, 200);
  int tangled = 0;
  for (const Face f : mesh.faces()) {
    const Point middle = (mesh.corners(f)[0] + mesh.corners(f)[1] + mesh.corners(f)[2]) / 3.0;
    if (middle.x < 0.55 && middle.y < 0.55)
      EXPECT_TRUE(is_upright(mesh, f));
    else
      EXPECT_EQ(mesh.triangles()[f], before.triangles()[f]);
    tangled += !is_upright(mesh, f);
  }
  EXPECT_GT(tangled, 0);
}

TEST(DelaunayFlipping, NamesCoincidentVerticesAndStaysSound) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Mesh mesh = build_mesh(random_square(60, random));
    const int a = 4 + random.below(56), b = 4 + random.below(56);
    if (a == b) continue;
    place(mesh, a, position_of(mesh, b));
    const Mesh before = mesh;
    const auto outcome = DelaunayFlipping().run(mesh);
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.defect->kind, DefectKind::CoincidentVertices);
    const auto& [first, second] = std::pair(outcome.defect->vertices.at(0), outcome.defect->vertices.at(1));
    EXPECT_EQ(std::minmax<int>({first, second}), std::minmax({a, b}));
    expect_sound(before, mesh);
  }
}

// After a failure the same object serves another mesh.
TEST(DelaunayFlipping, ForgetsWhatAFailureHasLeft) {
  Random random(1);
  Mesh broken = build_mesh(random_square(60, random)), whole = build_mesh(random_square(50, random));
  place(broken, 10, position_of(broken, 40));
  flip_at_random(whole, 500, 1);
  Mesh other = whole;
  DelaunayFlipping flipping;
  ASSERT_FALSE(flipping.run(broken));
  const auto outcome = flipping.run(whole), fresh = DelaunayFlipping().run(other);
  EXPECT_EQ(outcome.visits, fresh.visits);
  EXPECT_TRUE(snapshot_of(whole) == snapshot_of(other));
  expect_delaunay(whole, "after a failure");
}

TEST(DelaunayFlipping, RefusesSidesThatDoNotExist) {
  Mesh mesh = build_mesh(four_triangles());
  for (const Side side : {Side(none), Mesh::side(Face(1), 3), Mesh::side(Face(mesh.n_faces()), 0)})
    EXPECT_THROW((void)DelaunayFlipping().run(mesh, std::vector{side}), InputError);
}

}  // namespace
}  // namespace kinemesh::test
