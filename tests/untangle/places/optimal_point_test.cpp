// Against a search that needs nothing but the angles themselves.
#include "untangle/places/optimal_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

using std::numbers::pi;

// A polygon around the origin, which sees all of it.
std::vector<LinkEdge> random_link(Random& random, int n, double eccentricity) {
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * (i + random.between(-0.35, 0.35)) / n;
    const double radius = std::exp(random.between(-eccentricity, eccentricity));
    corners.push_back(radius * Point(std::cos(angle), std::sin(angle)));
  }
  std::vector<LinkEdge> link;
  for (int i = 0; i < n; ++i) link.push_back({corners[i], corners[(i + 1) % n]});
  return link;
}

// The best of a grid, of a finer grid around that, and so on. Level sets are convex, so that the best is
// near.
double best_angle(const std::vector<LinkEdge>& link) {
  Point centre{0, 0};
  double best = 0;
  for (double reach = 3.0; reach > 1e-5; reach *= 0.4) {
    const Point middle = centre;
    for (int i = -30; i <= 30; ++i) {
      for (int j = -30; j <= 30; ++j) {
        const Point x = middle + reach / 30 * Point(i, j);
        const double angle = smallest_angle(link, x);
        if (angle <= best) continue;
        best = angle;
        centre = x;
      }
    }
  }
  return best;
}

TEST(OptimalPoint, IsTheCentreOfARegularPolygon) {
  for (int n = 3; n <= 9; ++n) {
    std::vector<LinkEdge> link;
    const auto corner = [&](int i) { return Point(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)); };
    for (int i = 0; i < n; ++i) link.push_back({corner(i), corner(i + 1)});
    const Point x = optimal_point(link, {0.23, -0.17});
    EXPECT_NEAR(smallest_angle(link, x), std::min(2 * pi / n, pi / 2 - pi / n), 1e-3) << n;
    if (n != 6) continue;  // elsewhere there may be a choice
    EXPECT_NEAR(x.x, 0, 2e-3);
    EXPECT_NEAR(x.y, 0, 2e-3);
  }
}

TEST(OptimalPoint, IsHardlyBeatenBySearch) {
  const double degree = pi / 180;
  double total = 0;
  int tried = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const auto link = random_link(random, 3 + seed % 8, 0.1 + 0.1 * (seed % 5));
    Point start{0, 0};
    for (int i = 0; i < 100; ++i) {  // wherever all is upright, near the border too
      const Point x{random.between(-1, 1), random.between(-1, 1)};
      if (smallest_angle(link, x) > 0) start = x;
    }
    ASSERT_GT(smallest_angle(link, start), 0);
    const double found = smallest_angle(link, optimal_point(link, start)), best = best_angle(link);
    EXPECT_GE(found, smallest_angle(link, start)) << seed;
    EXPECT_GT(found, best - 2 * degree) << seed;
    total += best - found;
    ++tried;
  }
  EXPECT_LT(total / tried, 0.1 * degree);
}

TEST(OptimalPoint, DoesNotDependOnScaleAndPlace) {
  for (int seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const auto link = random_link(random, 6, 0.3);
    const Point plain = optimal_point(link, {0, 0});
    for (const double scale : {0x1p-300, 0x1p-20, 0x1p100}) {
      auto scaled = link;
      for (auto& [p, q] : scaled) p *= scale, q *= scale;
      const Point x = optimal_point(scaled, {0, 0});
      EXPECT_EQ(x, scale * plain) << seed << " " << scale;
    }
  }
}

TEST(OptimalPoint, StaysWhereProductsOverflow) {
  Random random(5);
  auto link = random_link(random, 6, 0.3);
  for (auto& [p, q] : link) p *= 1e200, q *= 1e200;
  EXPECT_EQ(optimal_point(link, {1e199, 0}), Point(1e199, 0));
}

TEST(SmallestAngle, IsZeroOnceAFaceIsNotUpright) {
  Random random(3);
  const auto link = random_link(random, 5, 0.0);
  EXPECT_GT(smallest_angle(link, {0, 0}), 0.3);
  EXPECT_EQ(smallest_angle(link, {5, 0}), 0);
  EXPECT_EQ(smallest_angle(link, link[0][0]), 0);
}

}  // namespace
}  // namespace kinemesh::test
