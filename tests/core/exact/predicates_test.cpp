// Orientation and in-circle against exact integers, on manufactured degeneracy over the whole range of
// doubles.
#include "kinemesh/predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "tests/core/exact/exact_oracle.h"

namespace kinemesh {
namespace {

using Random = std::mt19937_64;
using Points = std::array<Point, 4>;

std::string text(const Points& p) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, "(%a,%a) (%a,%a) (%a,%a) (%a,%a)", p[0].x, p[0].y, p[1].x, p[1].y,
                p[2].x, p[2].y, p[3].x, p[3].y);
  return buffer;
}

double integer(Random& random, int lowest, int highest) {
  return lowest + static_cast<int>(random() % static_cast<unsigned>(highest - lowest + 1));
}

double uniform(Random& random) {
  return std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0;
}

double nudged(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -std::numeric_limits<double>::infinity());
  return x;
}

Point nudged(const Point& p, Random& random, int ulps) {
  return {nudged(p.x, static_cast<int>(integer(random, -ulps, ulps))),
          nudged(p.y, static_cast<int>(integer(random, -ulps, ulps)))};
}

Point grid_point(Random& random, int size) {
  return {integer(random, -size, size), integer(random, -size, size)};
}

Points grid_points(Random& random, int size) {
  return {grid_point(random, size), grid_point(random, size), grid_point(random, size),
          grid_point(random, size)};
}

Points scaled(Points p, double factor) {
  for (Point& q : p) q *= factor;
  return p;
}

// Any finite bit pattern: denormals, zeros of both signs, the largest and the smallest numbers.
double any_double(Random& random) {
  for (;;) {
    const std::uint64_t bits = random();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) return x;
  }
}

// Every stage against the next, and the laws, for one quadruple of points.
void expect_right(const Points& p) {
  const auto& [a, b, c, d] = p;
  const Orientation turn = oracle::orientation(a, b, c);
  EXPECT_EQ(orientation_exact(a, b, c), turn) << text(p);
  EXPECT_EQ(orientation(a, b, c), turn) << text(p);
  EXPECT_EQ(orientation(b, c, a), turn) << text(p);
  EXPECT_EQ(orientation(b, a, c), -turn) << text(p);
  const InCircle side = oracle::in_circle(a, b, c, d);
  const InCircle opposite = static_cast<InCircle>(-static_cast<int>(side));
  EXPECT_EQ(in_circle_exact(a, b, c, d), side) << text(p);
  EXPECT_EQ(in_circle(a, b, c, d), side) << text(p);
  EXPECT_EQ(in_circle(b, c, a, d), side) << text(p);
  EXPECT_EQ(in_circle(b, a, d, c), side) << text(p);
  EXPECT_EQ(in_circle(b, a, c, d), opposite) << text(p);
  EXPECT_EQ(in_circle(a, b, d, c), opposite) << text(p);
}

void sweep(int cases, std::uint64_t seed, const std::function<Points(Random&)>& make) {
  Random random(seed);
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) expect_right(make(random));
}

TEST(Predicates, signs_of_simple_figures) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), Orientation::CounterClockwise);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), Orientation::Clockwise);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {3, 3}), Orientation::Collinear);
  EXPECT_EQ(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, 0}), InCircle::Inside);
  EXPECT_EQ(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1}), InCircle::On);
  EXPECT_EQ(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -2}), InCircle::Outside);
}

TEST(Predicates, points_of_a_line_moved_by_ulps) {
  sweep(4000, 1, [](Random& random) {
    const Point a{uniform(random), uniform(random)}, b{uniform(random), uniform(random)};
    const double s = 3.0 * uniform(random), t = 3.0 * uniform(random);
    return Points{a, b, nudged(a + s * (b - a), random, 3), nudged(a + t * (b - a), random, 3)};
  });
}

TEST(Predicates, points_far_along_a_line_moved_by_ulps) {
  sweep(4000, 2, [](Random& random) {
    const double slope = integer(random, 1, 9), base = integer(random, 0, 3) * 0.1;
    const auto on_line = [&] {
      const double x = std::ldexp(uniform(random), static_cast<int>(integer(random, -30, 30)));
      return nudged(Point{x, base + slope * x}, random, 2);
    };
    return Points{on_line(), on_line(), on_line(), on_line()};
  });
}

