// The kinetic strategy: valid wherever a valid mesh exists, by flips that follow the motion.
#include "untangle/strategies/kinetic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "kinemesh/error.h"
#include "kinemesh/predicates.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/in_motion.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

template <class Make>
MotionTotals expect_kinetic(int seeds, const Make& make) {
  MotionTotals totals;
  int broken = 0;
  for (int seed = 1; seed <= seeds && broken < 3; ++seed) {
    const Tangle tangle = make(seed);
    const auto wrong = check_in_motion(tangle.mesh, tangle.before, totals);
    EXPECT_EQ(wrong, "") << tangle.about << " " << seed;
    broken += !wrong.empty();
  }
  return totals;
}

std::vector<Point> positions_of(const Mesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

Tangle moved(const char* about, Mesh mesh, const std::function<Point(const Point&)>& map) {
  Tangle tangle{about, std::move(mesh), {}};
  tangle.before = positions_of(tangle.mesh);
  move_free(tangle.mesh, map);
  return tangle;
}

// Vertices of a square that go anywhere inside: nothing but each other is in their way, and they miss each
// other.
Tangle in_a_square(std::uint64_t seed) {
  Random random(seed);
  const double reach = std::pow(2.0, -random.below(6));
  return moved("square", build_mesh(random_square(8 + random.below(60), random)), [&](const Point& p) {
    const Point to{random.between(0.01, 0.99), random.between(0.01, 0.99)};
    return snapped(p + reach * (to - p));
  });
}

// --- always valid ---

TEST(Kinetic, EndsValidOnRandomTangles) {
  const auto totals = expect_kinetic(2500, random_tangle);
  EXPECT_EQ(totals.failed, 0);
  EXPECT_GT(totals.flips, 50000);
  EXPECT_GT(totals.stuck, 1000);  // borders that move across vertices
  EXPECT_GT(totals.replacements, 500);
}

TEST(Kinetic, EndsAsGlobalDoesOnLattices) {
  const auto totals = expect_kinetic(3000, lattice_tangle);
  EXPECT_GT(totals.repaired, 2000);
  EXPECT_GT(totals.failed, 200);
}

TEST(Kinetic, EndsAsGlobalDoesWhereBordersAndInterfacesMove) {
  const auto totals = expect_kinetic(3000, polyomino_tangle);
  EXPECT_GT(totals.repaired, 2000);
  EXPECT_GT(totals.failed, 100);
}

TEST(Kinetic, GoesOnForManySteps) {
  MotionTotals totals;
  KineticUntangling kinetic;
  for (int seed = 1; seed <= 20; ++seed) {
    Tangle tangle = in_a_square(seed);
    Random random(seed);
    for (int step = 0; step < 40; ++step) {
      ASSERT_EQ(check_in_motion(tangle.mesh, tangle.before, totals), "") << seed << " " << step;
      ASSERT_TRUE(kinetic.repair(tangle.mesh, Move({}, tangle.before)));
      tangle.before = positions_of(tangle.mesh);
      move_free(tangle.mesh, [&](const Point& p) {
        return p + 0.25 * (Point(random.between(0.01, 0.99), random.between(0.01, 0.99)) - p);
      });
    }
  }
  EXPECT_EQ(totals.repaired, 800);
  EXPECT_EQ(totals.stuck, 0);
}

// --- flips follow the motion ---

TEST(Kinetic, NeedsOneFlipForEachEventInGeneralPosition) {
  const auto totals = expect_kinetic(400, in_a_square);
  EXPECT_EQ(totals.flips, totals.events);
  EXPECT_GT(totals.flips, 10000);
  EXPECT_EQ(totals.stuck, 0);
  EXPECT_EQ(totals.replacements, 0);
}

// The result depends on the way alone, not on where it is cut: bit for bit. Positions are multiples of 2^-24,
// so that those on the way are exact.
TEST(Kinetic, MakesTheSameOfOneStepAndOfItsParts) {
  int flips = 0;
  for (int seed = 1; seed <= 300; ++seed) {
    const Tangle tangle = in_a_square(seed);
    Mesh whole = tangle.mesh, cut = tangle.mesh;
    KineticUntangling kinetic;
    ASSERT_TRUE(kinetic.repair(whole, Move({}, tangle.before)));
    const int n_flips = kinetic.counts().flips;
    auto at = tangle.before;
    int n_flips_cut = 0;
    const auto end = positions_of(tangle.mesh);
    for (const double t : {0.25, 0.375, 0.5, 0.875, 1.0}) {
      const auto before = at;
      for (std::size_t v = 0; v < at.size(); ++v) at[v] = tangle.before[v] + t * (end[v] - tangle.before[v]);
      std::copy(at.begin(), at.end(), cut.positions().begin());
      ASSERT_TRUE(kinetic.repair(cut, Move({}, before)));
      n_flips_cut += kinetic.counts().flips;
    }
    EXPECT_TRUE(snapshot_of(whole) == snapshot_of(cut)) << seed;
    EXPECT_EQ(n_flips, n_flips_cut) << seed;
    flips += n_flips;
  }
  EXPECT_GT(flips, 5000);
}

TEST(Kinetic, FlipsTheEdgeThatIsCrossed) {
  // 4 in the middle goes through the edge 1 2 of its fan, into the square's right half, and back is no event.
  MeshData data;
  data.points = {{0, 0}, {4, 0}, {8, 0}, {8, 4}, {4, 4}, {0, 4}, {2, 2}, {6, 2}};
  data.triangles = {{0, 1, 6}, {1, 4, 6}, {4, 5, 6}, {5, 0, 6}, {1, 2, 7}, {2, 3, 7}, {3, 4, 7}, {4, 1, 7}};
  Mesh mesh = build_mesh(data);
  const auto before = positions_of(mesh);
  place(mesh, 6, {5, 2});
  KineticUntangling kinetic;
  const auto outcome = kinetic.repair(mesh, Move({}, before));
  ASSERT_TRUE(outcome);
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_EQ(kinetic.counts().events, 1);
  EXPECT_EQ(kinetic.counts().flips, 1);
  ASSERT_EQ(outcome.record.regions.size(), 1u);
  const auto& region = outcome.record.regions[0];
  EXPECT_THAT(region.user_faces, testing::ElementsAre(1, 7));
  EXPECT_EQ(region.seed, 1);
  EXPECT_EQ(region.inverted, 1);
  EXPECT_FALSE(region.fallback);
  EXPECT_EQ(outcome.record.replaced, 2);
  auto triangles = mesh.domain().triangles;
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  const std::vector<Triangle> expected{{0, 1, 6}, {0, 6, 5}, {1, 2, 7}, {1, 7, 6},
                                       {2, 3, 7}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}};
  EXPECT_EQ(triangles, expected);
}

