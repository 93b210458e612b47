#include "motion/border.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kinemesh/shapes.h"
#include "tests/core/mesh/disordered.h"
#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using test::grid;
using test::grid_vertex;
using test::mapped;
using testing::HasSubstr;
using enum BorderCondition;

constexpr int n = 4;

MeshData without_markers(MeshData data) {
  data.markers.clear();
  return data;
}

TEST(Freedom, IsFixedOnTheBorderUnlessSaidOtherwise) {
  const Mesh mesh = build_mesh(grid(n));
  const Freedom freedom(mesh, {});
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      EXPECT_EQ(freedom.of(grid_vertex(mesh, n, i, j)), i % n == 0 || j % n == 0 ? Fixed : Moving);
}

TEST(Freedom, TakesTheStricterWhereMarkersMeet) {
  const Mesh mesh = build_mesh(grid(n));
  const Freedom freedom(mesh, {Fixed, {{"bottom", Moving}, {"right", Slide}, {"top", Moving}}});
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 2, 0)), Moving);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, n, 2)), Slide);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 0, 2)), Fixed);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, n, 0)), Slide);  // moving and sliding
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, n, n)), Slide);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 0, 0)), Fixed);  // moving and fixed
}

TEST(Freedom, EndsWhereTwoDirectionsMeet) {
  const Mesh mesh = build_mesh(grid(n));
  const Freedom freedom(mesh, {Slide, {}});
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 0, 0)), Fixed);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, n, 0)), Fixed);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 1, 0)), Slide);
}

TEST(Freedom, SlidesFromOneMarkerToTheNextOnTheSameLine) {
  MeshData data = grid(n);
  Marker half{"bottom right", {}};
  for (int k = 0; k < 2; ++k) {
    half.edges.push_back(data.markers[0].edges.back());
    data.markers[0].edges.pop_back();
  }
  data.markers.push_back(half);
  const Mesh mesh = build_mesh(data);
  const Freedom freedom(mesh, {Fixed, {{"bottom", Slide}, {"bottom right", Slide}}});
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 2, 0)), Slide);
}

TEST(Freedom, KeepsTheTangentialPart) {
  const Mesh mesh = build_mesh(grid(n));
  const Freedom freedom(mesh, {Slide, {}});
  const auto allowed = [&](int i, int j) {
    const Vertex v = grid_vertex(mesh, n, i, j);
    return freedom.allowed(v, mesh.position(v), {3.0, 4.0});
  };
  EXPECT_EQ(allowed(1, 0), Point(3.0, 0.0));
  EXPECT_EQ(allowed(0, 1), Point(0.0, 4.0));
  EXPECT_EQ(allowed(0, 0), Point(0.0, 0.0));
  EXPECT_EQ(allowed(1, 1), Point(3.0, 4.0));
}

TEST(Freedom, SlidesAlongSlantedSidesWithinRounding) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Mesh mesh =
      build_mesh(mapped(grid(n), [&](Point p) { return Point(c * p.x - s * p.y, s * p.x + c * p.y); }),
                 {.frame = 0.1, .fixed = {}});
  const Freedom freedom(mesh, {Slide, {}});
  const Vertex v = grid_vertex(mesh, n, 1, 0);
  const Point along = freedom.allowed(v, mesh.position(v), {1.0, 0.0});
  EXPECT_NEAR(along.x, c * c, 1e-14);
  EXPECT_NEAR(along.y, c * s, 1e-14);
}

// Vertices of a bent border go along the polygon that it was, and stay on it.
TEST(Freedom, SlidesAlongABentBorder) {
  const Mesh mesh =
      build_mesh(mapped(grid(n), [](Point p) { return Point(p.x, p.y - 0.2 * p.x * (1 - p.x) * (1 - p.y)); }),
                 {.frame = 0.1, .fixed = {}});
  const Freedom freedom(mesh, {Fixed, {{"bottom", Slide}}});
  ASSERT_EQ(freedom.lines().size(), 1u);
  const SlideLine& line = freedom.lines().front();
  EXPECT_FALSE(line.is_straight());
  const Vertex v = grid_vertex(mesh, n, 1, 0);
  ASSERT_EQ(freedom.of(v), Slide);
  Point x = mesh.position(v);
  for (int step = 0; step < 1000; ++step) {
    const Point next = x + freedom.allowed(v, x, {0.0007, -0.0001});
    x = freedom.on_line(v, x, next);
    EXPECT_NEAR(glm::distance(line.at(line.parameter_near(x)), x), 0.0, 1e-15);
  }
  EXPECT_GT(x.x, mesh.position(grid_vertex(mesh, n, n - 1, 0)).x);
}

