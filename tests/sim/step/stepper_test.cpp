#include "kinemesh/stepper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinemesh/build.h"
#include "kinemesh/registry.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using test::grid;
using test::grid_with_hole;
using test::snapshot;
using testing::HasSubstr;

std::vector<Point> positions_of(const Stepper& stepper) {
  return stepper.mesh().user_positions();
}

Stepper on(const MeshData& data, const std::string& strategy = "global") {
  return Stepper(build_mesh(data, {.frame = 0.25, .fixed = {}}),
                 {.strategy = strategy, .allow_escaped = false});
}

// A step that has to fail and to leave no trace.
Defect failed_step(Stepper& stepper, std::span<const Point> next) {
  const auto before = snapshot(stepper.mesh());
  const double time = stepper.time();
  const int steps = stepper.steps_done();
  const StepOutcome outcome = stepper.step(next, 0.5);
  EXPECT_FALSE(outcome);
  EXPECT_FALSE(outcome.record.accepted);
  EXPECT_EQ(snapshot(stepper.mesh()), before);
  EXPECT_EQ(stepper.time(), time);
  EXPECT_EQ(stepper.steps_done(), steps);
  return outcome.defect.value_or(Defect{});
}

TEST(Stepper, TakesAndReturnsPositionsInTheUsersOrder) {
  Stepper stepper = on(grid(6));
  auto next = positions_of(stepper);
  for (size_t v = 0; v < next.size(); ++v)
    next[v] += Point(1e-3 * std::sin(7.0 * v), 1e-3 * std::cos(5.0 * v));
  const auto outcome = stepper.step(next, 0.25);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(positions_of(stepper), next);
  EXPECT_EQ(stepper.mesh().domain().points, next);
  EXPECT_EQ(stepper.time(), 0.25);
  EXPECT_EQ(outcome.record.step, 1);
  EXPECT_EQ(outcome.record.vertices, 49);
  EXPECT_EQ(outcome.record.faces, 72);
  EXPECT_TRUE(outcome.record.accepted);
}

TEST(Stepper, DoesNothingToAMeshThatStaysValid) {
  Stepper stepper = on(grid(6));
  const auto before = snapshot(stepper.mesh());
  const auto outcome = stepper.step(positions_of(stepper), 1.0);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome.record.repair.replaced, 0);
  EXPECT_TRUE(outcome.record.repair.regions.empty());
  EXPECT_EQ(snapshot(stepper.mesh()), before);
}

TEST(Stepper, RepairsAVertexPushedThroughTheOppositeEdge) {
  for (const char* strategy : {"global", "remesh"}) {
    Stepper stepper = on(grid(6), strategy);
    auto next = positions_of(stepper);
    next[3 * 7 + 3] = {0.85, 0.55};
    const auto outcome = stepper.step(next, 1.0);
    ASSERT_TRUE(outcome) << outcome.defect->message();
    EXPECT_GT(outcome.record.repair.inverted, 0);
    EXPECT_GE(outcome.record.repair.replaced, outcome.record.repair.inverted);
    EXPECT_FALSE(validate(stepper.mesh()));
    EXPECT_EQ(stepper.mesh().n_user_faces(), 72);
  }
}

// The full re-mesh finds a valid mesh exactly where one exists: the two agree on that, and on what is kept.
TEST(Stepper, AgreesWithAFullRemeshOnWhatIsPossible) {
  int possible = 0, impossible = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> kick(-0.02 * (seed % 8), 0.02 * (seed % 8));
    Stepper global = on(grid_with_hole(8, 3, 5)), remesh = on(grid_with_hole(8, 3, 5), "remesh");
    auto next = positions_of(global);
    for (auto& p : next) p += Point(kick(random), kick(random));
    const auto one = global.step(next, 1.0), other = remesh.step(next, 1.0);
    ASSERT_EQ(static_cast<bool>(one), static_cast<bool>(other)) << seed;
    (one ? possible : impossible)++;
    if (!one) continue;
    EXPECT_FALSE(validate(global.mesh())) << seed;
    EXPECT_FALSE(validate(remesh.mesh())) << seed;
    EXPECT_EQ(global.mesh().user_positions(), remesh.mesh().user_positions());
  }
  EXPECT_GT(possible, 20);
  EXPECT_GT(impossible, 5);
}

TEST(Stepper, NamesCoincidentVertices) {
  Stepper stepper = on(grid(6));
  auto next = positions_of(stepper);
  next[24] = next[25];
  const Defect defect = failed_step(stepper, next);
  EXPECT_EQ(defect.kind, DefectKind::CoincidentVertices);
  EXPECT_THAT(defect.vertices, testing::UnorderedElementsAre(24, 25));
  EXPECT_THAT(defect.message(), HasSubstr("at time 0.5"));
}

TEST(Stepper, NamesCrossingBorders) {
  Stepper stepper = on(grid_with_hole(8, 3, 5));
  auto next = positions_of(stepper);
  next[3 * 9 + 3] = {-0.02, 0.43};  // a corner of the hole, out through the left border
  const Defect defect = failed_step(stepper, next);
  EXPECT_EQ(defect.kind, DefectKind::CrossingEdges);
  ASSERT_EQ(defect.edges.size(), 2u);
  EXPECT_NEAR(defect.where.x, 0.0, 1e-12);
}

