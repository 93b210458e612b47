#include "kinemesh/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"
#include "motion/fields/expression.h"
#include "motion/fields/noise.h"
#include "motion/fields/oscillation.h"
#include "motion/fields/rigid.h"
#include "motion/fields/vortical.h"
#include "motion/restriction.h"
#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using test::grid;
using test::grid_vertex;
using testing::HasSubstr;

using Points = std::vector<Point>;

Points start(const Mesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

Points moved(const Motion& motion, Points x, double t, double dt, int steps = 1) {
  Points next(x.size());
  for (int n = 0; n < steps; ++n, x.swap(next)) motion.advance(x, t + n * dt, dt, n, next);
  return x;
}

bool same_bits(const Point& a, const Point& b) {
  return std::bit_cast<std::array<std::uint64_t, 2>>(a) == std::bit_cast<std::array<std::uint64_t, 2>>(b);
}
bool same_bits(const Points& a, const Points& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return same_bits(p, q); });
}

const BorderConditions all_moving{BorderCondition::Moving, {}};

std::shared_ptr<const VelocityField> shift(double u, double v) {
  return std::make_shared<Translation>(Point(u, v));
}

TEST(Motion, TurnsAMeshRigidlyAndInvertsNothing) {
  const Mesh mesh = build_mesh(grid(10), {.frame = 1.0, .fixed = {}});
  const Motion motion(mesh, {{std::make_shared<Rotation>(Point(0.5, 0.5), 1.0), {}}}, all_moving);
  const Points x = moved(motion, start(mesh), 0.0, 0.01, 200);
  const double c = std::cos(2.0), s = std::sin(2.0);
  for (const Vertex v : mesh.vertices()) {
    const Point r = mesh.positions()[v] - 0.5;
    const Point turned =
        mesh.user_vertex(v) == none ? mesh.positions()[v] : 0.5 + Point(c * r.x - s * r.y, s * r.x + c * r.y);
    EXPECT_LT(glm::distance(x[v], turned), 1e-9);
  }
  for (const Face face : mesh.faces()) {
    if (mesh.is_padding(face)) continue;
    const auto& [a, b, d] = mesh.triangles()[face];
    EXPECT_EQ(orientation(x[a], x[b], x[d]), Orientation::CounterClockwise);
  }
}

TEST(Motion, KeepsFixedBorders) {
  const Mesh mesh = build_mesh(grid(6));
  const Motion motion(mesh, {{shift(0.01, 0.02), {}}});
  const Points x = moved(motion, start(mesh), 0.0, 1.0);
  for (int j = 0; j <= 6; ++j)
    for (int i = 0; i <= 6; ++i) {
      const Vertex v = grid_vertex(mesh, 6, i, j);
      const bool on_border = i % 6 == 0 || j % 6 == 0;
      EXPECT_TRUE(same_bits(x[v], mesh.positions()[v]) == on_border);
      if (!on_border) {
        EXPECT_LT(glm::distance(x[v], mesh.positions()[v] + Point(0.01, 0.02)), 1e-15);
      }
    }
}

TEST(Motion, SlidingVerticesKeepTheirSide) {
  const Mesh mesh = build_mesh(grid(6));
  const Motion motion(mesh,
                      {{std::make_shared<TaylorGreen>(VortexBox{}), {}},
                       {shift(0.3, -0.7), {}},
                       {std::make_shared<Pitch>(Point(0.2, 0.1), 0.3, 2.0), {}}},
                      {BorderCondition::Slide, {}});
  const Points x = moved(motion, start(mesh), 0.0, 0.01, 5);
  for (int k = 1; k < 6; ++k) {
    EXPECT_EQ(x[grid_vertex(mesh, 6, k, 0)].y, 0.0);
    EXPECT_EQ(x[grid_vertex(mesh, 6, k, 6)].y, 1.0);
    EXPECT_EQ(x[grid_vertex(mesh, 6, 0, k)].x, 0.0);
    EXPECT_EQ(x[grid_vertex(mesh, 6, 6, k)].x, 1.0);
    EXPECT_NE(x[grid_vertex(mesh, 6, k, 0)].x, mesh.positions()[grid_vertex(mesh, 6, k, 0)].x);
  }
  for (const int i : {0, 6})
    for (const int j : {0, 6}) EXPECT_EQ(x[grid_vertex(mesh, 6, i, j)], Point(i / 6, j / 6));
}

