// Smoothing of valid meshes never harms, that of tangled ones untangles first.
#include "kinemesh/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "kinemesh/error.h"
#include "kinemesh/measure.h"
#include "kinemesh/shapes.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/quality/scattered.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

constexpr RepairOptions allowing{.allow_escaped = true};

class Smooth : public testing::TestWithParam<SmoothingMethod> {
 protected:
  SmoothingOptions options() const { return {.method = GetParam()}; }
};

std::string name_of_method(const testing::TestParamInfo<SmoothingMethod>& method) {
  return method.param == SmoothingMethod::Laplacian ? "Laplacian" : "Optimization";
}

INSTANTIATE_TEST_SUITE_P(Methods, Smooth,
                         testing::Values(SmoothingMethod::Laplacian, SmoothingMethod::Optimization),
                         name_of_method);

// Valid, and as bad as a repair leaves it.
Mesh bad_but_valid(std::uint64_t seed) {
  auto [about, mesh, was_at] = random_tangle(seed);
  if (!repair(mesh, true)) throw std::logic_error("no valid mesh of " + about);
  return mesh;
}

double smallest_angle_of_any_face(const Mesh& mesh) {
  double tangent = std::numeric_limits<double>::infinity();
  for (const Face f : mesh.faces()) tangent = std::min(tangent, tangent_of_smallest_angle(mesh.corners(f)));
  return tangent;
}

int count_moved(const Mesh& a, const Mesh& b) {
  int moved = 0;
  for (const Vertex v : a.vertices()) moved += a.position(v) != b.position(v);
  return moved;
}

TEST_P(Smooth, NeverMakesAValidMeshWorse) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const Mesh before = bad_but_valid(seed);
    Mesh mesh = before;
    const auto outcome = smooth(mesh, options());
    ASSERT_TRUE(outcome);
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_TRUE(same_connectivity(mesh, before)) << seed;
    EXPECT_EQ(moved_what_stays(before, mesh), "") << seed;
    EXPECT_EQ(outcome.untangled, 0);
    EXPECT_EQ(outcome.moved, count_moved(before, mesh)) << seed;
    EXPECT_EQ(outcome.min_angle_before_deg, measure(before).min_angle_deg);
    EXPECT_EQ(outcome.min_angle_after_deg, measure(mesh).min_angle_deg);
    EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg) << seed;
    EXPECT_GE(smallest_angle_of_any_face(mesh), smallest_angle_of_any_face(before)) << seed;
    better += outcome.min_angle_after_deg > outcome.min_angle_before_deg;
  }
  EXPECT_GT(better, 150);
}

TEST_P(Smooth, MakesEverySweepBetterThanTheLast) {
  Mesh mesh = domain_number(0, 3).mesh;
  auto one = options();
  one.max_sweeps = 1;
  double angle = measure(mesh).min_angle_deg;
  for (int sweep = 0; sweep < 10; ++sweep) {
    const auto outcome = smooth(mesh, one);
    EXPECT_LE(outcome.sweeps, 1);
    EXPECT_GE(outcome.min_angle_after_deg, angle);
    angle = outcome.min_angle_after_deg;
  }
}

TEST_P(Smooth, HasNothingToDoOnceItIsQuiet) {
  Mesh mesh = domain_number(2, 1).mesh;
  auto patient = options();
  patient.max_sweeps = 10000;
  const auto first = smooth(mesh, patient);
  EXPECT_GT(first.moved, 100);
  EXPECT_GE(first.moves, first.moved);
  ASSERT_LT(first.sweeps, 10000);
  const auto before = snapshot_of(mesh);
  const auto second = smooth(mesh, patient);
  EXPECT_EQ(second.sweeps, 1);
  EXPECT_EQ(second.moves, 0);
  EXPECT_EQ(second.moved, 0);
  EXPECT_TRUE(snapshot_of(mesh) == before);
}

TEST_P(Smooth, TakesALonelyVertexToTheMiddle) {
  Mesh mesh = build_mesh(four_triangles());
  place(mesh, 4, {1.6, 0.3});
  const auto outcome = smooth(mesh, options());
  EXPECT_EQ(outcome.moved, 1);
  EXPECT_NEAR(position_of(mesh, 4).x, 1, 2e-3);
  EXPECT_NEAR(position_of(mesh, 4).y, 1, 2e-3);
  EXPECT_NEAR(outcome.min_angle_after_deg, 45, 0.1);
}

TEST_P(Smooth, LeavesFixedVerticesAndIsolatedOnes) {
  MeshData data = make_square(200);
  data.points.push_back({0.5, 0.5});
  std::vector<int> fixed;
  for (int v = 60; v < 200; v += 3) fixed.push_back(v);
  Mesh mesh = build_mesh(data, {.fixed = fixed});
  const Mesh before = mesh;
  EXPECT_GT(smooth(mesh, options()).moved, 30);
  EXPECT_EQ(moved_what_stays(before, mesh), "");
  for (const int v : fixed) EXPECT_EQ(position_of(mesh, v), data.points[v]);
}

TEST_P(Smooth, AnswersTheSameAgain) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Mesh first = random_tangle(seed).mesh, second = first;
    auto allow = options();
    allow.repair = allowing;
    (void)smooth(first, allow);
    (void)smooth(second, allow);
    EXPECT_TRUE(snapshot_of(first) == snapshot_of(second)) << seed;
  }
}

