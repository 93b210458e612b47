// Vertices that move together get past where one after the other is stuck.
#include "untangle/places/joint_star.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/mesh/around.h"
#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "tests/core/mesh/disordered.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/untangle/quality/scattered.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"
#include "untangle/places/optimal_point.h"

namespace kinemesh::test {
namespace {

std::vector<FreeVertex> free_vertices(const Mesh& mesh) {
  std::vector<FreeVertex> free;
  for (const Vertex v : mesh.vertices())
    if (is_movable(mesh, v)) free.push_back({v});
  std::ranges::sort(free, {}, [&](const FreeVertex& f) { return mesh.user_vertex(f.vertex); });
  return free;
}

double angle_of(double tangent) {
  return degrees(tangent);
}

// A hexagon of equilateral triangles, three to a side, whose inner vertices are somewhere else.
Mesh shaken_hexagon(std::uint64_t seed, double amount) {
  constexpr int n = 3;
  MeshData mesh;
  std::vector<std::array<int, 2>> places;
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i)
      if (std::abs(i + j) <= n) places.push_back({i, j});
  const auto number = [&](int i, int j) {
    return static_cast<int>(std::ranges::find(places, std::array{i, j}) - places.begin());
  };
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> shake(-amount, amount);
  for (const auto& [i, j] : places) {
    const bool is_inside = std::max({std::abs(i), std::abs(j), std::abs(i + j)}) < n;
    const Point shift{shake(engine), shake(engine)};
    mesh.points.push_back(Point{i + 0.5 * j, 0.5 * std::sqrt(3.0) * j} + (is_inside ? 1.0 : 0.0) * shift);
    if (std::max({std::abs(i + 1), std::abs(j), std::abs(i + j + 1)}) <= n &&
        std::max({std::abs(i), std::abs(j + 1), std::abs(i + j + 1)}) <= n)
      mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i, j + 1)});
    if (std::max({std::abs(i + 1), std::abs(j), std::abs(i + j + 1)}) <= n &&
        std::max({std::abs(i + 1), std::abs(j - 1), std::abs(i + j)}) <= n)
      mesh.triangles.push_back({number(i, j), number(i + 1, j - 1), number(i + 1, j)});
  }
  return build_mesh(mesh, {.frame = 0.25});
}

TEST(JointStar, FindsTheBestPlacesWhereTheyAreKnown) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh mesh = shaken_hexagon(seed, 0.2);
    ASSERT_LT(measure(mesh).min_angle_deg, 55.0);
    const JointStar star(mesh, free_vertices(mesh));
    const std::vector<Point> best = star.best_places();
    EXPECT_GT(angle_of(star.tangent_at(best)), 59.0) << seed;
    EXPECT_TRUE(star.is_upright_at(best)) << seed;
  }
}

TEST(JointStar, IsNeverWorseThanItsStart) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    auto [about, mesh, was_at] = random_tangle(seed);
    ASSERT_TRUE(repair(mesh, true)) << about;
    const JointStar star(mesh, free_vertices(mesh));
    const std::vector<Point> best = star.best_places();
    EXPECT_GE(star.tangent_at(best), star.tangent()) << about;
    better += star.tangent_at(best) > 1.001 * star.tangent() && star.is_upright_at(best);
  }
  EXPECT_GT(better, 700);
}

// What the smallest angle says of places is what it is in the mesh once they are taken.
TEST(JointStar, SeesTheMesh) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh mesh = scattered(domain_number(static_cast<int>(seed) % n_domains, seed).mesh, 1.0, seed);
    ASSERT_TRUE(repair(mesh));
    const auto free = free_vertices(mesh);
    const JointStar star(mesh, free);
    const std::vector<Point> best = star.best_places();
    const auto tangent_now = [&] {
      double tangent = std::numeric_limits<double>::infinity();
      for (const Face face : star.faces())
        if (!mesh.is_padding(face))
          tangent = std::min(tangent, tangent_of_smallest_angle(mesh.corners(face)));
      return tangent;
    };
    EXPECT_NEAR(star.tangent() / tangent_now(), 1.0, 1e-9) << seed;
    for (std::size_t i = 0; i < free.size(); ++i) mesh.positions()[free[i].vertex] = best[i];
    EXPECT_NEAR(star.tangent_at(best) / tangent_now(), 1.0, 1e-9) << seed;
    const auto is_fine = [&](Face face) { return is_upright(mesh, face); };
    EXPECT_EQ(star.is_upright_at(best), std::ranges::all_of(star.faces(), is_fine)) << seed;
  }
}

