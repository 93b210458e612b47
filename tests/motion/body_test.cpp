#include "motion/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "kinemesh/motion.h"
#include "kinemesh/registry.h"
#include "motion/fields/expression.h"
#include "motion/fields/noise.h"
#include "motion/fields/oscillation.h"
#include "motion/fields/prescribed_path.h"
#include "motion/fields/rigid.h"
#include "motion/fields/vortical.h"
#include "motion/following.h"
#include "motion/restriction.h"
#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using test::grid;
using test::grid_vertex;
using test::mapped;
using testing::HasSubstr;

constexpr int n = 8;
using Points = std::vector<Point>;

// n x n squares with the four in the middle left out: a hole with the marker "hole".
MeshData grid_with_hole() {
  MeshData data = grid(n);
  std::vector<Triangle> kept;
  const auto is_in_hole = [](int cell) {
    const int i = cell % n, j = cell / n;
    return (i == n / 2 || i == n / 2 - 1) && (j == n / 2 || j == n / 2 - 1);
  };
  for (std::size_t f = 0; f < data.triangles.size(); ++f)
    if (!is_in_hole(static_cast<int>(f) / 2)) kept.push_back(data.triangles[f]);
  data.triangles = kept;
  Marker hole{"hole", {}};
  const auto v = [](int i, int j) { return j * (n + 1) + i; };
  const int a = n / 2 - 1, b = n / 2 + 1;
  for (int k = a; k < b; ++k) {
    hole.edges.push_back({v(k, a), v(k + 1, a)});
    hole.edges.push_back({v(b, k), v(b, k + 1)});
    hole.edges.push_back({v(k + 1, b), v(k, b)});
    hole.edges.push_back({v(a, k + 1), v(a, k)});
  }
  data.markers.push_back(hole);
  return data;
}

Mesh mesh_at(const Point& where) {
  return build_mesh(mapped(grid_with_hole(), [&](Point p) { return p + where; }),
                    {.frame = 0.25, .fixed = {}});
}

BodySpec hole_with(std::vector<AnyField> motion) {
  return {{"marker:hole"}, std::move(motion)};
}

AnyField turn(const Point& center, double rate) {
  return std::make_shared<Rotation>(center, rate);
}

Points positions(const Mesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

// In so many steps to `end`.
Points run(const Motion& motion, const Mesh& mesh, double end, int steps) {
  Points x = positions(mesh), next = x;
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k, x.swap(next))
    motion.advance(x, {k * dt, (k + 1) * dt, dt, static_cast<std::uint64_t>(k)}, next);
  return x;
}

double ulps(double a, double b, double largest) {
  return std::abs(a - b) / (std::nextafter(largest, 2 * largest) - largest);
}

// A turn, a swing and a way at once: one map of the initial position, exact after ten thousand steps.
TEST(Body, IsExactToRoundingWhereverItIsAndHoweverManyStepsItTook) {
  for (const double far : {0.0, 1000.0}) {
    const Point center(far + 0.5, 0.25);
    const Mesh mesh = mesh_at({far, 0.0});
    const Motion motion(mesh, {}, {}, Integrator::Rk4,
                        {hole_with({turn(center, 1.25), std::make_shared<Pitch>(center, 0.75, 2.5),
                                    std::make_shared<Plunge>(Point(3.0, 4.0), 0.5, 1.5),
                                    std::make_shared<Translation>(Point(-0.0625, 0.125))})});
    const Points x = run(motion, mesh, 16.0, 10000);
    const long double t = 16.0L;
    const long double angle = 1.25L * t + 0.75L * std::sin(2.5L * t), way = 0.5L * std::sin(1.5L * t) / 5.0L;
    for (const Vertex v : motion.bodies()[0].vertices()) {
      const Point X = mesh.position(v);
      const long double rx = static_cast<long double>(X.x) - center.x,
                        ry = static_cast<long double>(X.y) - center.y;
      const long double ex =
          center.x + std::cos(angle) * rx - std::sin(angle) * ry + 3.0L * way - 0.0625L * t;
      const long double ey = center.y + std::sin(angle) * rx + std::cos(angle) * ry + 4.0L * way + 0.125L * t;
      const double largest = std::max(std::abs(x[v].x), std::abs(x[v].y));
      EXPECT_LE(ulps(x[v].x, static_cast<double>(ex), largest), 4.0);
      EXPECT_LE(ulps(x[v].y, static_cast<double>(ey), largest), 4.0);
    }
  }
}

