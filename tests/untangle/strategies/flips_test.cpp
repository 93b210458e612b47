// Untangling by edge flips: what they allow is judged by exact integers, what they leave is valid or
// untouched.
#include "untangle/strategies/flips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/around.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

__extension__ using Wide = __int128;

// Twice the area in units of 2^-48, of coordinates that are multiples of 2^-24.
Wide area(const Mesh& mesh, Face face) {
  const auto i = [](double x) { return static_cast<Wide>(x * 0x1p24); };
  const auto [a, b, c] = mesh.corners(face);
  return (i(b.x) - i(a.x)) * (i(c.y) - i(a.y)) - (i(b.y) - i(a.y)) * (i(c.x) - i(a.x));
}

// What every flip has to make smaller: the inverted area, and then the number of faces not upright.
std::pair<Wide, int> disorder(const Mesh& mesh) {
  std::pair<Wide, int> sum{0, 0};
  for (const Face f : mesh.faces()) {
    const auto size = area(mesh, f);
    sum.first += size < 0 ? -size : 0;
    sum.second += size <= 0;
  }
  return sum;
}

bool opposite_vertices_differ(const Mesh& mesh, Side edge) {
  return mesh.apex(edge) != mesh.apex(mesh.opposite(edge));
}

// Compares the test with what the flip does, for each edge, and leaves the mesh with some of them flipped.
void expect_flips_judged_right(Mesh& mesh, Random& random, int& allowed) {
  for (Side edge : all_edges(mesh)) {
    if (!mesh.is_flippable(edge) || !opposite_vertices_differ(mesh, edge)) continue;
    const auto before = disorder(mesh);
    const bool untangles = flip_untangles(mesh, edge);
    edge = mesh.flip(edge);
    ASSERT_EQ(untangles, disorder(mesh) < before) << edge;
    allowed += untangles;
    for (int back = untangles || random.one_in(8) ? 0 : 3; back > 0; --back) edge = mesh.flip(edge);
  }
}

// Upright or inverted faces as the defect says, by the corners it names.
bool is_true(const Mesh& mesh, const Defect& defect) {
  const auto at = [&](int i) { return mesh.position(mesh.vertex_of_user(defect.vertices.at(i))); };
  const auto has_number = [](UserVertex v) { return v != none; };
  if (!std::all_of(defect.vertices.begin(), defect.vertices.end(), has_number)) return true;  // of the frame
  const auto turn = orientation(at(0), at(1), at(2));
  return defect.kind == DefectKind::InvertedFace ? turn == Orientation::Clockwise
                                                 : turn == Orientation::Collinear;
}

struct Tally {
  int untangled = 0, stuck = 0, flat = 0;
};

void check(const Tangle& tangle, std::uint64_t seed, Tally& tally) {
  Mesh mesh = tangle.mesh;
  const auto outcome = repair(mesh, true, "flips");
  const bool was_tangled = outcome.record.inverted + outcome.record.degenerate > 0;
  EXPECT_EQ(outcome.record.inverted, static_cast<int>(oracle::inverted(tangle.mesh).size()));
  EXPECT_EQ(outcome.record.degenerate, static_cast<int>(oracle::flat(tangle.mesh).size()));
  if (outcome) {
    EXPECT_EQ(contract_broken(tangle.mesh, mesh, outcome), "") << tangle.about << seed;
    EXPECT_EQ(outcome.record.regions.empty(), !was_tangled);
    tally.untangled += was_tangled;
    tally.flat += outcome.record.degenerate > 0;
  } else {
    EXPECT_EQ(snapshot_of(mesh), snapshot_of(tangle.mesh)) << tangle.about << seed;
    EXPECT_TRUE(is_true(mesh, *outcome.defect)) << seed << message(outcome.defect);
    EXPECT_NE(outcome.defect->detail.find("edge flips are stuck with "), std::string::npos);
    ++tally.stuck;
  }
}

// A square around two vertices, 4 on the left and 5 on the right, joined to each other and to the corners.
Mesh two_inside() {
  MeshData data;
  data.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}, {3, 2}};
  data.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}, {3, 0, 4}};
  return build_mesh(data);
}

