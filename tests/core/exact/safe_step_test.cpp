#include "kinemesh/safe_step.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/predicates.h"
#include "kinemesh/shapes.h"

namespace kinemesh {
namespace {

using Points = std::vector<Point>;

const std::vector<Triangle> one_face{{0, 1, 2}};
const Points unit{{0, 0}, {1, 0}, {0, 1}};

std::optional<SafeStep> safe(const Points& x0, const Points& x1) {
  return max_safe_step(one_face, x0, x1);
}

bool is_upright_at(const Points& x0, const Points& x1, const Triangle& t, double s) {
  std::array<Point, 3> x;
  for (int k = 0; k < 3; ++k) x[k] = (1.0 - s) * x0[t[k]] + s * x1[t[k]];
  return orientation(x[0], x[1], x[2]) == Orientation::CounterClockwise;
}

TEST(SafeStep, CornerThatCrossesTheOppositeSide) {
  // (0, 0) moves along the diagonal and meets the line x + y = 1 halfway to (1, 1).
  const auto first = safe(unit, {{1, 1}, {1, 0}, {0, 1}});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->share, 0.5);
  EXPECT_EQ(first->face, 0);
}

TEST(SafeStep, RoundsTheRootDown) {
  // Meets the line at 1/3 of the way: no double.
  const auto first = safe(unit, {{1.5, 1.5}, {1, 0}, {0, 1}});
  ASSERT_TRUE(first);
  EXPECT_LT(std::fma(3.0, first->share, -1.0), 0.0);
  EXPECT_GT(std::fma(3.0, std::nextafter(first->share, 1.0), -1.0), 0.0);
}

TEST(SafeStep, TurnsByLinearMotion) {
  // Half a turn goes through one point, all corners at once, at 1/2; the quadratic has a double root there
  // and the face is upright before and after.
  const auto half_turn = safe({{1, 0}, {0, 1}, {-1, 0}}, {{-1, 0}, {0, -1}, {1, 0}});
  ASSERT_TRUE(half_turn);
  EXPECT_EQ(half_turn->share, 0.5);
  // A quarter of a turn shrinks it and no more.
  EXPECT_FALSE(safe({{1, 0}, {0, 1}, {-1, 0}}, {{0, 1}, {-1, 0}, {0, -1}}));
}

TEST(SafeStep, InvertsForAWhileAndIsUprightAtTheEnd) {
  // (1 - 4s)(1 - 2s): inverted between 1/4 and 1/2.
  const auto first = safe(unit, {{0, 0}, {-3, 0}, {0, -1}});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->share, 0.25);
}

TEST(SafeStep, EndsOfTheStep) {
  EXPECT_FALSE(safe(unit, unit));
  EXPECT_EQ(safe(unit, {{0, 0}, {1, 0}, {2, 0}})->share, 1.0);                      // flat at the very end
  EXPECT_FALSE(safe(unit, {{0, 0}, {1, 0}, {2, 1e-300}}));                          // and almost
  EXPECT_EQ(safe({{0, 0}, {1, 0}, {2, 0}}, unit)->share, 0.0);                      // flat at the start
  EXPECT_EQ(safe({{0, 0}, {0, 1}, {1, 0}}, {{0, 0}, {0, 1}, {1, 0}})->share, 0.0);  // inverted throughout
  EXPECT_FALSE(max_safe_step({}, {}, {}));
}

TEST(SafeStep, OfAnyScale) {
  for (const double scale : {1e-300, 1e-150, 1e-8, 1e100, 1e200, 1e300}) {
    Points x0 = unit, x1{{1, 1}, {1, 0}, {0, 1}};
    for (auto* x : {&x0, &x1})
      for (Point& p : *x) p *= scale;
    ASSERT_TRUE(safe(x0, x1)) << scale;
    EXPECT_EQ(safe(x0, x1)->share, 0.5) << scale;
  }
}

TEST(SafeStep, RootsTooSmallForDoublesOfTheStep) {
  // The side is 2^-1074 away and moves by 1.
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(safe({{0, 0}, {1, 0}, {0, least}}, {{0, 0}, {1, 0}, {0, -1}})->share, 0.0);
  EXPECT_DOUBLE_EQ(safe(unit, {{0, 0}, {1, 0}, {0, -1e300}})->share, 1e-300);
}

TEST(SafeStep, TranslationIsSafe) {
  const auto data = make_square(500, 3);
  Points moved = data.points;
  for (Point& p : moved) p += Point(0.1, -1e6);
  EXPECT_FALSE(max_safe_step(data.triangles, data.points, moved));
}

// Exact orientations of rounded positions, sampled: upright up to the root, not upright soon after it.
TEST(SafeStep, AgreesWithSampling) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  int with_root = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Points x0(3), x1(3);
    for (auto* x : {&x0, &x1})
      for (Point& p : *x) p = {coordinate(random), coordinate(random)};
    if (orientation(x0[0], x0[1], x0[2]) != Orientation::CounterClockwise) std::swap(x0[1], x0[2]);
    const auto first = safe(x0, x1);
    const double share = first ? first->share : 1.0;
    for (int i = 0; i < 200; ++i)
      ASSERT_TRUE(is_upright_at(x0, x1, one_face[0], share * (i / 200.0))) << trial << " at " << i;
    if (!first) continue;
    ++with_root;
    EXPECT_FALSE(is_upright_at(x0, x1, one_face[0], share + 1e-9)) << trial;
  }
  EXPECT_GT(with_root, 1000);
}

TEST(SafeStep, OfAMeshIsTheFirstOfItsFaces) {
  std::mt19937_64 random(9);
  for (const double amplitude : {1e-6, 1e-3, 0.3}) {
    const auto data = make_square(400, 7);
    std::uniform_real_distribution<double> kick(-amplitude, amplitude);
    Points moved = data.points;
    for (Point& p : moved) p += Point(kick(random), kick(random));
    std::optional<SafeStep> first;
    for (int f = 0; f < data.n_faces(); ++f) {
      const auto of_face = max_safe_step(std::span(data.triangles).subspan(f, 1), data.points, moved);
      if (of_face && (!first || of_face->share < first->share)) first = {of_face->share, f};
    }
    for (const int threads : {1, 2}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const auto of_all = max_safe_step(data.triangles, data.points, moved);
      ASSERT_EQ(of_all.has_value(), first.has_value()) << amplitude;
      if (!first) continue;
      EXPECT_EQ(of_all->share, first->share);
      EXPECT_EQ(of_all->face, first->face);
    }
    EXPECT_EQ(first.has_value(), amplitude > 1e-4);
  }
}

TEST(SafeStep, RefusesWhatItCannotMove) {
  EXPECT_THROW((void)safe(unit, {{0, 0}}), InputError);
  EXPECT_THROW((void)safe(unit, {{0, 0}, {1, 0}, {0, NAN}}), InputError);
  EXPECT_THROW((void)max_safe_step(std::vector<Triangle>{{0, 1, 3}}, unit, unit), InputError);
}

}  // namespace
}  // namespace kinemesh
