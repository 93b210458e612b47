#include "untangle/quality/cotangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinemesh/predicates.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh {
namespace {

using test::Random;

// Two upright triangles beside the edge a, b: c to its left, d to its right.
struct Pair {
  Point a, b, c, d;

  bool is_proved() const { return cotangent_bounds({a, b, c})[0] + cotangent_bounds({b, a, d})[0] >= 0.0f; }
  bool is_delaunay() const { return in_circle(a, b, c, d) != InCircle::Inside; }
};

Pair random_pair(Random& random) {
  const auto point = [&] { return Point(random.between(-1, 1), random.between(-1, 1)); };
  for (;;) {
    const Pair pair{point(), point(), point(), point()};
    if (orientation(pair.a, pair.b, pair.c) == Orientation::CounterClockwise &&
        orientation(pair.b, pair.a, pair.d) == Orientation::CounterClockwise)
      return pair;
  }
}

// Nearly on a circle, off it by a few units in the last place.
Pair cocircular_pair(Random& random, double size) {
  const auto at = [&](double from, double to) {
    const double angle = random.between(from, to) * 2.0 * std::numbers::pi;
    return (size + size * random.between(-4e-16, 4e-16)) * Point(std::cos(angle), std::sin(angle));
  };
  return {at(0.0, 0.2), at(0.4, 0.6), at(0.25, 0.35), at(0.65, 0.95)};
}

// Corners in each of their three orders: the bounds are those of the same angles.
TEST(Cotangents, AreBoundedFromBelowAndClosely) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto [a, b, c, d] = random_pair(random);
    const auto cotangent = [](const Point& p, const Point& q, const Point& r) {  // at r
      const Point u = p - r, v = q - r;
      return static_cast<double>(((long double)u.x * v.x + (long double)u.y * v.y) /
                                 ((long double)u.x * v.y - (long double)u.y * v.x));
    };
    const auto bounds = cotangent_bounds({a, b, c});
    const double across[] = {cotangent(a, b, c), cotangent(b, c, a), cotangent(c, a, b)};
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(bounds[k], across[k]);
      EXPECT_GE(bounds[k], across[k] - 1e-6 * (1.0 + std::abs(across[k]) + across[k] * across[k]));
    }
  }
}

TEST(Cotangents, ProveMostDelaunayEdgesAndNoOther) {
  Random random(2);
  int proved = 0, delaunay = 0;
  for (int i = 0; i < 100000; ++i) {
    const Pair pair = random_pair(random);
    ASSERT_TRUE(!pair.is_proved() || pair.is_delaunay()) << i;
    proved += pair.is_proved();
    delaunay += pair.is_delaunay();
  }
  EXPECT_GT(delaunay, 40000);
  EXPECT_GT(proved, 0.999 * delaunay);
}

TEST(Cotangents, ProveNothingThatRoundingLeavesOpen) {
  Random random(3);
  int not_delaunay = 0;
  for (const double size : {1.0, 1e-8, 1e100, 1e-100, 1e-140, 1e-155, 1e-160, 1e150, 1e154, 1e160}) {
    for (int i = 0; i < 3000; ++i) {
      const Pair pair = cocircular_pair(random, size);
      ASSERT_TRUE(!pair.is_proved() || pair.is_delaunay()) << size << ", " << i;
      not_delaunay += !pair.is_delaunay();
    }
  }
  EXPECT_GT(not_delaunay, 1000);
}

// One angle of nearly two right ones, in triangles flatter and flatter, down to where signs are all that is
// left.
TEST(Cotangents, ProveNothingWrongOfFlatTriangles) {
  Random random(4);
  int proved = 0, not_delaunay = 0;
  for (int i = 0; i < 20000; ++i) {
    const double height = std::ldexp(8.0, -random.below(60)), depth = std::ldexp(8.0, -random.below(60));
    const Point shift(random.between(-1, 1), random.between(-1, 1));
    const Pair pair{Point(0, 0) + shift, Point(1, 0) + shift, Point(random.between(0, 1), height) + shift,
                    Point(random.between(0, 1), -depth) + shift};
    if (orientation(pair.a, pair.b, pair.c) != Orientation::CounterClockwise ||
        orientation(pair.b, pair.a, pair.d) != Orientation::CounterClockwise)
      continue;
    ASSERT_TRUE(!pair.is_proved() || pair.is_delaunay()) << i;
    proved += pair.is_proved();
    not_delaunay += !pair.is_delaunay();
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(not_delaunay, 10000);
}

}  // namespace
}  // namespace kinemesh