TEST(Predicates, points_of_a_circle_moved_by_ulps) {
  const double lattice[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                 {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  sweep(4000, 3, [&](Random& random) {
    const Point centre = grid_point(random, 1000);
    Points p;
    for (Point& q : p) {
      const double* at = lattice[random() % 12];
      q = nudged((centre + Point{at[0], at[1]}) * 0.125, random, random() % 2 == 0 ? 0 : 1);
    }
    return p;
  });
}

TEST(Predicates, small_grids_at_every_scale) {
  for (const int exponent : {0, -52, -170, -260, -340, -500, -540, -700, -1022, -1060, -1074, 170, 256, 340,
                             500, 512, 700, 1000, 1020}) {
    SCOPED_TRACE(exponent);
    sweep(600, 4, [&](Random& random) { return scaled(grid_points(random, 4), std::ldexp(1.0, exponent)); });
  }
}

TEST(Predicates, decimal_grids_at_every_scale) {
  for (const double unit : {0.1, 1e-150, 1e-75, 1e-308, 1e75, 1e150, 1e300, 4e307}) {
    SCOPED_TRACE(unit);
    sweep(600, 5, [&](Random& random) { return scaled(grid_points(random, 4), unit); });
  }
}

TEST(Predicates, huge_offset_small_differences) {
  sweep(2000, 6, [](Random& random) {
    const double far = std::ldexp(1.0 + 0x1p-20, static_cast<int>(integer(random, 0, 1020)));
    Points p;
    for (Point& q : p) q = nudged(Point{far, -far}, random, 4);
    return p;
  });
}

TEST(Predicates, denormals_beside_normals) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  sweep(2000, 7, [](Random& random) {
    Points p = grid_points(random, 2);
    for (Point& q : p) q = random() % 2 == 0 ? q * tiny : q + Point{0.0, tiny * integer(random, -2, 2)};
    return p;
  });
}

// Products of the differences lose all but a few bits, so that only the bound for underflow saves the sign.
TEST(Predicates, products_that_underflow) {
  sweep(4000, 10, [](Random& random) {
    const Point a{uniform(random), uniform(random)}, b{uniform(random), uniform(random)};
    const Point c = nudged(a + 3.0 * uniform(random) * (b - a), random, 1000);
    const Points p{a, b, c, {uniform(random), uniform(random)}};
    return scaled(p, std::ldexp(1.0, -static_cast<int>(integer(random, 525, 545))));
  });
}

// In-circle multiplies an underflown product by the far point's huge lift.
TEST(Predicates, products_that_underflow_beside_a_far_point) {
  sweep(4000, 11, [](Random& random) {
    const auto point = [&](int exponent) {
      return std::ldexp(1.0, exponent) * Point{uniform(random), uniform(random)};
    };
    const int near = -static_cast<int>(integer(random, 525, 545));
    Points p{point(near), point(near), point(near), point(near)};
    p[random() % 4] = point(static_cast<int>(integer(random, 0, 500)));
    return p;
  });
}

// The differences are rounded across the half of the smallest denormal: the computed determinant is positive,
// the true one negative.
TEST(Predicates, wrong_sign_from_one_denormal) {
  constexpr double u = 0x1p-53;
  const auto at = [](double x, double y) { return Point{x * 0x1p-537, y * 0x1p-538}; };
  const Point a = at(1.0, 1.0), b = at(1.0 - u, 1.0 - 2.0 * u), c = at(-u * (1.0 + 0x1p-52), -0.6 * u);
  ASSERT_GT((a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x), 0.0);
  EXPECT_EQ(orientation(a, b, c), Orientation::Clockwise);
  expect_right({a, b, c, {0.0, 0.0}});
}

// The minor of b and c underflows to zero, but weighs most by the lift of a.
TEST(Predicates, wrong_side_from_an_underflow_times_a_lift) {
  const Points p{Point{0x1p500, 0x1p500}, {0x1p-200, 0.0}, {0.0, 0x1p-880}, {0.0, 0.0}};
  EXPECT_EQ(in_circle(p[0], p[1], p[2], p[3]), InCircle::Inside);
  expect_right(p);
}

TEST(Predicates, any_finite_doubles) {
  sweep(1500, 8, [](Random& random) {
    Points p;
    for (Point& q : p) q = {any_double(random), any_double(random)};
    if (random() % 2 == 0) p[2] = {p[0].x, p[1].y};
    if (random() % 2 == 0) p[3] = {p[1].x, p[0].y};
    if (random() % 4 == 0) p[1].y = p[0].y;
    return p;
  });
}

TEST(Predicates, extremes_of_the_range) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const double values[] = {0.0,       -0.0,     least, -least, 1.0, -1.0, most, -most, nudged(most, -1),
                           0x1p-1022, -0x1p-537};
  sweep(6000, 9, [&](Random& random) {
    const auto value = [&] { return values[random() % std::size(values)]; };
    Points p;
    for (Point& q : p) q = {value(), value()};
    return p;
  });
}

}  // namespace
}  // namespace kinemesh