TEST(Body, HasTheSameBitsAtCommonTimesForHalfTheStep) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4, {hole_with({turn({0.5, 0.5}, 0.7)})});
  const Points whole = run(motion, mesh, 1.0, 16), half = run(motion, mesh, 1.0, 32);
  for (const Vertex v : motion.bodies()[0].vertices()) EXPECT_EQ(whole[v], half[v]);
}

TEST(Body, StartsBitByBitWhereItIs) {
  const Mesh mesh = mesh_at({0.1, 1e-17});
  const Motion motion(mesh, {}, {}, Integrator::Rk4, {hole_with({turn({1e6, 0.3}, 0.7)})});
  Points x1(mesh.n_vertices());
  motion.advance(mesh.positions(), {0.0, 0.0, 0.0, 0}, x1);
  for (const Vertex v : motion.bodies()[0].vertices()) EXPECT_EQ(x1[v], mesh.position(v));
}

// Neither other motions nor noise change a bit of it.
TEST(Body, NobodyElseMovesIt) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const std::vector<BodySpec> body{hole_with({turn({0.5, 0.5}, 0.7)})};
  const BorderConditions moving{BorderCondition::Moving, {}};
  const Motion alone(mesh, {}, {}, Integrator::Rk4, body);
  const Motion among(mesh,
                     {{std::make_shared<Shear>(Point(0.0, 0.0), 3.0)},
                      {std::make_shared<Jitter>(0.3, 1)},
                      {std::make_shared<Translation>(Point(1.0, 0.0)), parse_restriction("marker:hole")}},
                     moving, Integrator::Rk4, body);
  const Points a = run(alone, mesh, 0.5, 5), b = run(among, mesh, 0.5, 5);
  for (const Vertex v : alone.bodies()[0].vertices()) EXPECT_EQ(a[v], b[v]);
  const Vertex inside = grid_vertex(mesh, n, 1, 1);
  EXPECT_NE(a[inside], b[inside]);
}

TEST(Body, FieldsWithoutAPoseAreIntegratedAtItsVertices) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4,
                      {hole_with({std::make_shared<Shear>(Point(0.0, 0.0), 2.0)})});
  EXPECT_FALSE(motion.bodies()[0].is_exact());
  const Points x = run(motion, mesh, 1.0, 10);
  for (const Vertex v : motion.bodies()[0].vertices()) {
    EXPECT_NEAR(x[v].x, mesh.position(v).x + 2.0 * mesh.position(v).y, 1e-13);
    EXPECT_NEAR(x[v].y, mesh.position(v).y, 1e-13);
  }
}

TEST(Body, SaysWhatItCannotBe) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const auto error_of = [&](const BodySpec& spec) -> std::string {
    try {
      Motion(mesh, {}, {}, Integrator::Rk4, {BodySpec{{"marker:left"}, {}}, spec});
      return "";
    } catch (const ParameterError& error) {
      return error.key() + ": " + error.what();
    }
  };
  EXPECT_THAT(error_of(hole_with({turn({0, 0}, 1), turn({1, 0}, 1)})),
              HasSubstr("body.1.motion: body marker:hole: turns about two centres, (0, 0) and (1, 0)"));
  EXPECT_EQ(error_of(hole_with({turn({0, 0}, 1), std::make_shared<Pitch>(Point(0, 0), 1.0, 1.0)})), "");
  EXPECT_THAT(error_of(hole_with({std::make_shared<Jitter>(0.1, 1)})), HasSubstr("\"jitter\" is noise"));
  EXPECT_THAT(error_of({{"marker:wing"}, {}}), HasSubstr("body.1.on: on = \"marker:wing\""));
  EXPECT_THAT(error_of({{"disc:[0,0,1]"}, {}}), HasSubstr("expected marker:NAME or label:N"));
  EXPECT_THAT(error_of({{}, {}}), HasSubstr("body.1.on"));
}