// --- at the same time ---

// A whole row rises, half a cell to the side, through other rows: everything between two rows is flat at
// once.
TEST(Kinetic, TakesRowsThroughRows) {
  for (int n = 3; n <= 8; ++n) {
    for (int to = 1; to < 2 * n; to += 2) {
      for (const double aside : {-0.5, 0.25, 0.75}) {
        Random random(n);
        const auto tangle = moved("rows", build_mesh(random_grid(n, n, random)),
                                  [&](const Point& p) { return p.y == 2 ? Point(p.x + aside, to) : p; });
        MotionTotals totals;
        ASSERT_EQ(check_in_motion(tangle.mesh, tangle.before, totals), "") << n << " " << to << " " << aside;
        EXPECT_EQ(totals.stuck, 0) << n << " " << to << " " << aside;
        EXPECT_EQ(totals.replacements, 0) << n << " " << to << " " << aside;
      }
    }
  }
}

// Two corners cross one edge at one time, from both sides.
TEST(Kinetic, LetsTwoVerticesPassInOneEdge) {
  const MeshData data =
      domain_of({rectangle({0, 0}, {12, 8})}, {{2, 4}, {10, 4}, {5, 6}, {7, 2}}, {{{2, 4}, {10, 4}}});
  for (const double height : {2.0, 1.0, 3.5}) {
    Mesh mesh = build_mesh(data);
    const auto before = positions_of(mesh);
    const auto find = [&](const Point& p) {
      return static_cast<int>(std::find(data.points.begin(), data.points.end(), p) - data.points.begin());
    };
    place(mesh, find({5, 6}), {5, height});
    place(mesh, find({7, 2}), {7, 8 - height});
    MotionTotals totals;
    EXPECT_EQ(check_in_motion(mesh, before, totals), "") << height;
    EXPECT_EQ(totals.stuck, 0);
    EXPECT_EQ(totals.replacements, 0);
    EXPECT_GE(totals.flips, 2);
  }
}

// --- where flips cannot follow ---

// The wire from `a` to `b` turns and overtakes `c`, which is on its old side in the end: nothing to do.
TEST(Kinetic, LetsAVertexLeaveThroughAConstraintAndComeBack) {
  const Point a{4, 1}, b{2, 5}, c{2.875, 4};
  MeshData data = domain_of({rectangle({0, 0}, {8, 6})}, {a, b, c, {6, 2}, {1, 2}}, {{a, b}});
  const auto find = [&](const Point& p) {
    return static_cast<int>(std::find(data.points.begin(), data.points.end(), p) - data.points.begin());
  };
  data.markers = {{"wire", {{find(a), find(b)}}}};
  Mesh mesh = build_mesh(data);
  const auto before = positions_of(mesh);
  place(mesh, find(b), {6, 5});
  place(mesh, find(c), {4.875, 2});
  Mesh halfway = mesh;
  for (const Vertex v : mesh.vertices()) halfway.positions()[v] = 0.5 * (before[v] + mesh.position(v));
  EXPECT_EQ(orientation(position_of(halfway, find(a)), position_of(halfway, find(b)),
                        position_of(halfway, find(c))),
            Orientation::CounterClockwise);
  EXPECT_EQ(orientation(position_of(mesh, find(a)), position_of(mesh, find(b)), position_of(mesh, find(c))),
            Orientation::Clockwise);
  MotionTotals totals;
  EXPECT_EQ(check_in_motion(mesh, before, totals), "");
  EXPECT_GT(totals.stuck, 0);
}

