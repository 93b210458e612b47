#include "untangle/walk/detect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "core/sweep/face_sweep.h"
#include "kinemesh/predicates.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The user's numbers of what is inverted once vertex 4 of four_triangles is at p.
std::vector<int> inverted_with_centre_at(const Point& p) {
  Mesh mesh = build_mesh(four_triangles());
  place(mesh, 4, p);
  return user_faces(mesh, detect(mesh).inverted);
}

std::vector<int> flat_with_centre_at(const Point& p) {
  Mesh mesh = build_mesh(four_triangles());
  place(mesh, 4, p);
  return user_faces(mesh, detect(mesh).flat);
}

MeshData wheel(int spokes) {
  MeshData data;
  data.points = circle({0, 0}, 1, spokes);
  data.points.push_back({0, 0});
  for (int i = 0; i < spokes; ++i) data.triangles.push_back({i, (i + 1) % spokes, spokes});
  return data;
}

TEST(Detect, FindsNothingInAValidMesh) {
  EXPECT_TRUE(detect(build_mesh(four_triangles())).empty());
}

TEST(Detect, CountsTheFacesAVertexIsPushedThrough) {
  EXPECT_THAT(inverted_with_centre_at({3, 1}), ElementsAre(1));
  EXPECT_THAT(inverted_with_centre_at({-1, 1}), ElementsAre(3));
  EXPECT_THAT(inverted_with_centre_at({3, 3}), ElementsAre(1, 2));
  EXPECT_THAT(inverted_with_centre_at({-1, -1}), ElementsAre(0, 3));
}

TEST(Detect, InvertsExactlyTheSpokeAWheelsHubLeavesThrough) {
  for (int n = 3; n < 20; ++n) {
    Mesh mesh = build_mesh(wheel(n));
    for (Side side{0}; side < n; ++side) {
      const double angle = std::numbers::pi * (2 * side + 1) / n, apothem = std::cos(std::numbers::pi / n);
      place(mesh, n, 1.01 * apothem * Point(std::cos(angle), std::sin(angle)));
      EXPECT_THAT(user_faces(mesh, detect(mesh).inverted), ElementsAre(side)) << n << " spokes";
    }
  }
}

TEST(Detect, TellsFlatFromInvertedToTheLastBit) {
  EXPECT_THAT(flat_with_centre_at({2, 1}), ElementsAre(1));
  EXPECT_THAT(inverted_with_centre_at({2, 1}), IsEmpty());
  EXPECT_THAT(inverted_with_centre_at({std::nextafter(2.0, 3.0), 1}), ElementsAre(1));
  EXPECT_THAT(flat_with_centre_at({std::nextafter(2.0, 3.0), 1}), IsEmpty());
  EXPECT_THAT(inverted_with_centre_at({std::nextafter(2.0, 1.0), 1}), IsEmpty());
  EXPECT_THAT(flat_with_centre_at({std::nextafter(2.0, 1.0), 1}), IsEmpty());
}

// A face with corners close to (1/2, 1/2), at (12, 12) and at (24, 24) [Kettner 2008, fig. 2]: the sign is
// that of the first corner's x - y, which doubles rarely get right.
TEST(Detect, IsExactOnALineThatRoundingBends) {
  MeshData data;
  data.points = {{0.5, 1}, {12, 12}, {24, 24}};
  data.triangles = {{0, 1, 2}};
  Mesh mesh = build_mesh(data);
  for (int i = -20; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) {
      place(mesh, 0, {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53});
      const Point p = position_of(mesh, 0);
      const auto found = detect(mesh);
      EXPECT_EQ(found.inverted.size(), p.x > p.y ? 1u : 0u) << i << " " << j;
      EXPECT_EQ(found.flat.size(), p.x == p.y ? 1u : 0u) << i << " " << j;
    }
  }
}

TEST(Detect, InvertsAllInAMirrorAndNothingInHalfATurn) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Mesh mesh = build_mesh(random_square(60, random));
    for (auto& p : mesh.positions()) p = -p;
    EXPECT_TRUE(detect(mesh).empty());
    for (auto& p : mesh.positions()) p.x = -p.x;
    EXPECT_EQ(static_cast<int>(detect(mesh).inverted.size()), mesh.n_faces());
    EXPECT_EQ(inverted_components(mesh, detect(mesh).inverted).count, 1);
    for (auto& p : mesh.positions()) p.x = 0;
    EXPECT_EQ(static_cast<int>(detect(mesh).flat.size()), mesh.n_faces());
  }
}

