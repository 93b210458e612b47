// Areas compared against exact integers.
#include <gtest/gtest.h>

#include <cmath>

#include "core/exact/compare_areas.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh {
namespace {

using test::Random;
using Corners3 = std::array<Point, 3>;
__extension__ using Wide = __int128;

// Twice, of a triangle whose coordinates are integers below 2^52.
Wide area(const Corners3& t) {
  const auto i = [](double x) { return static_cast<Wide>(x); };
  const auto& [a, b, c] = t;
  return (i(b.x) - i(a.x)) * (i(c.y) - i(a.y)) - (i(b.y) - i(a.y)) * (i(c.x) - i(a.x));
}

int expected(const Corners3& s, const Corners3& t) {
  const Wide difference = area(s) - area(t);
  return (difference > 0) - (difference < 0);
}

Corners3 random_triangle(Random& random, double size) {
  Corners3 t;
  for (auto& p : t) p = {std::round(random.between(-size, size)), std::round(random.between(-size, size))};
  return t;
}

void expect_right(const Corners3& s, const Corners3& t) {
  EXPECT_EQ(compare_areas(s, t), expected(s, t));
  EXPECT_EQ(compare_areas(t, s), -expected(s, t));
  EXPECT_EQ(compare_areas({s[1], s[2], s[0]}, t), expected(s, t));
  EXPECT_EQ(compare_areas({s[1], s[0], s[2]}, {t[2], t[1], t[0]}), -expected(s, t));
}

TEST(CompareAreas, IsRightForIntegers) {
  Random random(1);
  int equal = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::exp2(random.between(1, 50));
    const auto s = random_triangle(random, size), t = random_triangle(random, size);
    expect_right(s, t);
    equal += expected(s, t) == 0;
  }
  EXPECT_GT(equal, 20);
}

// The same triangle sheared by an integer has the same area; one unit more, and the filter cannot tell.
TEST(CompareAreas, TellsTheLastBit) {
  Random random(2);
  int larger = 0;
  for (int i = 0; i < 5000; ++i) {
    const Corners3 s = random_triangle(random, 0x1p40);
    Corners3 t = s;
    const double shear = random.below(64) - 32;
    for (auto& p : t) p.x += shear * p.y;
    EXPECT_EQ(compare_areas(s, t), 0);
    t[random.below(3)].x += random.below(3) - 1;
    expect_right(s, t);
    larger += expected(t, s) > 0;
  }
  EXPECT_GT(larger, 1000);
}

TEST(CompareAreas, HoldsWhereProductsLeaveTheRange) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto s = random_triangle(random, 0x1p20), t = random_triangle(random, 0x1p20);
    for (const double scale : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000}) {
      Corners3 u = s, v = t;
      for (auto* triangle : {&u, &v})
        for (auto& p : *triangle) p *= scale;
      EXPECT_EQ(compare_areas(u, v), expected(s, t)) << scale;
      EXPECT_EQ(compare_areas(u, u), 0) << scale;
    }
  }
}

}  // namespace
}  // namespace kinemesh