TEST(Body, OfAFixedBorderStaysAndSaysSo) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4,
                      {BodySpec{{"marker:left"}, {std::make_shared<Translation>(Point(0.25, 0.0))}}});
  ASSERT_EQ(motion.notes().size(), 1u);
  EXPECT_EQ(motion.notes()[0], "body marker:left: 2 of its 9 vertices are on a fixed border and stay");
  const Points x = run(motion, mesh, 1.0, 1);
  EXPECT_EQ(x[grid_vertex(mesh, n, 0, 0)], Point(0.0, 0.0));
  EXPECT_EQ(x[grid_vertex(mesh, n, 0, 1)], Point(0.25, 0.125));
}

TEST(Body, KeepsToTheLineOfASlidingBorder) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const BorderConditions walls{BorderCondition::Fixed,
                               {{"top", BorderCondition::Slide}, {"bottom", BorderCondition::Slide}}};
  const auto moved_by = [&](const Point& velocity) {
    const Motion motion(mesh, {}, walls, Integrator::Rk4,
                        {BodySpec{{"marker:left"}, {std::make_shared<Translation>(velocity)}}});
    return run(motion, mesh, 1.0, 1)[grid_vertex(mesh, n, 0, 0)];
  };
  EXPECT_EQ(moved_by({0.0625, 0.0}), Point(0.0625, 0.0));
  try {
    (void)moved_by({0.0625, 0.01});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("body marker:left would take vertex"));
    EXPECT_THAT(error.what(), HasSubstr("off the line on which marker"));
  }
}

// The bottom goes up to the right at x = 0.5; the left end of it moves along.
TEST(Body, FollowsASlidingBorderAroundABend) {
  const auto bottom = [](double x) { return 0.25 * std::max(x - 0.5, 0.0); };
  const Mesh mesh = build_mesh(
      mapped(grid(n), [&](Point p) { return Point(p.x, p.y + (1.0 - p.y) * bottom(p.x)); }), {.frame = 0.5});
  const BorderConditions walls{BorderCondition::Fixed,
                               {{"top", BorderCondition::Slide}, {"bottom", BorderCondition::Slide}}};
  const auto moved_by = [&](const std::string& dy) {
    const auto field = std::make_shared<ExpressionDisplacement>("0.75 * t", dy);
    const Motion motion(mesh, {}, walls, Integrator::Rk4, {BodySpec{{"marker:left"}, {field}}});
    return run(motion, mesh, 1.0, 1)[grid_vertex(mesh, n, 0, 0)];
  };
  EXPECT_EQ(moved_by("(1 - y) * 0.25 * max(0.75 * t - 0.5, 0)"), Point(0.75, 0.0625));
  EXPECT_THROW((void)moved_by("0"), InputError);
}

TEST(Body, IsNotTornAtACornerOfASlidingBorder) {
  MeshData data = grid(n);
  data.markers = {{"baffle", {{0, n + 2}}}};  // inwards from a corner
  const Mesh mesh = build_mesh(data, {.frame = 0.25});
  const auto go = [&](const Point& velocity) {
    const Motion motion(mesh, {}, {BorderCondition::Slide, {}}, Integrator::Rk4,
                        {BodySpec{{"marker:baffle"}, {std::make_shared<Translation>(velocity)}}});
    EXPECT_TRUE(motion.notes().empty());
    return run(motion, mesh, 1.0, 1);
  };
  EXPECT_EQ(go({0.0, 0.0}), positions(mesh));
  try {
    (void)go({0.01, 0.0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("body marker:baffle would take vertex 0 off a corner where the border without"));
  }
}

TEST(Body, AgreesWithAnotherOnWhatTheyShare) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const BorderConditions moving{BorderCondition::Moving, {}};
  const auto go = [&](const Point& a, const Point& b) {
    const Motion motion(mesh, {}, moving, Integrator::Rk4,
                        {BodySpec{{"marker:left"}, {std::make_shared<Translation>(a)}},
                         BodySpec{{"marker:bottom"}, {std::make_shared<Translation>(b)}}});
    (void)run(motion, mesh, 1.0, 1);
  };
  EXPECT_NO_THROW(go({0.1, 0.2}, {0.1, 0.2}));
  try {
    go({0.1, 0.2}, {0.1, 0.3});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bodies marker:left and marker:bottom share vertex 0"));
  }
}

