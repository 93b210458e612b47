// core/exact/overlap.h against clipping in fractions, on manufactured degeneracy.
#include "core/exact/overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

#include "kinemesh/predicates.h"
#include "tests/untangle/explore/exact_polygon.h"
#include "tests/untangle/explore/tangles.h"

namespace kinemesh::test {
namespace {

std::string text(std::span<const Shadow> triangles) {
  std::string out;
  for (const auto& t : triangles) {
    for (const Point& p : t) {
      char buffer[100];
      std::snprintf(buffer, sizeof buffer, "(%a,%a) ", p.x, p.y);
      out += buffer;
    }
    out += "| ";
  }
  return out;
}

using MakePoint = std::function<Point(Random&)>;

Shadow triangle(Random& random, const MakePoint& make) {
  for (;;) {
    const Shadow t{make(random), make(random), make(random)};
    if (orientation(t[0], t[1], t[2]) != Orientation::Collinear) return t;
  }
}

std::vector<Shadow> triangles(Random& random, int n, const MakePoint& make) {
  std::vector<Shadow> out;
  while (static_cast<int>(out.size()) < n) out.push_back(triangle(random, make));
  return out;
}

Point on_grid(Random& random) {
  return {static_cast<double>(random.below(5)), static_cast<double>(random.below(5))};
}

// Sides meet in one point, or nearly.
Point near_grid(Random& random) {
  const auto nudged = [&](double x) {
    const double infinity = std::numeric_limits<double>::infinity();
    switch (random.below(4)) {
      case 0:
        return std::nextafter(x, infinity);
      case 1:
        return std::nextafter(x, -infinity);
      default:
        return x;
    }
  };
  const Point p = on_grid(random);
  return {nudged(p.x + 1.0), nudged(p.y + 1.0)};
}

Point anywhere(Random& random) {
  return random.in_square();
}

// From 1e-150 to 1e150, all in one triangle.
Point of_any_size(Random& random) {
  return std::ldexp(1.0, random.below(997) - 498) * on_grid(random);
}

// Scaling by a power of two is exact: truth is sought at the original size, where fractions are short.
struct Kind {
  const char* name;
  MakePoint make;
  int cases;
  int exponent = 0;

  Point scaled(const Point& p) const { return std::ldexp(1.0, exponent) * p; }
  Shadow scaled(const Shadow& t) const { return {scaled(t[0]), scaled(t[1]), scaled(t[2])}; }
  std::vector<Shadow> scaled(std::vector<Shadow> all) const {
    for (Shadow& t : all) t = scaled(t);
    return all;
  }
};

std::vector<Kind> kinds() {
  return {{"grid", on_grid, 3000},
          {"near grid", near_grid, 3000},
          {"anywhere", anywhere, 500},
          {"tiny grid", on_grid, 500, -498},
          {"huge grid", on_grid, 500, 498},
          {"tiny", anywhere, 300, -498},
          {"huge", anywhere, 300, 498},
          {"small enough to underflow", near_grid, 500, -240},
          {"large enough to overflow", near_grid, 500, 240},
          {"of any size", of_any_size, 100}};
}

TEST(Overlap, OfThreeTrianglesIsThatOfClipping) {
  int pairwise_only_total = 0;
  for (const Kind& kind : kinds()) {
    Random random(1);
    int overlaps = 0, pairwise_only = 0;
    for (int i = 0; i < kind.cases; ++i) {
      const auto t = triangles(random, 3, kind.make);
      const auto s = kind.scaled(t);
      const bool expected = have_common_interior(t);
      ASSERT_EQ(interiors_overlap(s[0], s[1], s[2]), expected) << kind.name << ": " << text(t);
      overlaps += expected;
      pairwise_only += !expected && interiors_overlap(t[0], t[1]) && interiors_overlap(t[1], t[2]) &&
                       interiors_overlap(t[2], t[0]);
    }
    EXPECT_GT(overlaps, kind.cases / 100) << kind.name;
    EXPECT_LT(overlaps, kind.cases) << kind.name;
    pairwise_only_total += pairwise_only;
  }
  EXPECT_GT(pairwise_only_total, 50);
}

TEST(Overlap, DoesNotDependOnOrderOrOrientation) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    auto t = triangles(random, 3, near_grid);
    const bool expected = interiors_overlap(t[0], t[1], t[2]);
    std::swap(t[0][0], t[0][1]);
    EXPECT_EQ(interiors_overlap(t[0], t[1], t[2]), expected) << text(t);
    EXPECT_EQ(interiors_overlap(t[1], t[0], t[2]), expected) << text(t);
    EXPECT_EQ(interiors_overlap(t[2], t[0], t[1]), expected) << text(t);
  }
}

TEST(Overlap, OfManyTrianglesIsThatOfClipping) {
  for (const Kind& kind : kinds()) {
    Random random(3);
    for (int i = 0; i < kind.cases / 4; ++i) {
      const auto t = triangles(random, 1 + random.below(5), kind.make);
      ASSERT_EQ(interiors_overlap(kind.scaled(t)), have_common_interior(t)) << kind.name << ": " << text(t);
    }
  }
}