// Two vertices change places, through each other: one turns around the other. Where a third is in their
// middle three meet, and what is tangled is replaced: 8 pairs of the 9 vertices.
TEST(Kinetic, LetsVerticesMeetOnTheirWay) {
  Random random(2);
  const Mesh mesh = build_mesh(random_grid(4, 4, random));
  const auto before = positions_of(mesh);
  MotionTotals totals;
  for (const Vertex v : mesh.vertices()) {
    for (Vertex w{0}; w < v; ++w) {
      if (mesh.is_constrained(v) || mesh.is_constrained(w)) continue;
      Mesh swapped = mesh;
      std::swap(swapped.positions()[v], swapped.positions()[w]);
      EXPECT_EQ(check_in_motion(swapped, before, totals), "") << v << " " << w;
    }
  }
  EXPECT_EQ(totals.repaired, 36);
  EXPECT_GT(totals.replacements, 0);
  EXPECT_LE(totals.replacements, 8);
}

// --- for its callers ---

TEST(Kinetic, HasNothingToDoWhereNothingCollapses) {
  for (int seed = 1; seed <= 50; ++seed) {
    const Tangle tangle = in_a_square(seed);
    Mesh still = tangle.mesh;
    std::copy(tangle.before.begin(), tangle.before.end(), still.positions().begin());
    const Mesh built = still;
    EXPECT_TRUE(KineticUntangling().repair(still, Move({}, tangle.before)).record.regions.empty());
    for (auto& p : still.positions()) p = {3 - 2 * p.y, 2 * p.x - 1};
    const auto outcome = KineticUntangling().repair(still, Move({}, tangle.before));
    EXPECT_TRUE(outcome && outcome.record.regions.empty() && outcome.record.replaced == 0);
    still.swap_positions(*std::make_unique<std::vector<Point>>(tangle.before));
    EXPECT_TRUE(snapshot_of(still) == snapshot_of(built));
  }
}

TEST(Kinetic, DoesNotDependOnThreadsOrOnWhatItDidBefore) {
  KineticUntangling used;
  for (int seed = 1; seed <= 200; ++seed) {
    const Tangle tangle = random_tangle(seed);
    const Move move({.allow_escaped = true}, tangle.before);
    Mesh one = tangle.mesh, two = tangle.mesh;
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      ASSERT_TRUE(KineticUntangling().repair(one, move));
    }
    ASSERT_TRUE(used.repair(two, move));
    EXPECT_TRUE(snapshot_of(one) == snapshot_of(two)) << seed;
  }
}

// Up to where doubles cannot multiply any more.
TEST(Kinetic, DoesTheSameTurnedAndAtAnySize) {
  for (int seed = 1; seed <= 60; ++seed) {
    const Tangle tangle = in_a_square(seed);
    Mesh plain = tangle.mesh;
    ASSERT_TRUE(KineticUntangling().repair(plain, Move({}, tangle.before)));
    for (const double size : {1.0, 0x1p-1000, 0x1p-400, 0x1p400, 0x1p1000}) {
      Mesh mesh = tangle.mesh;
      auto before = tangle.before;
      for (const auto positions : {mesh.positions(), std::span<Point>(before)})
        for (auto& p : positions) p = size * Point(-p.y, p.x);
      const auto outcome = KineticUntangling().repair(mesh, Move({}, before));
      ASSERT_TRUE(outcome);
      const auto positions = plain.positions();
      std::copy(positions.begin(), positions.end(), mesh.positions().begin());
      EXPECT_TRUE(snapshot_of(mesh) == snapshot_of(plain)) << seed << " " << size;
    }
  }
}

TEST(Kinetic, HasToKnowWhereVerticesCameFrom) {
  const Tangle tangle = in_a_square(1);
  for (const std::size_t n : {std::size_t{0}, tangle.before.size() - 1}) {
    Mesh mesh = tangle.mesh;
    try {
      (void)KineticUntangling().repair(mesh, Move({}, std::span(tangle.before).first(n)));
      ADD_FAILURE() << "did not throw";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(n) + " positions before the move"),
                std::string::npos);
    }
    EXPECT_TRUE(snapshot_of(mesh) == snapshot_of(tangle.mesh));
  }
}

// What callers claim need not be true: any mesh before is as good as a valid one, only not for the flips.
TEST(Kinetic, EndsValidWhateverIsSaidOfTheWay) {
  const auto totals = expect_kinetic(500, [](std::uint64_t seed) {
    Tangle tangle = random_tangle(seed);
    Random random(seed);
    for (auto& p : tangle.before) p = {random.between(-1, 1), random.between(-1, 1)};
    return tangle;
  });
  EXPECT_EQ(totals.failed, 0);
}

}  // namespace
}  // namespace kinemesh::test