// Of two motions that name two markers with a vertex in common, it is moved once.
TEST(Motion, AVertexOfTwoMarkersMovesOnce) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const AnyField shift = std::make_shared<Translation>(Point(0.125, 0.0));
  const Motion two(mesh,
                   {{shift, parse_restriction("marker:left")}, {shift, parse_restriction("marker:bottom")}});
  const Motion one(mesh, {{shift, parse_restriction("marker:left"), {parse_restriction("marker:bottom")}}});
  for (const Motion* motion : {&two, &one}) {
    const Points x = run(*motion, mesh, 1.0, 1);
    EXPECT_EQ(x[grid_vertex(mesh, n, 0, 3)], Point(0.125, 0.375));
    EXPECT_EQ(x[grid_vertex(mesh, n, 3, 0)], Point(0.5, 0.0));
    EXPECT_EQ(x[grid_vertex(mesh, n, 0, 0)], Point(0.125, 0.0)) << "of both";
    EXPECT_EQ(x[grid_vertex(mesh, n, n, 0)], Point(1.0, 0.0)) << "of a fixed border, too";
  }
}

TEST(Motion, ALayerDoesNotBendABorderThatAnotherMotionNames) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh,
                      {{std::make_shared<Translation>(Point(0.01, 0.0)), parse_restriction("marker:hole")},
                       {std::make_shared<Translation>(Point(-0.02, 0.0)),
                        parse_restriction("marker:left", std::array{0.0, 2.0})}});
  const Points x = run(motion, mesh, 1.0, 1);
  for (const Vertex v : {grid_vertex(mesh, n, 3, 3), grid_vertex(mesh, n, 5, 4)})
    EXPECT_EQ(x[v], mesh.position(v) + Point(0.01, 0.0));
}

// ---- The interior -----------------------------------------------------------------------------------------

Points follow(const Motion& motion, const Mesh& mesh, double dt, Following& following) {
  Points x1(mesh.n_vertices());
  const TimeStep step{0.0, dt, dt, 0};
  motion.advance(mesh.positions(), step, x1);
  EXPECT_TRUE(following.follow(mesh, motion, step, x1).converged);
  return x1;
}

TEST(Following, TakesTheInteriorAlongAndLeavesTheBorderToItsOwners) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4,
                      {hole_with({std::make_shared<Translation>(Point(0.05, 0.0))})}, InteriorOptions{});
  Following following(mesh, motion.interior());
  const Points x = follow(motion, mesh, 1.0, following);
  for (const Vertex v : mesh.vertices()) {
    if (mesh.user_vertex(v) == none || mesh.is_isolated(v)) continue;
    const double way = x[v].x - mesh.position(v).x;
    if (motion.body_of(v) != none)
      EXPECT_EQ(x[v], mesh.position(v) + Point(0.05, 0.0));
    else if (mesh.is_constrained(v))
      EXPECT_EQ(x[v], mesh.position(v));
    else
      EXPECT_TRUE(way > 0.0 && way < 0.05) << way;
  }
}

TEST(Following, LeavesAllBitsWhereNothingMoves) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4, {hole_with({})}, InteriorOptions{});
  FollowingState state{Points(mesh.n_vertices(), Point(0.25, -0.5)), 1.0};
  Following following(mesh, motion.interior(), state);
  EXPECT_EQ(follow(motion, mesh, 1.0, following), positions(mesh));
}