TEST(EdgeFlips, TurnTheEdgeAVertexWentThrough) {
  Mesh mesh = two_inside();
  place(mesh, 5, {0.5, 2});  // beyond 4, over none of whose other edges
  const auto outcome = repair(mesh, false, "flips");
  EXPECT_FALSE(outcome);  // 5 has taken its edges to 1 and 2 over vertex 4
  mesh = two_inside();
  place(mesh, 5, {2, 0.5});  // over the edge from 1 to 4
  const Mesh before = mesh;
  const auto flipped = repair(mesh, false, "flips");
  ASSERT_TRUE(flipped) << message(flipped.defect);
  EXPECT_EQ(contract_broken(before, mesh, flipped), "");
  ASSERT_EQ(flipped.record.regions.size(), 1u);
  EXPECT_THAT(flipped.record.regions[0].user_faces, testing::ElementsAre(0, 1));
  EXPECT_EQ(flipped.record.regions[0].seed, 1);
  EXPECT_EQ(flipped.record.replaced, 2);
  EXPECT_EQ(flipped.record.inverted, 1);
  EXPECT_EQ(flipped.record.components, 1);
}

TEST(EdgeFlips, TurnAFlatFace) {
  Mesh mesh = two_inside();
  place(mesh, 5, {2.5, 1});  // on the edge from 1 to 4
  ASSERT_EQ(oracle::flat(mesh).size(), 1u);
  const auto outcome = repair(mesh, false, "flips");
  ASSERT_TRUE(outcome) << message(outcome.defect);
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_EQ(outcome.record.degenerate, 1);
}

TEST(EdgeFlips, AreJudgedAsExactIntegersDo) {
  int allowed = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    Mesh tangle = random_tangle(seed).mesh, lattice = lattice_tangle(seed).mesh;
    expect_flips_judged_right(tangle, random, allowed);
    expect_flips_judged_right(lattice, random, allowed);
  }
  EXPECT_GT(allowed, 5000);
}

TEST(EdgeFlips, UntangleOrLeaveRandomTanglesAlone) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) check(random_tangle(seed), seed, tally);
  EXPECT_GT(tally.untangled, 300);
  EXPECT_GT(tally.stuck, 500);
}

TEST(EdgeFlips, UntangleOrLeaveDegenerateTanglesAlone) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    check(lattice_tangle(seed), seed, tally);
    check(polyomino_tangle(seed), seed, tally);
  }
  EXPECT_GT(tally.untangled, 100);
  EXPECT_GT(tally.flat, 50);
  EXPECT_GT(tally.stuck, 500);
}

// Far from 1 gains over- and underflow and the order of the flips is another one.
TEST(EdgeFlips, UntangleFarFromOne) {
  int untangled = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto tangle = random_tangle(seed);
    for (const double scale : {0x1p-500, 0x1p-30, 0x1p500}) {
      Mesh before = tangle.mesh;
      for (auto& p : before.positions()) p *= scale;
      Mesh mesh = before;
      if (const auto outcome = repair(mesh, true, "flips")) {
        EXPECT_EQ(contract_broken(before, mesh, outcome), "") << seed << ' ' << scale;
        untangled += outcome.record.replaced > 0;
      } else {
        EXPECT_EQ(snapshot_of(mesh), snapshot_of(before));
      }
    }
  }
  EXPECT_GT(untangled, 100);
}

TEST(EdgeFlips, LeaveAVertexBeyondItsBorderToOthers) {
  Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  place(mesh, 4, {1, -0.1});
  const Mesh before = mesh;
  const auto outcome = repair(mesh, true, "flips");
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.defect->kind, DefectKind::InvertedFace);
  EXPECT_EQ(outcome.defect->message(),
            "face 0 (0, 1, 4) is inverted at (0, 0): edge flips are stuck with 1 inverted or flat face left");
  EXPECT_EQ(snapshot_of(mesh), snapshot_of(before));
}

// One object for many meshes: what is left of one does not show in the next.
TEST(EdgeFlips, DoNotDependOnWhatWasBefore) {
  EdgeFlips veteran;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh a = random_tangle(seed).mesh, b = a;
    const auto by_veteran = veteran.repair(a, RepairOptions{.allow_escaped = true});
    EXPECT_EQ(static_cast<bool>(by_veteran), static_cast<bool>(repair(b, true, "flips")));
    EXPECT_EQ(snapshot_of(a), snapshot_of(b)) << seed;
  }
}

}  // namespace
}  // namespace kinemesh::test
