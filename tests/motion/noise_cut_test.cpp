#include "motion/noise_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

struct Edges {
  std::vector<Point> points;
  std::vector<Edge> edges;
};

Edges random_edges(std::mt19937_64& random, int n, double length) {
  std::uniform_real_distribution<double> coordinate(0, 1), part(-length, length);
  Edges e;
  for (int i = 0; i < n; ++i) {
    const Point a(coordinate(random), coordinate(random));
    e.points.insert(e.points.end(), {a, a + Point(part(random), part(random))});
    e.edges.push_back({2 * i, 2 * i + 1});
  }
  return e;
}

double brute_force(const Edges& e, const Point& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : e.edges)
    nearest = std::min(nearest, distance_to_segment(p, e.points[a], e.points[b]));
  return nearest;
}

TEST(DistanceToSegment, MeasuresToTheInsideAndTheEnds) {
  const Point a(0.0, 0.0), b(4.0, 0.0);
  EXPECT_EQ(distance_to_segment({1.0, 2.0}, a, b), 2.0);
  EXPECT_EQ(distance_to_segment({-3.0, 4.0}, a, b), 5.0);
  EXPECT_EQ(distance_to_segment({7.0, -4.0}, a, b), 5.0);
  EXPECT_EQ(distance_to_segment({3.0, 4.0}, a, a), 5.0);
  EXPECT_EQ(distance_to_segment({0.1, 0.7}, {0.3, 0.2}, {0.1, 0.7}), 0.0);
}

TEST(SegmentIndex, AgreesWithBruteForce) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 2);
  for (const int n : {1, 7, 300}) {
    const Edges e = random_edges(random, n, 0.2);
    const SegmentIndex index(e.points, e.edges);
    for (int i = 0; i < 500; ++i) {
      const Point p(coordinate(random), coordinate(random));
      const double nearest = brute_force(e, p);
      EXPECT_NEAR(index.distance(p), nearest, 1e-14);
      EXPECT_TRUE(index.maybe_within(p, nearest * (1 + 1e-12)));
    }
  }
  EXPECT_EQ(SegmentIndex({}, {}).distance({0.0, 0.0}), std::numeric_limits<double>::infinity());
}

TEST(NoiseCut, ShortensExactlyWhatIsLongerThanHalfTheDistance) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5), angle(0, 6.3), size(0, 1);
  for (const double longest : {1e-4, 1e-2, 0.1, 1.0, 50.0})
    for (const double length : {0.02, 0.9}) {
      const Edges e = random_edges(random, 40, length);
      const NoiseCut cut(e.points, e.edges, longest);
      for (int i = 0; i < 2000; ++i) {
        const Point x(coordinate(random), coordinate(random));
        const double a = angle(random);
        const Point noise = longest * size(random) * Point(std::cos(a), std::sin(a));
        const double most = 0.5 * brute_force(e, x);
        if (glm::length(noise) <= most * (1 - 1e-12))
          EXPECT_EQ(cut(x, noise), noise);
        else
          EXPECT_NEAR(glm::distance(cut(x, noise), most / glm::length(noise) * noise), 0.0, 1e-12);
      }
    }
}

// Points beside an edge, where the grid's cells have to be marked.
TEST(NoiseCut, MissesNothingCloseToAnEdge) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 200; ++round) {
    const Edges e = random_edges(random, 3, round % 2 ? 1.0 : 1e-3);
    const double longest = std::pow(10.0, -4 * unit(random));
    const NoiseCut cut(e.points, e.edges, longest);
    for (int i = 0; i < 100; ++i) {
      const auto& [a, b] = e.edges[i % 3];
      const Point on = e.points[a] + unit(random) * (e.points[b] - e.points[a]);
      const double turn = 6.3 * unit(random);
      const Point way = 2.0 * longest * unit(random) * Point(std::cos(turn), std::sin(turn));
      const Point x = on + way,
                  noise = glm::length(way) > 0.0 ? -way / glm::length(way) * longest : Point(longest, 0);
      EXPECT_LE(glm::length(cut(x, noise)), 0.5 * brute_force(e, x) * (1 + 1e-12));
    }
  }
}

TEST(NoiseCut, NeverCrossesAnEdge) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(0, 1), angle(0, 6.3);
  const Edges e = random_edges(random, 60, 0.3);
  const NoiseCut cut(e.points, e.edges, 0.5);
  for (int i = 0; i < 5000; ++i) {
    const Point x(coordinate(random), coordinate(random));
    const double a = angle(random);
    const Point end = x + cut(x, 0.5 * Point(std::cos(a), std::sin(a)));
    for (const auto& [from, to] : e.edges) EXPECT_FALSE(segments_cross(x, end, e.points[from], e.points[to]));
  }
}

// Thousands of kicks, each cut, would halve a distance to nothing; none comes closer than it may.
TEST(NoiseCut, KeepsAVertexFromGatheringOnAnEdge) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(0, 6.3);
  const std::vector<Point> points{{0.0, 0.0}, {3.0, 1.0}};
  const std::vector<Edge> edges{{0, 1}};
  const NoiseCut cut(points, edges, 0.1, 1e-4), unlimited(points, edges, 0.1);
  Point x(1.0, 0.5), y = x, z(1.5, 0.5 + 1e-6);
  double nearest = 1.0;
  int closer = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = angle(random);
    const Point noise = 0.1 * Point(std::cos(a), std::sin(a));
    x += cut(x, noise);
    nearest = std::min(nearest, distance_to_segment(x, points[0], points[1]));
    closer += distance_to_segment(x, points[0], points[1]) < 2e-4;
    if (i < 500) y += unlimited(y, noise);
    const double before = distance_to_segment(z, points[0], points[1]);
    z += cut(z, noise);
    EXPECT_GE(distance_to_segment(z, points[0], points[1]), std::min(before, 1e-4) * (1 - 1e-9));
  }
  EXPECT_GE(nearest, 1e-4 * (1 - 1e-9));
  EXPECT_GT(closer, 100);
  EXPECT_LT(distance_to_segment(y, points[0], points[1]), 1e-8);
}

TEST(NoiseCut, LetsEverythingPassWithoutEdges) {
  EXPECT_EQ(NoiseCut({}, {}, 1.0)({3.0, 4.0}, {1.0, 0.0}), Point(1.0, 0.0));
}

TEST(NoiseCut, KeepsAVertexOnAnEdgeInPlace) {
  const std::vector<Point> points{{0.1, 0.2}, {0.7, 0.9}};
  const std::vector<Edge> edges{{0, 1}};
  const NoiseCut cut(points, edges, 1.0);
  EXPECT_EQ(cut(points[0], {1.0, 0.0}), Point(0.0, 0.0));
  EXPECT_EQ(cut(points[1], {1.0, 0.0}), Point(0.0, 0.0));
}

}  // namespace
}  // namespace kinemesh
