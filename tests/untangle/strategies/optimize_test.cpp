// Untangling by moving vertices: valid or untouched, and nothing moves that may not.
#include "untangle/strategies/optimize.h"

#include <gtest/gtest.h>

#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

bool may_move(const Mesh& mesh, Vertex v) {
  return mesh.user_vertex(v) != none && !mesh.is_constrained(v) && !mesh.is_fixed(v);
}

int count_moved(const Mesh& before, const Mesh& after) {
  int moved = 0;
  for (const Vertex v : before.vertices()) {
    if (before.position(v) == after.position(v)) continue;
    EXPECT_TRUE(may_move(before, v)) << v;
    ++moved;
  }
  return moved;
}

Snapshot without_positions(const Mesh& mesh) {
  auto snapshot = snapshot_of(mesh);
  snapshot.coordinates.clear();
  return snapshot;
}

struct Tally {
  int untangled = 0, failed = 0;
};

void check(const Tangle& tangle, std::uint64_t seed, Tally& tally) {
  SCOPED_TRACE(tangle.about + " " + std::to_string(seed));
  Mesh mesh = tangle.mesh;
  VertexOptimization optimize;
  const auto outcome = optimize.repair(mesh, RepairOptions{.allow_escaped = true});
  EXPECT_EQ(outcome.record.inverted, static_cast<int>(oracle::inverted(tangle.mesh).size()));
  EXPECT_EQ(outcome.record.degenerate, static_cast<int>(oracle::flat(tangle.mesh).size()));
  EXPECT_EQ(outcome.record.replaced, 0);
  EXPECT_TRUE(outcome.record.regions.empty());
  if (outcome) {
    EXPECT_EQ(message(validate(mesh)), "");
    EXPECT_EQ(without_positions(mesh), without_positions(tangle.mesh));
    EXPECT_LE(count_moved(tangle.mesh, mesh), optimize.moved());
    tally.untangled += outcome.record.inverted + outcome.record.degenerate > 0;
  } else {
    EXPECT_EQ(snapshot_of(mesh), snapshot_of(tangle.mesh));
    EXPECT_NE(outcome.defect->detail.find("moves of vertices are stuck with "), std::string::npos);
    EXPECT_EQ(optimize.moved(), 0);
    ++tally.failed;
  }
}

TEST(VertexOptimization, PutsALostVertexBackInTheMiddle) {
  for (const Point& lost : {Point(1, -3), Point(5, 5), Point(0, 1), Point(2, 2)}) {
    Mesh mesh = build_mesh(four_triangles(), {.frame = 3.0});
    place(mesh, 4, lost);
    VertexOptimization optimize;
    const auto outcome = optimize.repair(mesh, {});
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_NEAR(position_of(mesh, 4).x, 1.0, 1e-15);
    EXPECT_NEAR(position_of(mesh, 4).y, 1.0, 1e-15);
    EXPECT_EQ(optimize.moved(), 1);
    EXPECT_EQ(optimize.sweeps(), 1);
    EXPECT_EQ(outcome.record.escaped, 0);
  }
}

TEST(VertexOptimization, LeavesAValidMeshAlone) {
  Mesh mesh = build_mesh(four_triangles());
  place(mesh, 4, {0.1, 0.1});
  const Mesh before = mesh;
  VertexOptimization optimize;
  EXPECT_TRUE(optimize.repair(mesh, {}));
  EXPECT_EQ(snapshot_of(mesh), snapshot_of(before));
  EXPECT_EQ(optimize.sweeps(), 0);
  EXPECT_EQ(optimize.moved(), 0);
}

TEST(VertexOptimization, MovesNoFixedVertex) {
  Mesh mesh = build_mesh(four_triangles(), {.frame = 3.0, .fixed = {4}});
  place(mesh, 4, {1, -1});
  const Mesh before = mesh;
  const auto outcome = repair(mesh, false, "optimize");
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.defect->message(),
            "face 0 (0, 1, 4) is inverted at (0, 0): moves of vertices are stuck with 1 inverted or flat "
            "face left");
  EXPECT_EQ(snapshot_of(mesh), snapshot_of(before));
}

TEST(VertexOptimization, UntanglesOrLeavesRandomTanglesAlone) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) check(random_tangle(seed), seed, tally);
  EXPECT_GT(tally.untangled, 500);
  EXPECT_GT(tally.failed, 100);
}

TEST(VertexOptimization, UntanglesOrLeavesDegenerateTanglesAlone) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    check(lattice_tangle(seed), seed, tally);
    check(polyomino_tangle(seed), seed, tally);
  }
  EXPECT_GT(tally.untangled, 500);
  EXPECT_GT(tally.failed, 100);
}

TEST(VertexOptimization, DoesNotDependOnWhatWasBefore) {
  VertexOptimization veteran;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh a = random_tangle(seed).mesh, b = a;
    const auto by_veteran = veteran.repair(a, RepairOptions{.allow_escaped = true});
    EXPECT_EQ(static_cast<bool>(by_veteran), static_cast<bool>(repair(b, true, "optimize")));
    EXPECT_EQ(snapshot_of(a), snapshot_of(b)) << seed;
  }
}

TEST(Strategies, SayWhetherTheyMoveVertices) {
  for (const auto& strategy : strategies())
    EXPECT_EQ(strategy.make()->moves_vertices(), strategy.name == "optimize") << strategy.name;
}

}  // namespace
}  // namespace kinemesh::test