TEST(Motion, AMarkerThatATermNamesMoves) {
  const Mesh mesh = build_mesh(grid(4), {.frame = 1.0, .fixed = {}});
  const Restriction top = parse_restriction("marker:top");
  const Vertex v = grid_vertex(mesh, 4, 2, 4), inside = grid_vertex(mesh, 4, 2, 3),
               corner = grid_vertex(mesh, 4, 0, 4);
  const Points x = moved(Motion(mesh, {{shift(0.0, 1.0), top}}), start(mesh), 0.0, 0.125);
  EXPECT_EQ(x[v], Point(0.5, 1.125));
  EXPECT_EQ(x[inside], Point(0.5, 0.75));
  EXPECT_EQ(x[corner], Point(0.0, 1.0));  // also of `left`, which is fixed
  const BorderConditions still{BorderCondition::Moving, {{"top", BorderCondition::Fixed}}};
  EXPECT_EQ(moved(Motion(mesh, {{shift(0.0, 1.0), top}}, still), start(mesh), 0.0, 0.125)[v],
            Point(0.5, 1.0));
}

TEST(Motion, AddsTermsByTheirWeights) {
  const Mesh mesh = build_mesh(grid(8), {.frame = 1.0, .fixed = {}});
  const Motion motion(mesh,
                      {{shift(1.0, 0.0), {}},
                       {shift(0.0, 2.0), parse_restriction("disc:[0.5,0.5,0.2]", std::array{0.1, 0.3})}},
                      all_moving);
  const auto w = weights(mesh, parse_restriction("disc:[0.5,0.5,0.2]", std::array{0.1, 0.3}));
  const Points x = moved(motion, start(mesh), 0.0, 0.25);
  for (const Vertex v : mesh.vertices())
    if (mesh.user_vertex(v) != none) {
      EXPECT_LT(glm::distance(x[v], mesh.positions()[v] + Point(0.25, 0.5 * w[v])), 1e-15);
    }
}

TEST(Motion, IntegratesTheSumOfVelocitiesTogether) {
  // Two halves of one swirl are that swirl; integrating them one after the other would not be.
  const Mesh mesh = build_mesh(grid(8));
  const auto half_u = std::make_shared<ExpressionVelocity>("-sin(pi*x)^2*sin(2*pi*y)*cos(pi*t/8)", "0");
  const auto half_v = std::make_shared<ExpressionVelocity>("0", "sin(pi*y)^2*sin(2*pi*x)*cos(pi*t/8)");
  const Points sum = moved(Motion(mesh, {{half_u, {}}, {half_v, {}}}), start(mesh), 0.0, 0.1, 5);
  const Points whole =
      moved(Motion(mesh, {{std::make_shared<Swirl>(VortexBox{}, 8.0), {}}}), start(mesh), 0.0, 0.1, 5);
  for (const Vertex v : mesh.vertices()) EXPECT_LT(glm::distance(sum[v], whole[v]), 1e-14);
}

TEST(Motion, UsesItsIntegrator) {
  const Mesh mesh = build_mesh(grid(4), {.frame = 2.0, .fixed = {}});
  const Motion motion(mesh, {{std::make_shared<Rotation>(Point(0.0), 1.0), {}}}, all_moving,
                      Integrator::Euler);
  const Vertex v = grid_vertex(mesh, 4, 4, 0);
  EXPECT_EQ(moved(motion, start(mesh), 0.0, 0.5)[v], Point(1.0, 0.5));
}

TEST(Motion, DisplacementsAreExactWhateverTheSteps) {
  const Mesh mesh = build_mesh(grid(6), {.frame = 1.0, .fixed = {}});
  const Pitch pitch(Point(0.3, 0.4), 0.5, 2.0);
  const Motion motion(mesh, {{std::make_shared<Pitch>(pitch), {}}}, all_moving);
  for (const int steps : {1, 7, 1000}) {
    const Points x = moved(motion, start(mesh), 0.0, 1.3 / steps, steps);
    for (const Vertex v : mesh.vertices())
      if (mesh.user_vertex(v) != none) {
        const Point& initial = mesh.positions()[v];
        EXPECT_LT(glm::distance(x[v], initial + pitch.displacement(initial, 1.3)), 1e-13);
      }
  }
}

