#include "core/cdt/triangulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/mesh/winding.h"
#include "kinemesh/predicates.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

std::vector<Point> random_points(Random& random, int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.push_back({random.between(0, 1), random.between(0, 1)});
  return points;
}

// Upright, neighbours mutual and on the same edge.
void expect_consistent(const Triangulation& t, const std::vector<Point>& points) {
  for (int f = 0; f < static_cast<int>(t.triangles.size()); ++f) {
    const auto& [a, b, c] = t.triangles[f];
    EXPECT_EQ(orientation(points[a], points[b], points[c]), Orientation::CounterClockwise);
    for (int k = 0; k < 3; ++k) {
      const int g = t.neighbours[f][k];
      if (g == none) continue;
      const auto back =
          std::find(t.neighbours[g].begin(), t.neighbours[g].end(), f) - t.neighbours[g].begin();
      ASSERT_LT(back, 3);
      EXPECT_EQ(t.triangles[g][back], t.triangles[f][(k + 1) % 3]);
      EXPECT_EQ(t.edges[g][back], t.edges[f][k]);
    }
  }
}

TEST(Triangulator, IsDelaunayWithoutEdges) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const auto points = random_points(random, 20 + 30 * static_cast<int>(seed));
    Triangulation t;
    ASSERT_FALSE(Triangulator().triangulate(points, {}, t));
    expect_consistent(t, points);
    for (const auto& [a, b, c] : t.triangles) {
      for (const auto& p : points) EXPECT_NE(in_circle(points[a], points[b], points[c], p), InCircle::Inside);
    }
  }
}

TEST(Triangulator, HasEveryEdgeOnceOnEachSide) {
  Random random(4);
  auto points = random_points(random, 100);
  const auto ring = circle({0.5, 0.5}, 0.4, 30);
  std::vector<Edge> edges;
  for (int i = 0; i < 30; ++i) {
    points.push_back(ring[i]);
    edges.push_back({100 + i, 100 + (i + 1) % 30});
  }
  Triangulation t;
  ASSERT_FALSE(Triangulator().triangulate(points, edges, t));
  expect_consistent(t, points);
  std::vector<int> seen(30, 0);
  for (std::size_t f = 0; f < t.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (t.edges[f][k] == none) continue;
      ++seen[t.edges[f][k]];
      const Edge ends{t.triangles[f][k], t.triangles[f][(k + 1) % 3]};
      EXPECT_TRUE(ends == edges[t.edges[f][k]] || (Edge{ends[1], ends[0]}) == edges[t.edges[f][k]]);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 2), 30);
  const auto winding = winding_numbers(t, edges);
  for (std::size_t f = 0; f < t.triangles.size(); ++f) {
    const auto& [a, b, c] = t.triangles[f];
    const Point d = (points[a] + points[b] + points[c]) / 3.0 - Point(0.5, 0.5);
    const double distance = std::hypot(d.x, d.y);
    if (distance > 0.39 && distance < 0.41) continue;
    EXPECT_EQ(winding[f], distance < 0.4 ? 1 : 0);
  }
}

TEST(Triangulator, ReportsTheFirstOfRepeatedEdges) {
  const std::vector<Point> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.5}};
  const std::vector<Edge> edges{{0, 2}, {2, 0}, {0, 1}, {0, 2}, {1, 0}};
  Triangulation t;
  ASSERT_FALSE(Triangulator().triangulate(points, edges, t));
  std::set<int> seen;
  for (const auto& sides : t.edges) seen.insert(sides.begin(), sides.end());
  EXPECT_EQ(seen, (std::set<int>{none, 0, 2}));
}

TEST(Triangulator, NamesTheFirstContact) {
  Triangulation t;
  Triangulator triangulator;
  const std::vector<Point> points{{0, 0}, {4, 4}, {0, 4}, {4, 0}, {2, 2}, {0, 4}, {1, 3}};
  const auto same = triangulator.triangulate(points, {}, t);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->kind, Contact::Kind::CoincidentPoints);
  EXPECT_EQ(std::pair(same->first, same->second), std::pair(2, 5));

  const std::vector<Point> distinct(points.begin(), points.begin() + 5);
  const std::vector<Edge> cross{{0, 3}, {2, 3}, {0, 1}};
  const auto crossing = triangulator.triangulate(distinct, cross, t);
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->kind, Contact::Kind::CrossingEdges);
  EXPECT_EQ(std::pair(crossing->first, crossing->second), std::pair(1, 2));
  EXPECT_EQ(crossing->where, Point(2, 2));

  const auto through = triangulator.triangulate(distinct, std::vector<Edge>{{0, 1}}, t);
  ASSERT_TRUE(through);
  EXPECT_EQ(through->kind, Contact::Kind::PointOnEdge);
  EXPECT_EQ(std::pair(through->first, through->second), std::pair(4, 0));
}

TEST(Triangulator, SeesOverlappingEdges) {
  Triangulation t;
  const std::vector<Point> points{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 1}};
  for (const auto& edges : {std::vector<Edge>{{0, 2}, {1, 3}}, {{0, 3}, {1, 2}}, {{0, 1}, {1, 2}, {0, 2}}}) {
    const auto contact = Triangulator().triangulate(points, edges, t);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->kind, Contact::Kind::PointOnEdge);
  }
}

TEST(Triangulator, GivesNothingOnALine) {
  Triangulation t;
  const std::vector<Point> points{{0, 0}, {1, 1}, {2, 2}};
  EXPECT_FALSE(Triangulator().triangulate(points, {}, t));
  EXPECT_TRUE(t.triangles.empty());
}

TEST(Triangulator, AnswersTheSameAgain) {
  Random random(6);
  const auto points = random_points(random, 500);
  Triangulator kept;
  Triangulation first, second;
  ASSERT_FALSE(kept.triangulate(points, {}, first));
  Triangulation other;
  ASSERT_FALSE(kept.triangulate(random_points(random, 30), {}, other));
  ASSERT_FALSE(kept.triangulate(points, {}, second));
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST(HilbertOrder, IsAPermutation) {
  Random random(2);
  auto order = hilbert_order(random_points(random, 1000));
  std::sort(order.begin(), order.end());
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(order[i], i);
}

}  // namespace
}  // namespace kinemesh::test
