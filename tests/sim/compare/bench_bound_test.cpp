// What Theorem 4.4 counts, against counting by brute force.
#include "sim/compare/bench_bound.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "kinemesh/build.h"
#include "kinemesh/predicates.h"
#include "kinemesh/shapes.h"
#include "untangle/explore/local_exploration.h"

namespace kinemesh::testing {
namespace {

Mesh jittered(int vertices, double way, unsigned seed) {
  Mesh mesh = build_mesh(make_square(vertices));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> kick(-way, way);
  for (const Vertex v : mesh.vertices())
    if (!mesh.is_constrained(v)) mesh.positions()[v] += Point(kick(random), kick(random));
  return mesh;
}

std::vector<Face> region_of(const Mesh& mesh, UserFace seed) {
  for (const Face face : mesh.faces()) {
    if (mesh.user_face(face) != seed) continue;
    LocalExploration exploration(mesh);
    EXPECT_TRUE(exploration.run(face));
    return exploration.faces();
  }
  return {};
}

bool is_upright(const Mesh& mesh, Face face) {
  const auto [a, b, c] = mesh.corners(face);
  return orientation(a, b, c) == Orientation::CounterClockwise;
}

int crossings_of(const Mesh& mesh, const std::vector<Face>& faces) {
  std::set<Side> edges;
  for (const Face face : faces)
    for (const Side side : mesh.sides(face))
      if (is_upright(mesh, face)) edges.insert(mesh.lower(side));
  const auto end = [&](Side edge, int which) {
    return mesh.position(which == 0 ? mesh.from(edge) : mesh.to(edge));
  };
  int count = 0;
  for (const Side e : edges)
    for (const Side g : edges) count += e < g && segments_cross(end(e, 0), end(e, 1), end(g, 0), end(g, 1));
  return count;
}

// At random points; never more than there is.
int depth_seen(const Mesh& mesh, const std::vector<Face>& faces, int n_points, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int deepest = 0;
  for (int i = 0; i < n_points; ++i) {
    const auto [a, b, c] = mesh.corners(faces[static_cast<std::size_t>(i) % faces.size()]);
    double s = unit(random), t = unit(random);
    if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
    const Point p = a + s * (b - a) + t * (c - a);
    int depth = 0;
    for (const Face face : faces) depth += strictly_inside(p, mesh.corners(face));
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

TEST(BenchBound, CountsAsBruteForceDoes) {
  std::mt19937_64 random(1);
  int n = 0, same_depth = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = jittered(150, 0.03, seed);
    for (const auto& sample : sample_bound(mesh, 20)) {
      const auto faces = region_of(mesh, sample.seed);
      ASSERT_EQ(sample.faces(), static_cast<int>(faces.size()));
      EXPECT_EQ(sample.upright,
                std::count_if(faces.begin(), faces.end(), [&](Face f) { return is_upright(mesh, f); }));
      EXPECT_EQ(sample.crossings, crossings_of(mesh, faces));
      const int seen = depth_seen(mesh, faces, 4000, random);
      EXPECT_GE(sample.depth, seen);
      same_depth += sample.depth == seen;
      EXPECT_GT(sample.explore_us, 0.0);
      ++n;
    }
  }
  EXPECT_GT(n, 30);
  EXPECT_GT(same_depth, 9 * n / 10);  // random points miss small cells at times
}

// Lemma 2.6: covered k + 1 times.
TEST(BenchBound, KnowsHowDeepTheUmbilicIs) {
  const Mesh mesh = build_mesh(make_umbilic(2, 2000));
  const auto samples = sample_bound(mesh, 1);
  ASSERT_EQ(samples.size(), 1u);
  std::mt19937_64 random(1);
  const int seen = depth_seen(mesh, region_of(mesh, samples[0].seed), 10000, random);
  EXPECT_GE(samples[0].depth, seen);
  EXPECT_GE(seen, 4);
}

TEST(BenchBound, TakesNoMoreThanAskedFor) {
  const Mesh mesh = jittered(300, 0.03, 1);
  EXPECT_EQ(sample_bound(mesh, 3).size(), 3u);
  EXPECT_TRUE(sample_bound(mesh, 0).empty());
  EXPECT_TRUE(sample_bound(build_mesh(make_square(300)), 10).empty());
}

}  // namespace
}  // namespace kinemesh::testing