// Where no vertex gets any further by itself.
TEST(JointStar, GetsPastWhereSingleVerticesAreStuck) {
  int n = 0, further = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Mesh mesh = scattered(domain_number(static_cast<int>(seed) % n_domains, seed).mesh, 0.5, seed);
    ASSERT_TRUE(repair(mesh));
    const auto free = free_vertices(mesh);
    int moved = 1;
    for (int sweep = 0; sweep < 1000 && moved != 0; ++sweep) {
      moved = 0;
      for (const auto& [v, along] : free) {
        std::vector<LinkEdge> link;
        for_each_side_from(mesh, v, [&](Side side) {
          link.push_back({mesh.position(mesh.to(side)), mesh.position(mesh.apex(side))});
        });
        const Point best = optimal_point(link, mesh.position(v));
        if (smallest_angle(link, best) <= 1.0001 * smallest_angle(link, mesh.position(v))) continue;
        mesh.positions()[v] = best;
        ++moved;
      }
    }
    if (moved != 0) continue;
    ++n;
    const JointStar star(mesh, free);
    further += angle_of(star.tangent_at(star.best_places())) > 1.02 * angle_of(star.tangent());
  }
  EXPECT_GT(n, 40);
  EXPECT_GT(further, n / 2);
}

TEST(JointStar, LeavesLinesNowhere) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Mesh mesh = shaken_hexagon(seed, 0.2);
    auto free = free_vertices(mesh);
    for (std::size_t i = 0; i < free.size(); ++i)
      free[i].along = i % 3 == 0 ? Point{1.0, 0.0} : i % 3 == 1 ? Point{0.0, 1.0} : Point{0.0, 0.0};
    const JointStar star(mesh, free);
    const std::vector<Point> best = star.best_places();
    EXPECT_GT(star.tangent_at(best), star.tangent());
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Point& was = mesh.position(free[i].vertex);
      EXPECT_TRUE(i % 3 == 0 ? best[i].y == was.y : i % 3 != 1 || best[i].x == was.x) << seed;
    }
  }
}

// Users' numbers say in which order things are summed, not the mesh's.
TEST(JointStar, DoesNotDependOnHowTheMeshIsStored) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto places_by_user = [&](bool is_turned) {
      Mesh mesh = scattered(domain_number(static_cast<int>(seed) % n_domains, seed).mesh, 1.0, seed);
      EXPECT_TRUE(repair(mesh));
      const MeshData data = mesh.domain();
      mesh = is_turned ? disordered(shuffled(data, seed), {.frame = 0.6}, seed)
                       : build_mesh(data, {.frame = 0.25});
      const auto free = free_vertices(mesh);
      const std::vector<Point> best = JointStar(mesh, free).best_places();
      std::vector<std::pair<UserVertex, Point>> places;
      for (std::size_t i = 0; i < free.size(); ++i)
        places.push_back({mesh.user_vertex(free[i].vertex), best[i]});
      return places;
    };
    EXPECT_EQ(places_by_user(false), places_by_user(true)) << seed;
  }
}

TEST(JointStar, DoesNotDependOnScaleByPowersOfTwo) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Mesh mesh = shaken_hexagon(seed, 0.2), large = mesh;
    for (Point& p : large.positions()) p = 1024.0 * p;
    std::vector<Point> best = JointStar(mesh, free_vertices(mesh)).best_places();
    for (Point& p : best) p = 1024.0 * p;
    EXPECT_EQ(best, JointStar(large, free_vertices(large)).best_places()) << seed;
  }
}

}  // namespace
}  // namespace kinemesh::test
