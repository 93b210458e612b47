// The linear programme against all of its vertices in rational numbers.
#include "untangle/places/max_min_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>

#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh {
namespace {

using test::Random;
using Rational = boost::multiprecision::cpp_rational;
using Link = std::vector<LinkEdge>;

// a x + b y + c - t >= 0, or without t.
struct Constraint3 {
  Rational a, b, c;
  int t = 0;
};

struct Place {
  Rational x, y;
};

Rational value(const Constraint3& f, const Place& p) {
  return f.a * p.x + f.b * p.y + f.c;
}

Constraint3 area_of(const LinkEdge& edge) {
  const Rational px(edge[0].x), py(edge[0].y), qx(edge[1].x), qy(edge[1].y);
  return {py - qy, qx - px, px * qy - py * qx, 1};
}

std::vector<Constraint3> sides_of_box(const Link& link) {
  Point low = link[0][0], high = low;
  for (const auto& edge : link) {
    low = {std::min(low.x, edge[0].x), std::min(low.y, edge[0].y)};
    high = {std::max(high.x, edge[0].x), std::max(high.y, edge[0].y)};
  }
  return {{1, 0, -Rational(low.x)},
          {-1, 0, Rational(high.x)},
          {0, 1, -Rational(low.y)},
          {0, -1, Rational(high.y)}};
}

Rational smallest_area(const std::vector<Constraint3>& areas, const Place& p) {
  Rational least = value(areas[0], p);
  for (const auto& f : areas) least = std::min(least, value(f, p));
  return least;
}

// Where three of the constraints hold with equality (differences take t out of those with t).
std::optional<Place> meeting_point(const Constraint3& f, const Constraint3& g, const Constraint3& h) {
  std::vector<Constraint3> lines;
  const Constraint3* with_t = nullptr;
  for (const auto* i : {&f, &g, &h}) {
    if (i->t && with_t)
      lines.push_back({i->a - with_t->a, i->b - with_t->b, i->c - with_t->c});
    else if (i->t)
      with_t = i;
    else
      lines.push_back(*i);
  }
  if (!with_t) return std::nullopt;
  const auto &l = lines[0], &m = lines[1];
  const Rational det = l.a * m.b - l.b * m.a;
  if (det == 0) return std::nullopt;
  return Place{(l.b * m.c - l.c * m.b) / det, (l.c * m.a - l.a * m.c) / det};
}

// The optimum is at a vertex of the programme: all triples of constraints.
Rational best_by_brute_force(const Link& link) {
  std::vector<Constraint3> areas, all = sides_of_box(link);
  const auto box = all;
  for (const auto& edge : link) areas.push_back(area_of(edge));
  all.insert(all.end(), areas.begin(), areas.end());
  std::optional<Rational> best;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const auto place = meeting_point(all[i], all[j], all[k]);
        if (!place) continue;
        const auto is_in = [&](const Constraint3& side) { return value(side, *place) >= 0; };
        if (!std::all_of(box.begin(), box.end(), is_in)) continue;
        const auto area = smallest_area(areas, *place);
        if (!best || area > *best) best = area;
      }
  return best.value();
}

// Closed: each point is the end of one edge and the start of the next.
Link link_of(const std::vector<Point>& points) {
  Link link;
  for (std::size_t i = 0; i < points.size(); ++i)
    link.push_back({points[i], points[(i + 1) % points.size()]});
  return link;
}

void expect_optimal(const Link& link, double size) {
  const auto place = MaxMinArea()(link);
  ASSERT_TRUE(place);
  std::vector<Constraint3> areas;
  for (const auto& edge : link) areas.push_back(area_of(edge));
  const auto reached = smallest_area(areas, {Rational(place->x), Rational(place->y)});
  const Rational miss = best_by_brute_force(link) - reached;
  EXPECT_LE(std::abs(static_cast<double>(miss)), 1e-12 * size * size) << place->x << ' ' << place->y;
}

TEST(MaxMinArea, IsTheCentreOfASquare) {
  const auto place = MaxMinArea()(link_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  ASSERT_TRUE(place);
  EXPECT_DOUBLE_EQ(place->x, 1.0);
  EXPECT_DOUBLE_EQ(place->y, 1.0);
}

TEST(MaxMinArea, IsTheBestOfAllVerticesOfTheProgramme) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    std::vector<Point> points(3 + random.below(6));
    for (auto& p : points) p = {random.between(-1, 1), random.between(-1, 1)};
    expect_optimal(link_of(points), 1.0);
  }
}

TEST(MaxMinArea, IsSoForWindingLinksFarAway) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const int n = 3 + random.below(6), turns = random.one_in(4) ? 2 : 1;
    std::vector<Point> points;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185 * turns * i / n, radius = random.between(0.2, 1);
      points.push_back(Point(1000, -1000) + radius * Point(std::cos(angle), std::sin(angle)));
    }
    expect_optimal(link_of(points), 1.0);
  }
}

// On a lattice: collinear points, points at the same place, edges of no length, ties everywhere.
TEST(MaxMinArea, IsSoForDegenerateLinks) {
  int without = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    std::vector<Point> points(3 + random.below(6));
    const int size = 1 + random.below(4);
    for (auto& p : points) p = Point(random.below(size), random.one_in(3) ? 0 : random.below(size));
    if (std::all_of(points.begin(), points.end(), [&](const Point& p) { return p == points[0]; })) {
      EXPECT_FALSE(MaxMinArea()(link_of(points)));
      ++without;
    } else {
      expect_optimal(link_of(points), size);
    }
  }
  EXPECT_GT(without, 10);
}

TEST(MaxMinArea, ScalesWithItsLink) {
  Random random(7);
  std::vector<Point> points(6);
  for (auto& p : points) p = {random.between(-1, 1), random.between(-1, 1)};
  const auto place = *MaxMinArea()(link_of(points));
  for (const double scale : {0x1p-900, 0x1p-100, 0x1p300, 0x1p1000}) {
    auto scaled = points;
    for (auto& p : scaled) p *= scale;
    EXPECT_EQ(*MaxMinArea()(link_of(scaled)), scale * place) << scale;
  }
}

TEST(MaxMinArea, HandlesALinkOfThousands) {
  std::vector<Point> points;
  for (int i = 0; i < 5000; ++i) {
    const double angle = 6.283185307179586 * i / 5000;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  const auto place = MaxMinArea()(link_of(points));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 0.0, 1e-9);
  EXPECT_NEAR(place->y, 0.0, 1e-9);
}

}  // namespace
}  // namespace kinemesh