TEST(Stepper, NamesAVertexThatLeavesTheFrame) {
  Stepper stepper = on(grid(6));
  auto next = positions_of(stepper);
  next[24] = {50.0, 50.0};
  const Defect defect = failed_step(stepper, next);
  EXPECT_EQ(defect.kind, DefectKind::LeftDomain);
  EXPECT_THAT(defect.vertices, testing::Contains(24));
}

TEST(Stepper, NamesAHullThatMovesWithoutAFrame) {
  Stepper stepper(build_mesh(grid(6)));
  auto next = positions_of(stepper);
  next[0] -= Point(0.01, 0.0);
  EXPECT_EQ(failed_step(stepper, next).kind, DefectKind::HullMoved);
}

TEST(Stepper, NamesPositionsThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Stepper stepper = on(grid(6));
    auto next = positions_of(stepper);
    next[10].y = bad;
    const Defect defect = failed_step(stepper, next);
    EXPECT_EQ(defect.kind, DefectKind::NonFinitePosition);
    EXPECT_EQ(defect.vertices, std::vector{UserVertex(10)});
    EXPECT_THAT(defect.message(), HasSubstr("time 0.5"));
  }
}

// All of them finite, but for the frame that would have to lie around them.
TEST(Stepper, NamesAFrameThatCannotFollow) {
  Stepper stepper = on(grid(6));
  auto next = positions_of(stepper);
  for (Point& p : next) p = Point(1.2e308 * p.x, 1.2e308 * p.y) + Point(5e307, 0);
  const Defect defect = failed_step(stepper, next);
  EXPECT_EQ(defect.kind, DefectKind::NonFinitePosition);
  EXPECT_THAT(defect.message(), HasSubstr("a corner of the frame"));
  EXPECT_THAT(defect.message(), HasSubstr("at time 0.5"));
}

TEST(Stepper, NamesTheFieldThatIsNotFinite) {
  Stepper stepper = on(grid(6));
  const Motion motion(stepper.mesh(), {{make_field("expression", {{"u", "1/(t-0.5)"}, {"v", "0"}}), {}}}, {},
                      Integrator::Euler);
  ASSERT_TRUE(stepper.step(motion, 0.0));
  ASSERT_TRUE(stepper.step(Motion(stepper.mesh(), {}), 0.5));
  const auto before = snapshot(stepper.mesh());
  const auto outcome = stepper.step(motion, 0.25);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.defect->kind, DefectKind::NonFinitePosition);
  EXPECT_THAT(outcome.defect->message(), HasSubstr("expression"));
  EXPECT_THAT(outcome.defect->message(), HasSubstr("0.5"));
  EXPECT_EQ(snapshot(stepper.mesh()), before);
}

TEST(Stepper, GoesOnAfterARejectedStep) {
  Stepper stepper = on(grid(6));
  auto next = positions_of(stepper);
  next[24] = next[25];
  failed_step(stepper, next);
  next[24] = {0.55, 0.45};
  ASSERT_TRUE(stepper.step(next, 0.5));
  EXPECT_EQ(stepper.steps_done(), 1);
  EXPECT_FALSE(validate(stepper.mesh()));
}

TEST(Stepper, RefusesWhatIsNoStep) {
  Stepper stepper = on(grid(6));
  const auto before = snapshot(stepper.mesh());
  const auto next = positions_of(stepper);
  EXPECT_THROW((void)stepper.step(std::span(next).first(3), 1.0), InputError);
  EXPECT_THROW((void)stepper.step(next, -1.0), InputError);
  EXPECT_THROW((void)stepper.step(next, std::nan("")), InputError);
  EXPECT_THROW(Stepper(build_mesh(grid(2)), {.strategy = "none such", .allow_escaped = false}), InputError);
  EXPECT_EQ(snapshot(stepper.mesh()), before);
}

class Throwing : public Strategy {
 public:
  std::string_view name() const override { return "throwing"; }
  RepairOutcome repair(Mesh&, const Move&) override { throw std::runtime_error("out of luck"); }
};

TEST(Stepper, IsUnchangedWhenAStrategyThrows) {
  register_strategy({"throwing", "for tests", [] { return std::make_unique<Throwing>(); }});
  Stepper stepper = on(grid(6), "throwing");
  const auto before = snapshot(stepper.mesh());
  auto next = positions_of(stepper);
  next[24] += Point(0.01, 0.0);
  EXPECT_THROW((void)stepper.step(next, 1.0), std::runtime_error);
  EXPECT_EQ(snapshot(stepper.mesh()), before);
  EXPECT_EQ(stepper.time(), 0.0);
}

// Many steps: the domain drifts across many times its own size, and its frame follows.
TEST(Stepper, FollowsADomainThatDrifts) {
  Stepper stepper = on(grid(6));
  const Motion motion(stepper.mesh(),
                      {{make_field("translate", {{"velocity", std::vector<double>{1.0, 0.5}}}), {}}},
                      {.otherwise = BorderCondition::Moving, .by_marker = {}});
  for (int n = 1; n <= 200; ++n) {
    const auto outcome = stepper.step_to(motion, 0.05 * n);
    ASSERT_TRUE(outcome) << outcome.defect->message();
  }
  EXPECT_FALSE(validate(stepper.mesh()));
  EXPECT_EQ(stepper.time(), 0.05 * 200);
  EXPECT_NEAR(stepper.mesh().user_positions()[0].x, 10.0, 1e-9);
}

}  // namespace
}  // namespace kinemesh