TEST(Overlap, OfASegmentIsThatOfItsIntervals) {
  for (const Kind& kind : kinds()) {
    Random random(4);
    int through = 0;
    for (int i = 0; i < kind.cases; ++i) {
      const auto t = triangles(random, random.below(4), kind.make);
      const Point a = kind.make(random), b = kind.make(random);
      const bool expected = runs_through(a, b, t);
      const auto s = kind.scaled(t);
      ASSERT_EQ(meets_interior(kind.scaled(a), kind.scaled(b), s), expected)
          << kind.name << ": " << text(t) << text({{{a, b, b}}});
      ASSERT_EQ(meets_interior(kind.scaled(b), kind.scaled(a), s), expected)
          << kind.name << ": " << text(t) << text({{{a, b, b}}});
      through += expected && t.size() > 1;
    }
    EXPECT_GT(through, kind.cases / 100) << kind.name;
  }
}

// A side of one of the triangles, as the exploration asks it.
TEST(Overlap, OfASideIsThatOfItsInterval) {
  Random random(5);
  for (int i = 0; i < 4000; ++i) {
    const auto t = triangles(random, 3, on_grid);
    const Point a = t[0][0], b = t[0][1];
    ASSERT_EQ(meets_interior(a, b, t), false) << text(t);
    ASSERT_EQ(meets_interior(a, b, std::span(t).subspan(1)), runs_through(a, b, std::span(t).subspan(1)))
        << text(t);
  }
}

TEST(SignedCover, IsThatOfSomePointOfThePiece) {
  for (const Kind& kind : kinds()) {
    Random random(6);
    int several = 0;
    for (int i = 0; i < kind.cases / 30; ++i) {
      const auto sheets = triangles(random, random.below(5), kind.make);
      const Shadow piece = triangle(random, kind.make);
      const auto expected = covers(piece, sheets);
      ASSERT_TRUE(expected.contains(signed_cover(kind.scaled(piece), kind.scaled(sheets))))
          << kind.name << ": " << text({{piece}}) << text(sheets);
      several += expected.size() > 1;
    }
    EXPECT_GT(several, 0) << kind.name;
  }
}

TEST(SignedCover, CountsUprightAndInvertedSheets) {
  const Shadow piece{{{0, 0}, {1, 0}, {0, 1}}};
  const Shadow upright{{{-1, -1}, {4, -1}, {-1, 4}}}, inverted{{{-1, -1}, {-1, 4}, {4, -1}}},
      elsewhere{{{5, 5}, {6, 5}, {5, 6}}};
  EXPECT_EQ(signed_cover(piece, {}), 0);
  EXPECT_EQ(signed_cover(piece, std::vector{piece}), 1);
  EXPECT_EQ(signed_cover(piece, std::vector{upright, inverted, upright, elsewhere}), 1);
  EXPECT_EQ(signed_cover(piece, std::vector{inverted, inverted, elsewhere}), -2);
}

// Between two neighbouring doubles on a slanted line there is none: only a fraction lies inside.
TEST(SignedCover, FindsAPointInASliverWithoutDoubles) {
  const double next = std::nextafter(1.5, 2.0);
  const Shadow sliver{{{1.0, 1.0}, {2.0, 2.0}, {1.5, next}}};
  ASSERT_NE(orientation(sliver[0], sliver[1], sliver[2]), Orientation::Collinear);
  const Shadow whole{{{0, 0}, {4, 0}, {0, 4}}}, below{{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}}};
  EXPECT_EQ(signed_cover(sliver, std::vector{whole, whole, below}), 2);
  const double ulp = 0x1p-52;
  const Shadow crumb{{{1.0, 1.0}, {1.0 + ulp, 1.0}, {1.0, 1.0 + ulp}}};
  EXPECT_EQ(signed_cover(crumb, std::vector{whole, crumb, whole}), 3);
}

// The centroid lies on sides of the sheets, and so do the next points one would try.
TEST(SignedCover, AvoidsSides) {
  const Shadow piece{{{0, 0}, {3, 0}, {0, 3}}};
  std::vector<Shadow> sheets;
  for (int i = 0; i < 12; ++i) {  // the piece cut through its centroid, both parts, again and again
    const double t = 0.25 * i;
    sheets.push_back({{{0, 0}, {3 - t, t}, {0, 3}}});
    sheets.push_back({{{0, 0}, {3, 0}, {3 - t, t}}});
  }
  sheets.erase(sheets.begin() + 1);  // flat
  EXPECT_TRUE(covers(piece, sheets) == (std::set<int>{12})) << *covers(piece, sheets).begin();
  EXPECT_EQ(signed_cover(piece, sheets), 12);
}

}  // namespace
}  // namespace kinemesh::test