TEST(Motion, DisplacementsStartFromTheInitialPositionsAndFade) {
  const Mesh mesh = build_mesh(grid(4), {.frame = 2.0, .fixed = {}});
  // d(X, 0) is not 0, and the second term moves the mesh away: neither matters.
  const Motion motion(mesh,
                      {{std::make_shared<ExpressionDisplacement>("x*(1+t)", "0"),
                        parse_restriction("disc:[0,0,0.4]", std::array{0.1, 1.1})},
                       {shift(0.0, 0.5), {}}},
                      all_moving);
  const auto w = weights(mesh, parse_restriction("disc:[0,0,0.4]", std::array{0.1, 1.1}));
  const Points x = moved(motion, start(mesh), 0.0, 0.1, 4);
  for (const Vertex v : mesh.vertices())
    if (mesh.user_vertex(v) != none) {
      const Point& initial = mesh.positions()[v];
      EXPECT_LT(glm::distance(x[v], initial + Point(w[v] * initial.x * 0.4, 0.2)), 1e-14);
    }
}

TEST(Motion, WeightZeroKeepsEveryBit) {
  MeshData data = grid(4);
  for (Point& p : data.points) p = p - 0.5;
  data.points[12] = {-0.0, -0.0};  // the middle
  const Mesh mesh = build_mesh(data, {.frame = 1.0, .fixed = {}});
  const Restriction corner = parse_restriction("disc:[-0.5,-0.5,0.4]");
  const auto nan = std::make_shared<ExpressionVelocity>("sqrt(-0.1-x)", "0");  // not a number at the middle
  const Motion motion(mesh, {{nan, corner},
                             {std::make_shared<Pitch>(Point(0.0), 1.0, 1.0), corner},
                             {std::make_shared<Jitter>(0.1, 1), corner}});
  const Points x = moved(motion, start(mesh), 0.0, 0.1);
  for (const Vertex v : mesh.vertices()) {
    const bool acts = mesh.positions()[v] == Point(-0.25, -0.25);
    EXPECT_NE(same_bits(x[v], mesh.positions()[v]), acts) << v;
  }
}

TEST(Motion, NoiseStaysInsideAndOffTheBorder) {
  const int n = 12;
  const Mesh mesh = build_mesh(grid(n));
  const Motion motion(
      mesh, {{std::make_shared<Jitter>(3.0, 1), {}}, {std::make_shared<Brownian>(0.1, 1), {}}}, all_moving);
  Points x = start(mesh);
  for (int step = 0; step < 50; ++step) {
    Points next(x.size());
    motion.advance(x, step * 0.1, 0.1, step, next);
    for (const Vertex v : mesh.vertices()) {
      const auto gap = [](const Point& p) { return std::min({p.x, 1 - p.x, p.y, 1 - p.y}); };
      EXPECT_LE(glm::distance(x[v], next[v]), 0.5 * gap(x[v]) + 1e-15);
      EXPECT_GE(gap(next[v]), 0.0);
    }
    x.swap(next);
  }
  EXPECT_NE(x[grid_vertex(mesh, n, 5, 5)], mesh.positions()[grid_vertex(mesh, n, 5, 5)]);
}

TEST(Motion, JitterIsMeasuredInSpacings) {
  const int n = 40;
  const Mesh mesh = build_mesh(grid(n));
  const Motion motion(mesh, {{std::make_shared<Jitter>(0.2, 9), {}}});
  const double h = std::sqrt(1.0 / ((n + 1) * (n + 1)));
  EXPECT_NEAR(motion.spacing(), h, 1e-15);
  const Points x = moved(motion, start(mesh), 0.0, 1.0);
  double largest = 0.0;
  for (const Vertex v : mesh.vertices())
    largest = std::max(largest, std::abs(x[v].x - mesh.positions()[v].x));
  EXPECT_LE(largest, 0.2 * h * (1 + 1e-12));
  EXPECT_GT(largest, 0.199 * h);
}

