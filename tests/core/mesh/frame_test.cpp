#include "core/mesh/frame.h"

#include <gtest/gtest.h>

#include "kinemesh/build.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

std::vector<Point> positions(const Mesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

// The user's vertex the hull is said to have moved at, or none.
UserVertex moved_hull(const Mesh& mesh, UserVertex user, const Point& p) {
  auto next = positions(mesh);
  next[mesh.vertex_of_user(user)] = p;
  const auto defect = hull_defect(mesh, next);
  if (!defect) return none;
  EXPECT_EQ(defect->kind, DefectKind::HullMoved);
  return defect->vertices.at(0);
}

TEST(HullDefect, NamesACornerThatMoves) {
  const Mesh mesh = build_mesh(four_triangles());
  EXPECT_EQ(moved_hull(mesh, UserVertex(4), {1.5, 0.5}), none);
  for (const Point& p :
       {Point(3, 3), Point(1.5, 1.5), Point(2, 2.5), Point(2, 1.5), Point(1, 1), Point(2, 0)})
    EXPECT_EQ(moved_hull(mesh, UserVertex(2), p), 2) << p.x << " " << p.y;
}

// Also onto the chord between its neighbours, which leaves a convex border, but another one.
TEST(HullDefect, NamesACornerThatIsCutOff) {
  EXPECT_EQ(moved_hull(build_mesh(four_triangles()), UserVertex(2), {1.25, 0.75}), 2);
}

TEST(HullDefect, LetsVerticesSlideAlongASide) {
  Random random(1);
  const Mesh mesh = build_mesh(random_grid(4, 2, random));  // vertices 0 to 4 at y = 0
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {4.9, 0}), none);
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {2.1, 0}), none);
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {4, 1e-30}), 2);
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {4, -1e-300}), 2);
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {6, 0}), 2) << "on its neighbour";
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {7, 0}), 2) << "past its neighbour";
  auto next = positions(mesh);
  next[mesh.vertex_of_user(UserVertex(1))] = {3, 0};
  next[mesh.vertex_of_user(UserVertex(2))] = {5, 0};
  next[mesh.vertex_of_user(UserVertex(3))] = {7, 0};
  EXPECT_FALSE(hull_defect(mesh, next));
  std::swap(next[mesh.vertex_of_user(UserVertex(1))], next[mesh.vertex_of_user(UserVertex(2))]);
  EXPECT_TRUE(hull_defect(mesh, next));
}

TEST(HullDefect, IsNoConcernWithAFrame) {
  const Mesh mesh = build_mesh(four_triangles(), {.frame = 1});
  EXPECT_EQ(moved_hull(mesh, UserVertex(2), {2.5, 2.5}), none);
}

TEST(Follow, LeavesTheFrameWhileTheDomainIsWellInside) {
  Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  for (const UserVertex user : Numbers<UserVertex>(5))
    mesh.positions()[mesh.vertex_of_user(user)] += Point(0.5, -0.5);
  auto next = positions(mesh);
  EXPECT_FALSE(follow(mesh, next));
  EXPECT_EQ(next, positions(mesh));
}

TEST(Follow, MovesTheFrameWithADriftingDomain) {
  Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  for (int step = 0; step < 100; ++step) {
    for (const UserVertex user : Numbers<UserVertex>(5))
      mesh.positions()[mesh.vertex_of_user(user)] += Point(0.25, 0.125);
    auto next = positions(mesh);
    EXPECT_FALSE(follow(mesh, next));
    mesh.swap_positions(next);
    for (const Vertex v : mesh.hull()) EXPECT_EQ(mesh.user_vertex(v), none);
    for (const UserVertex user : Numbers<UserVertex>(5))
      EXPECT_FALSE(is_outside_hull(mesh, mesh.position(mesh.vertex_of_user(user))));
  }
}

// Also where all of the domain has a finite place.
TEST(Follow, IsADefectWhereACornerWouldBeInfinite) {
  const Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  auto next = positions(mesh);
  for (const UserVertex user : Numbers<UserVertex>(5)) next[mesh.vertex_of_user(user)] *= 8e307;
  const auto defect = follow(mesh, next);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, DefectKind::NonFinitePosition);
  EXPECT_EQ(defect->vertices, std::vector<UserVertex>{none});
}

TEST(IsOutsideHull, IsExact) {
  const Mesh mesh = build_mesh(four_triangles());
  EXPECT_FALSE(is_outside_hull(mesh, {1, 1}));
  EXPECT_FALSE(is_outside_hull(mesh, {2, 2})) << "a hull vertex's place";
  EXPECT_TRUE(is_outside_hull(mesh, {1, 0})) << "on the hull";
  EXPECT_FALSE(is_outside_hull(mesh, {1, 5e-324}));
  EXPECT_TRUE(is_outside_hull(mesh, {1, -5e-324}));
}

}  // namespace
}  // namespace kinemesh::test