TEST(Freedom, CurvedLinesDoNotDependOnHowTheMeshIsStored) {
  const MeshData ring = make_annulus(300);
  const Mesh mesh = build_mesh(ring, {.frame = 0.1, .fixed = {}}),
             other = test::disordered(ring, {.frame = 0.7, .fixed = {}}, 1);
  ASSERT_NE(mesh.user_vertex(Vertex(50)), other.user_vertex(Vertex(50)));
  const Freedom freedom(mesh, {Slide, {}}), same(other, {Slide, {}});
  ASSERT_EQ(freedom.lines().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(std::ranges::equal(freedom.lines()[i].points(), same.lines()[i].points()));
}

TEST(Freedom, HoldsCornersOfMoreThanThirtyDegrees) {
  const Mesh mesh = build_mesh(without_markers(grid(n)));
  const Freedom freedom(mesh, {Slide, {}});
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool is_corner = i % n == 0 && j % n == 0, is_inside = i % n != 0 && j % n != 0;
      EXPECT_EQ(freedom.of(grid_vertex(mesh, n, i, j)), is_corner ? Fixed : is_inside ? Moving : Slide);
    }
  ASSERT_EQ(freedom.lines().size(), 1u);
  EXPECT_TRUE(freedom.lines().front().is_closed());
}

TEST(Freedom, RefusesToSlideWhereThreeEdgesMeet) {
  MeshData data = grid(n);
  data.markers[0].edges.push_back({1, n + 2});
  const Mesh mesh = build_mesh(data);
  try {
    Freedom(mesh, {Fixed, {{"bottom", Slide}}});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "bottom");
    EXPECT_THAT(error.what(),
                HasSubstr("marker \"bottom\" cannot slide: more than two of its edges meet at vertex 1"));
  }
}

TEST(Freedom, SlidesEachConnectedPieceOfAMarkerByItself) {
  MeshData data = grid(n);
  auto& walls = data.markers[0].edges;
  walls.insert(walls.end(), data.markers[2].edges.begin(), data.markers[2].edges.end());
  data.markers.erase(data.markers.begin() + 2);
  const Mesh mesh = build_mesh(data);
  const Freedom freedom(mesh, {Fixed, {{"bottom", Slide}}});
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 1, 0)), Slide);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 1, n)), Slide);
}

TEST(Freedom, NamesTheMarkerThatIsMissing) {
  const Mesh mesh = build_mesh(grid(n));
  try {
    Freedom(mesh, {Fixed, {{"airfoil", Moving}}});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "airfoil");
    EXPECT_STREQ(error.what(), "the mesh has no marker \"airfoil\"");
  }
}

MeshData with_middle_line(MeshData data) {
  Marker line{"line", {}};
  for (int k = 1; k + 1 < n; ++k) line.edges.push_back({2 * (n + 1) + k, 2 * (n + 1) + k + 1});
  data.markers.push_back(line);
  return data;
}

TEST(Freedom, InnerLinesMoveUnlessNamed) {
  const Mesh mesh = build_mesh(with_middle_line(grid(n)));
  const Vertex v = grid_vertex(mesh, n, 2, 2);
  ASSERT_TRUE(mesh.is_constrained(v));
  EXPECT_EQ(Freedom(mesh, {}).of(v), Moving);
  EXPECT_EQ(Freedom(mesh, {Moving, {{"line", Fixed}}}).of(v), Fixed);
  EXPECT_EQ(Freedom(mesh, {Moving, {{"line", Slide}}}).of(v), Slide);
}

TEST(Freedom, InterfacesMove) {
  MeshData data = grid(n);
  for (int face = 0; face < data.n_faces(); ++face) data.labels.push_back(face / (2 * n) < 2 ? 1 : 2);
  const Mesh mesh = build_mesh(data);
  ASSERT_TRUE(mesh.is_constrained(grid_vertex(mesh, n, 1, 2)));
  EXPECT_EQ(Freedom(mesh, {}).of(grid_vertex(mesh, n, 1, 2)), Moving);
  EXPECT_EQ(Freedom(mesh, {}).of(grid_vertex(mesh, n, 0, 2)), Fixed);
}

TEST(Freedom, NeverMovesFixedVerticesNorTheFrame) {
  const Mesh mesh = build_mesh(grid(n), {.frame = 0.5, .fixed = {2 * (n + 1) + 2}});
  const Freedom freedom(mesh, {Moving, {}});
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 2, 2)), Fixed);
  ASSERT_EQ(mesh.frame().size(), 4u);
  for (const Vertex corner : mesh.frame()) EXPECT_EQ(freedom.of(corner), Fixed);
  EXPECT_EQ(freedom.of(grid_vertex(mesh, n, 0, 0)), Moving);
}

TEST(ParseBorderCondition, KnowsThree) {
  EXPECT_EQ(parse_border_condition("fixed", "default"), Fixed);
  EXPECT_EQ(parse_border_condition("moving", "default"), Moving);
  EXPECT_EQ(parse_border_condition("slide", "default"), Slide);
  try {
    parse_border_condition("slip", "wall");
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "wall");
    EXPECT_THAT(error.what(), HasSubstr("expected fixed, moving or slide"));
  }
}

}  // namespace
}  // namespace kinemesh