TEST(Motion, NoiseBelongsToTheUsersVertexNumber) {
  const int n = 8;
  const auto jitter = std::make_shared<Jitter>(0.1, 9);
  const Mesh mesh = build_mesh(grid(n));
  const Points x = moved(Motion(mesh, {{jitter, {}}}), start(mesh), 0.0, 1.0);
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) {
      const Vertex v = grid_vertex(mesh, n, i, j);
      const Point kick = jitter->kick(j * (n + 1) + i, 0, 1.0, mean_spacing(mesh));
      EXPECT_TRUE(same_bits(x[v], mesh.positions()[v] + kick));
    }
}

Motion busy(const Mesh& mesh) {
  return Motion(mesh,
                {{std::make_shared<Swirl>(VortexBox{}, 8.0), {}},
                 {std::make_shared<ExpressionVelocity>("0.1*sin(3*x+t)", "0.2*x*y"),
                  parse_restriction("marker:left", std::array{0.1, 0.7})},
                 {std::make_shared<Rotor>(Point(0.3, 0.6), 0.2, 1.0), {}},
                 {std::make_shared<Jitter>(0.3, 5), {}},
                 {std::make_shared<Brownian>(1e-3, 5), parse_restriction("disc:[0.2,0.2,0.4]")}},
                {BorderCondition::Slide, {}});
}

TEST(Motion, HasTheSameBitsWhateverTheNumberOfThreads) {
  const Mesh mesh = build_mesh(grid(150));
  Points results[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results[threads - 1] = moved(busy(mesh), start(mesh), 0.0, 0.05, 3);
  }
  EXPECT_TRUE(same_bits(results[0], results[1]));
}

TEST(Motion, DependsOnTheStateAloneNotOnTheStepsBefore) {
  const Mesh mesh = build_mesh(grid(20));
  const Motion one = busy(mesh), other = busy(mesh);
  const Points middle = moved(one, start(mesh), 0.0, 0.05, 3);
  Points a(middle.size()), b(middle.size());
  one.advance(middle, 0.15, 0.05, 3, a);
  other.advance(middle, 0.15, 0.05, 3, b);  // as after a restart
  EXPECT_TRUE(same_bits(a, b));
}

TEST(Motion, NamesTheTermThatDoesNotFitTheMesh) {
  const Mesh mesh = build_mesh(grid(4));
  try {
    Motion(mesh, {{shift(1, 0), {}}, {shift(1, 0), parse_restriction("marker:airfoil")}});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "motion.1.on");
    EXPECT_STREQ(error.what(), "on = \"marker:airfoil\": the mesh has no marker of that name");
  }
}

TEST(Motion, NamesTheFieldThatMadeAVertexNonFinite) {
  const Mesh mesh = build_mesh(grid(4));
  const Motion motion(mesh,
                      {{shift(1.0, 0.0), {}}, {std::make_shared<ExpressionVelocity>("1/(x-0.5)", "0"), {}}},
                      {}, Integrator::Euler);
  const Points x = start(mesh), next = moved(motion, x, 0.25, 0.1);
  const Vertex v = grid_vertex(mesh, 4, 2, 1);
  EXPECT_FALSE(std::isfinite(next[v].x));
  EXPECT_EQ(motion.describe_non_finite(v, x, {0.25, 0.35, 0.1, 0}),
            "field \"expression\" gives (inf, 0) at (0.5, 0.25), time 0.25");
}

TEST(Motion, NamesADisplacementThatBecomesNonFiniteWithinTheStep) {
  const Mesh mesh = build_mesh(grid(4));
  const Motion motion(mesh, {{std::make_shared<ExpressionDisplacement>("0", "sqrt(1-t)"), {}}});
  const Vertex v = grid_vertex(mesh, 4, 1, 1);
  EXPECT_TRUE(std::isnan(moved(motion, start(mesh), 0.95, 0.1)[v].y));
  EXPECT_THAT(motion.describe_non_finite(v, start(mesh), {0.95, 1.05, 0.1, 0}),
              testing::AllOf(HasSubstr("field \"displacement\" gives (0, "),
                             HasSubstr("at (0.25, 0.25), time 0.95")));
}

TEST(Motion, WithoutTermsNothingMoves) {
  const Mesh mesh = build_mesh(grid(4));
  EXPECT_TRUE(same_bits(moved(Motion(mesh, {}), start(mesh), 0.0, 1.0), start(mesh)));
}

}  // namespace
}  // namespace kinemesh