// A shear of everything shears once, also where a wall is a body that shears with it.
TEST(Following, WhatAMotionDoesInsideIsNotDoneTwice) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const auto shear = std::make_shared<Shear>(Point(0.0, 0.0), 0.5);
  const BorderConditions moving{BorderCondition::Moving, {}};
  for (const std::vector<BodySpec>& bodies :
       {std::vector<BodySpec>{}, std::vector<BodySpec>{hole_with({shear})}}) {
    const Motion motion(mesh, {{shear}}, moving, Integrator::Rk4, bodies, InteriorOptions{});
    Following following(mesh, motion.interior());
    const Points x = follow(motion, mesh, 1.0, following);
    for (const Vertex v : mesh.vertices()) {
      if (mesh.user_vertex(v) == none || mesh.is_isolated(v)) continue;
      const Point& X = mesh.position(v);
      EXPECT_NEAR(glm::distance(x[v], Point(X.x + 0.5 * X.y, X.y)), 0.0, 1e-12);
    }
  }
}

TEST(Following, SlidingVerticesKeepTheirOrder) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const BorderConditions walls{BorderCondition::Fixed,
                               {{"top", BorderCondition::Slide}, {"bottom", BorderCondition::Slide}}};
  const Motion motion(mesh, {}, walls, Integrator::Rk4,
                      {BodySpec{{"marker:left"}, {std::make_shared<Translation>(Point(0.3, 0.0))}}},
                      InteriorOptions{});
  Following following(mesh, motion.interior());
  const Points x = follow(motion, mesh, 1.0, following);  // over two columns of vertices in one step
  for (int i = 0; i < n; ++i) {
    EXPECT_LT(x[grid_vertex(mesh, n, i, 0)].x, x[grid_vertex(mesh, n, i + 1, 0)].x);
    EXPECT_EQ(x[grid_vertex(mesh, n, i, 0)].y, 0.0);
    EXPECT_EQ(x[grid_vertex(mesh, n, i, n)].y, 1.0);
  }
}

TEST(Following, GoesOnFromTheLastStepThatCounts) {
  const Mesh mesh = mesh_at({0.0, 0.0});
  const Motion motion(mesh, {}, {}, Integrator::Rk4,
                      {hole_with({std::make_shared<Translation>(Point(0.05, 0.0))})}, InteriorOptions{});
  Following following(mesh, motion.interior());
  (void)follow(motion, mesh, 1.0, following);
  EXPECT_TRUE(following.state().increments.empty()) << "nothing has been accepted";
  following.accept();
  EXPECT_EQ(following.state().dt, 1.0);
  Following again(mesh, motion.interior(), following.state());
  EXPECT_EQ(follow(motion, mesh, 0.5, following), follow(motion, mesh, 0.5, again));
}

// ---- The field `rigid` ------------------------------------------------------------------------------------

TEST(Rigid, GoesByFormulasOrByATable) {
  const FieldParameters formulas{{"x", "2*t"}, {"angle", "pi*t"}, {"center", std::vector<double>{1.0, 0.0}}};
  const auto field = std::get<1>(make_field("rigid", formulas));
  const Point d = field->displacement({2.0, 0.0}, 0.5);
  EXPECT_NEAR(d.x, 1.0 + 0.0 - 1.0, 1e-15);
  EXPECT_NEAR(d.y, 1.0, 1e-15);

  const std::string file = testing::TempDir() + "rigid_path.csv";
  std::ofstream(file) << "t,x,y,angle\n0,0,0,0\n1,2,4,0.5\n3,2,0,0.5\n";
  const auto table = std::get<1>(make_field("rigid", {{"file", file}}));
  const auto& path = dynamic_cast<const RigidPath&>(*table);
  EXPECT_EQ(static_cast<double>(path.pose(0.5).x), 1.0);
  EXPECT_EQ(static_cast<double>(path.pose(2.0).y), 2.0);
  EXPECT_EQ(static_cast<double>(path.pose(2.0).angle), 0.5);
  EXPECT_TRUE(std::isnan(path.pose(3.5).x));
  EXPECT_THROW(make_field("rigid", {{"file", file}, {"x", "t"}}), ParameterError);
  std::ofstream(file) << "t,x,y,angle\n0,0,0,0\n0,2,4,0.5\n";
  EXPECT_THROW(make_field("rigid", {{"file", file}}), InputError);
}

}  // namespace
}  // namespace kinemesh