TEST_P(Smooth, UntanglesRandomTangles) {
  auto allow = options();
  allow.repair = allowing;
  int untangled = 0, moved = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    auto [about, mesh, was_at] = random_tangle(seed);
    const Mesh before = mesh;
    const auto outcome = smooth(mesh, allow);
    ASSERT_TRUE(outcome) << about << " " << seed << ": " << message(outcome.defect);
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_EQ(moved_what_stays(before, mesh), "") << seed;
    EXPECT_EQ(outcome.untangled > 0, n_tangled(before) > 0) << seed;
    EXPECT_EQ(outcome.replaced > 0, outcome.untangled > 0) << seed;
    untangled += outcome.untangled;
    moved += outcome.moved;
  }
  EXPECT_GT(untangled, 500);
  EXPECT_GT(moved, 500);
}

// Flat faces, vertices on edges and on one line; where vertices coincide, nothing moves.
TEST_P(Smooth, UntanglesLattices) {
  auto allow = options();
  allow.repair = allowing;
  int untangled = 0, failed = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    auto [about, mesh, was_at] = lattice_tangle(seed);
    const Mesh before = mesh;
    const auto outcome = smooth(mesh, allow);
    EXPECT_EQ(moved_what_stays(before, mesh), "") << seed;
    if (outcome) {
      untangled += outcome.untangled > 0;
      EXPECT_EQ(message(validate(mesh)), "") << seed;
      continue;
    }
    ++failed;
    EXPECT_EQ(count_moved(before, mesh), 0) << seed;
    EXPECT_EQ(message(validate_connectivity(mesh)), "") << seed;
    EXPECT_LE(n_tangled(mesh), n_tangled(before)) << seed;
  }
  EXPECT_GT(untangled, 100);
  EXPECT_GT(failed, 25);
}

// Vertices some ulps beside a lattice's: signs that rounding gets wrong.
TEST_P(Smooth, StaysValidInNearlyDegeneratePositions) {
  auto allow = options();
  allow.repair = allowing;
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    auto [about, mesh, was_at] = lattice_tangle(seed);
    Random random(seed);
    const auto near = [&](double x) { return x * (1.0 + (random.below(9) - 4) * 0x1p-52); };
    for (const Vertex v : mesh.vertices()) {
      if (is_free(mesh, v)) mesh.positions()[v] = {near(mesh.position(v).x), near(mesh.position(v).y)};
    }
    const auto outcome = smooth(mesh, allow);
    if (!outcome) continue;
    moved += outcome.moved;
    EXPECT_EQ(message(validate(mesh)), "") << about << " " << seed;
  }
  EXPECT_GT(moved, 1000);
}

// The mean of the neighbours lies, but for rounding, on the line of two of them, and so does the vertex:
// whether a face is upright there only exact signs tell.
TEST(SmoothLaplacian, TrustsExactSignsOnly) {
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const Point along{random.between(0.5, 1), random.between(-1, 1)}, across{-along.y, along.x};
    const Point shift{random.between(-1, 1), random.between(-1, 1)};
    const auto at = [&](double x, double y) { return shift + x * along + y * across; };
    const double low = random.between(-1, -0.5), high = random.between(0.5, 1);
    MeshData data;
    data.points = {at(-2, 0), at(-1, 0), at(0, low), at(3, -low - high), at(0, high), at(0.1, 0x1p-54)};
    data.triangles = {{5, 0, 1}, {5, 1, 2}, {5, 2, 3}, {5, 3, 4}, {5, 4, 0}};
    Mesh mesh = build_mesh(data);
    if (validate(mesh)) continue;
    moved += smooth(mesh, {.method = SmoothingMethod::Laplacian}).moved;
    EXPECT_EQ(message(validate(mesh)), "") << seed;
  }
  EXPECT_GT(moved, 100);
}

TEST_P(Smooth, NamesCoincidentVerticesAndMovesNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Mesh mesh = build_mesh(random_square(60, random));
    const int a = 4 + random.below(56), b = 4 + random.below(56);
    if (a == b) continue;
    place(mesh, a, position_of(mesh, b));
    const Mesh before = mesh;
    const auto outcome = smooth(mesh, options());
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.defect->kind, DefectKind::CoincidentVertices);
    EXPECT_EQ(std::minmax(outcome.defect->vertices.at(0), outcome.defect->vertices.at(1)),
              std::minmax(UserVertex(a), UserVertex(b)));
    EXPECT_EQ(count_moved(before, mesh), 0);
    EXPECT_EQ(outcome.sweeps, 0);
    EXPECT_EQ(outcome.min_angle_after_deg, 0);
    EXPECT_EQ(message(validate_connectivity(mesh)), "");
    EXPECT_LE(n_tangled(mesh), n_tangled(before));
  }
}

// A quarter turn of a dented fan: the mean of the neighbours lies outside, the vertex has to stay or go part
// of the way.
TEST_P(Smooth, DoesNotLeaveADentedFan) {
  MeshData data;
  data.points = {{0, 0}, {4, 0}, {4, 4}, {3.9, 4}, {3.5, 0.5}, {0, 0.9}, {3.7, 0.4}};
  data.triangles = {{6, 0, 1}, {6, 1, 2}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}, {6, 5, 0}};
  Mesh mesh = build_mesh(data);
  ASSERT_EQ(message(validate(mesh)), "");
  const auto outcome = smooth(mesh, options());
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg);
}

TEST_P(Smooth, RefusesNegativeOptions) {
  Mesh mesh = build_mesh(four_triangles());
  auto bad = options();
  bad.max_sweeps = -1;
  EXPECT_THROW((void)smooth(mesh, bad), InputError);
  bad = options();
  for (const double move : {-1.0, std::nan("")}) {
    bad.least_move = move;
    EXPECT_THROW((void)smooth(mesh, bad), InputError);
  }
}

}  // namespace
}  // namespace kinemesh::test
