// Positions as degenerate as real meshes have them: collinear vertices, vertices on edges and on lines of
// others.
#include <gtest/gtest.h>

#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

// Repairs without a retry if no two vertices coincide, and names them otherwise.
void expect_repaired(Mesh mesh, const std::string& about) {
  const Mesh before = mesh;
  const auto outcome = repair(mesh);
  if (oracle::coincident_vertices(before).first != none) {
    ASSERT_FALSE(outcome) << about;
    EXPECT_EQ(outcome.defect->kind, DefectKind::CoincidentVertices) << about;
    EXPECT_TRUE(snapshot_of(before) == snapshot_of(mesh)) << about;
    return;
  }
  ASSERT_TRUE(outcome) << about << ": " << message(outcome.defect);
  EXPECT_EQ(outcome.record.retries(), 0) << about;
  EXPECT_EQ(contract_broken(before, mesh, outcome), "") << about;
}

void expect_holds(std::string (*property)(std::uint64_t), int seeds) {
  int broken = 0;
  for (int seed = 1; seed <= seeds && broken < 5; ++seed) {
    const auto wrong = property(seed);
    EXPECT_EQ(wrong, "");
    broken += !wrong.empty();
  }
}

TEST(Lattice, IsRepairedWhereverAMeshExists) {
  expect_holds(check_lattice_tangle, 6000);
}

TEST(Polyomino, IsRepairedWhereverAMeshExists) {
  expect_holds(check_polyomino_tangle, 6000);
}

// A valid mesh exists neither always nor never.
TEST(Polyomino, FailsNowAndThen) {
  int repaired = 0, failed = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Mesh mesh = polyomino_tangle(seed).mesh;
    const auto outcome = repair(mesh, true);
    repaired += outcome && !outcome.record.regions.empty();
    failed += !outcome;
  }
  EXPECT_GT(repaired, 50);
  EXPECT_GT(failed, 50);
}

TEST(Lattice, TakesAVertexToEveryHalfCell) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    const Mesh grid = build_mesh(random_grid(4, 4, random));
    for (const Vertex v : grid.vertices()) {
      for (int place = 0; !grid.is_constrained(v) && place < 49; ++place) {
        Mesh mesh = grid;
        mesh.positions()[v] = {1.0 + place % 7, 1.0 + place / 7};
        expect_repaired(mesh, "vertex " + std::to_string(v) + ", place " + std::to_string(place));
      }
    }
  }
}

// Every other vertex of a row keeps its place, or a row lands between the vertices of another.
TEST(Lattice, SurvivesRowsThatCollapseOntoOthers) {
  for (int from = 1; from <= 5; ++from) {
    for (int to = 1; to <= 11; ++to) {
      for (const double aside : {-1.0, 0.0, 1.0}) {
        Random random(7);
        Mesh mesh = build_mesh(random_grid(6, 6, random));
        move_free(mesh, [&](const Point& p) { return p.y == 2 * from ? Point(p.x + aside, to) : p; });
        if (oracle::constraints_touch(mesh)) continue;
        expect_repaired(mesh, "row " + std::to_string(from) + " to height " + std::to_string(to));
      }
    }
  }
}

TEST(Lattice, SurvivesAllRowsOnOneLine) {
  Random random(3);
  Mesh mesh = build_mesh(random_grid(6, 6, random));
  // Row y goes to height 6, row by row further right by a sixteenth: all free vertices collinear.
  move_free(mesh, [](const Point& p) { return Point(p.x + p.y / 16, 6); });
  expect_repaired(mesh, "all on a line");
}

TEST(Lattice, SurvivesTheMirrorOfItsInside) {
  for (int n = 2; n <= 7; ++n) {
    Random random(n);
    Mesh mesh = build_mesh(random_grid(n, n, random));
    move_free(mesh, [&](const Point& p) { return Point(2.0 * n - p.x, p.y); });
    expect_repaired(mesh, "mirrored " + std::to_string(n));
    Mesh turned = build_mesh(random_grid(n, n, random));
    move_free(turned, [&](const Point& p) { return Point(2.0 * n - p.x, 2.0 * n - p.y); });
    expect_repaired(turned, "turned " + std::to_string(n));
  }
}

TEST(Lattice, AnswersTheSameMirroredAndTransposed) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Mesh plain = lattice_tangle(seed).mesh, turned = plain;
    for (auto& p : turned.positions()) p = {-p.y, p.x};
    const auto a = repair(plain, true), b = repair(turned, true);
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b)) << seed;
    EXPECT_EQ(a.record.region_faces(), b.record.region_faces()) << seed;
    EXPECT_EQ(std::string(a ? "" : to_string(a.defect->kind)),
              std::string(b ? "" : to_string(b.defect->kind)))
        << seed;
  }
}

}  // namespace
}  // namespace kinemesh::test
