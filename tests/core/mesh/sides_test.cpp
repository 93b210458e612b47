#include "core/mesh/sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "kinemesh/shapes.h"

namespace kinemesh {
namespace {

// By a map of all edges, with their sides in ascending order.
SidePairs paired_by_map(std::span<const Triangle> triangles) {
  std::map<Edge, std::vector<int>> edges;
  const int n = 3 * static_cast<int>(triangles.size());
  for (int s = 0; s < n; ++s) {
    Edge ends = ends_of_side(triangles, s);
    std::sort(ends.begin(), ends.end());
    edges[ends].push_back(s);
  }
  SidePairs pairs{std::vector<int>(n, none), none};
  for (const auto& [ends, sides] : edges) {
    if (sides.size() == 1) continue;
    if (sides.size() == 2 && ends_of_side(triangles, sides[0]) != ends_of_side(triangles, sides[1])) {
      pairs.opposite[sides[0]] = sides[1];
      pairs.opposite[sides[1]] = sides[0];
    } else if (pairs.conflict == none) {
      pairs.conflict = sides.back() / 3;
    }
  }
  return pairs;
}

void expect_pairs(std::span<const Triangle> triangles, int n_vertices) {
  const SidePairs pairs = pair_sides(triangles, n_vertices), expected = paired_by_map(triangles);
  EXPECT_EQ(pairs.opposite, expected.opposite);
  EXPECT_EQ(pairs.conflict, expected.conflict);
}

TEST(Sides, OfAMeshInAnyOrder) {
  MeshData mesh = make_annulus(30'000);
  expect_pairs(mesh.triangles, mesh.n_vertices());
  std::mt19937 random(1);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 100)
    std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  expect_pairs(mesh.triangles, mesh.n_vertices());
}

TEST(Sides, OfAnyTriangles) {
  std::mt19937 random(2);
  for (int round = 0; round < 2000; ++round) {
    std::vector<int> vertices(3 + round % 7);
    for (int v = 0; v < static_cast<int>(vertices.size()); ++v) vertices[v] = 1000 * v;
    std::vector<Triangle> triangles(1 + round % 12);
    for (auto& t : triangles) {
      std::shuffle(vertices.begin(), vertices.end(), random);
      t = {vertices[0], vertices[1], vertices[2]};
    }
    expect_pairs(triangles, 10'000);
  }
}

TEST(Sides, OfAFan) {
  std::vector<Triangle> fan;
  for (int i = 1; i < 50'000; ++i) fan.push_back({0, i, i + 1});
  expect_pairs(fan, 50'001);
}

TEST(Sides, OfNothing) {
  expect_pairs({}, 0);
  expect_pairs({}, 10);
}

}  // namespace
}  // namespace kinemesh
