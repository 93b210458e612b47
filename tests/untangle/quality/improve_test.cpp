// From badly tangled to valid and smooth, as [Agarwal 2008, §1] proposes: smoothing and flipping in turn.
#include <gtest/gtest.h>

#include "kinemesh/delaunay.h"
#include "kinemesh/measure.h"
#include "kinemesh/smoothing.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/quality/delaunay.h"
#include "tests/untangle/quality/scattered.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

struct Totals {
  int untangled = 0;
};

Totals improve(Mesh& mesh, SmoothingMethod method) {
  Totals totals;
  DelaunayFlipping flipping;
  for (int round = 0; round < 6; ++round) {
    const auto smoothed = smooth(mesh, {.method = method});
    const auto flipped = flipping.run(mesh);
    EXPECT_TRUE(smoothed) << message(smoothed.defect);
    EXPECT_TRUE(flipped) << message(flipped.defect);
    EXPECT_EQ(flipped.untangled, 0) << "smoothing has met every face";
    totals.untangled += smoothed.untangled;
  }
  return totals;
}

// The smallest angle at the end, in degrees.
double improved_angle(const Mesh& good, const Mesh& tangled, SmoothingMethod method,
                      const std::string& about) {
  Mesh mesh = tangled;
  EXPECT_GT(n_tangled(mesh), mesh.n_faces() / 10) << about;
  const auto totals = improve(mesh, method);
  EXPECT_GT(totals.untangled, 0) << about;
  EXPECT_EQ(message(validate(mesh)), "") << about;
  EXPECT_EQ(moved_what_stays(good, mesh), "") << about;
  EXPECT_EQ(mesh.n_user_faces(), good.n_user_faces()) << about;
  EXPECT_EQ(not_delaunay(mesh), "") << about;
  return measure(mesh).min_angle_deg;
}

void expect_smooth(SmoothingMethod method, double least_angle_deg) {
  for (int number = 0; number < n_domains; ++number) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto [name, good] = domain_number(number, seed);
      const auto about = name + " " + std::to_string(seed);
      const Mesh tangled = scattered(good, seed % 2 ? 1.5 : 6.0, seed);
      const double angle = improved_angle(good, tangled, method, about);
      EXPECT_GT(angle, least_angle_deg) << about;
      Mesh only_repaired = tangled;
      ASSERT_TRUE(repair(only_repaired));
      EXPECT_LT(measure(only_repaired).min_angle_deg, angle / 2) << about;
    }
  }
}

TEST(Improve, LaplacianAndFlips) {
  expect_smooth(SmoothingMethod::Laplacian, 8.0);
}

TEST(Improve, OptimizationAndFlips) {
  expect_smooth(SmoothingMethod::Optimization, 12.0);
}

// All free vertices of a label exchanged at random: what is tangled cannot be more so.
TEST(Improve, SurvivesExchangedVertices) {
  for (int number = 0; number < n_domains; ++number) {
    const auto [about, good] = domain_number(number, 1);
    const Mesh tangled = exchanged(good, 7);
    for (const auto method : {SmoothingMethod::Laplacian, SmoothingMethod::Optimization})
      EXPECT_GT(improved_angle(good, tangled, method, about), 15.0) << about;
  }
}

}  // namespace
}  // namespace kinemesh::test