TEST(Detect, EqualsBruteForceWithAnyNumberOfThreads) {
  Random random(5);
  Mesh mesh = build_mesh(random_grid(150, 150, random));  // several tasks
  for (auto& p : mesh.positions())
    p = snapped(p * (1.0 / 16) + Point(random.between(0, 0.3), random.between(0, 0.3)));
  const auto inverted = oracle::inverted(mesh), flat = oracle::flat(mesh);
  ASSERT_GT(inverted.size(), 1000u);
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto found = detect(mesh);
    EXPECT_EQ(found.inverted, inverted);
    EXPECT_EQ(found.flat, flat);
  }
}

int count_upright(FaceMinima minima, const Mesh& mesh, const MovedBlocks& moved) {
  minima.outdate_moved(mesh, &moved);
  int upright = 0;
  for (int stretch = 0; stretch < n_stretches(mesh.n_faces()); ++stretch)
    upright += minima.is_upright(stretch);
  return upright;
}

bool is_upright(const Mesh& mesh, Vertex a, Vertex b, Vertex c) {
  return orientation(mesh.position(a), mesh.position(b), mesh.position(c)) == Orientation::CounterClockwise;
}

// Edges whose flip leaves upright faces.
void flip_some(Mesh& mesh, Random& random, FaceMinima& minima) {
  for (int i = 0; i < 300; ++i) {
    const Side edge = random_edge(mesh, random);
    if (!mesh.is_flippable(edge)) continue;
    const Vertex a = mesh.from(edge), b = mesh.to(edge);
    const Vertex c = mesh.apex(edge), d = mesh.apex(mesh.opposite(edge));
    if (!is_upright(mesh, d, b, c) || !is_upright(mesh, c, a, d)) continue;
    minima.outdate(std::array{Mesh::face_of(edge), mesh.face_across(edge)});
    mesh.flip(edge);
  }
}

// Here and there vertices move and edges are flipped, and what has become inverted stays so for a while.
TEST(Detect, LeavesAloneWhatLiesStill) {
  Random random(7);
  Mesh mesh = build_mesh(random_grid(90, 90, random), {.frame = 0.25, .fixed = {}});
  for (auto& p : mesh.positions()) p = snapped(p * (1.0 / 16));
  FaceMinima minima;
  MovedBlocks moved;
  int left_alone = 0, tangled = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Point> before(mesh.positions().begin(), mesh.positions().end());
    const int first = random.below(mesh.n_vertices());
    for (Vertex v{first}; v < std::min(first + 5, mesh.n_vertices()); ++v)
      mesh.positions()[v] += snapped({random.between(-0.05, 0.05), random.between(-0.05, 0.05)});
    moved.find(before, mesh.positions());
    left_alone += count_upright(minima, mesh, moved);
    const auto found = detect(mesh, &minima, &moved);
    ASSERT_EQ(found.inverted, oracle::inverted(mesh));
    ASSERT_EQ(found.flat, oracle::flat(mesh));
    tangled += !found.empty();
    FaceMinima anew;
    ASSERT_TRUE(detect(mesh, &anew).inverted == found.inverted);
    ASSERT_EQ(minima.update(mesh).twice_area, anew.update(mesh).twice_area);
    ASSERT_EQ(minima.update(mesh).tangent, anew.update(mesh).tangent);
    flip_some(mesh, random, minima);
    if (random.one_in(3)) {  // back to where they came from
      const std::vector<Point> there(mesh.positions().begin(), mesh.positions().end());
      std::ranges::copy(before, mesh.positions().begin());
      moved.find(there, mesh.positions());
      minima.outdate_moved(mesh, &moved);
    }
  }
  EXPECT_GT(tangled, 200);
  EXPECT_GT(left_alone, 300 * n_stretches(mesh.n_faces()) / 3);
}

TEST(Detect, MissesNoFaceOfALargeMesh) {
  Random random(6);
  Mesh mesh = build_mesh(random_grid(150, 150, random));
  for (auto& p : mesh.positions()) p.x = -p.x;
  EXPECT_EQ(static_cast<int>(detect(mesh).inverted.size()), mesh.n_faces());
}

TEST(InvertedComponents, JoinAcrossEdgesOnly) {
  Mesh mesh = build_mesh(four_triangles());
  // Faces 0 and 2 touch in vertex 4 only.
  const auto faces = [&](std::vector<int> users) {
    std::vector<Face> found;
    for (const Face f : mesh.faces()) {
      if (std::count(users.begin(), users.end(), mesh.user_face(f))) found.push_back(f);
    }
    return found;
  };
  EXPECT_EQ(inverted_components(mesh, faces({0, 2})).count, 2);
  EXPECT_EQ(inverted_components(mesh, faces({0, 1})).count, 1);
  EXPECT_EQ(inverted_components(mesh, faces({0, 1, 2, 3})).count, 1);
  EXPECT_EQ(inverted_components(mesh, {}).count, 0);
}

}  // namespace
}  // namespace kinemesh::test
