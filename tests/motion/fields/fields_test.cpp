// Fields against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "motion/fields/compose.h"
#include "motion/fields/oscillation.h"
#include "motion/fields/rigid.h"
#include "motion/fields/vortical.h"
#include "motion/integrator.h"

namespace kinemesh {
namespace {

using std::numbers::pi;

void expect_near(const Point& a, const Point& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

Point travel(const VelocityField& field, Point x, double t, double end, int steps,
             Integrator method = Integrator::Rk4) {
  const auto v = [&](const Point& p, double s) { return field.velocity(p, s); };
  const double dt = (end - t) / steps;
  for (int n = 0; n < steps; ++n) x += integrate(method, v, x, t + n * dt, dt);
  return x;
}

std::vector<Point> random_points(int n, double low, double high) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(low, high);
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.emplace_back(coordinate(random), coordinate(random));
  return points;
}

double divergence(const VelocityField& field, const Point& x, double t) {
  const double h = 1e-5;
  const auto v = [&](double dx, double dy) { return field.velocity(x + Point(dx, dy), t); };
  return (v(h, 0).x - v(-h, 0).x + v(0, h).y - v(0, -h).y) / (2.0 * h);
}

TEST(Rotation, FollowsTheCircle) {
  const Rotation field({1.0, -2.0}, 0.7);
  const Point start(1.5, -1.0), r = start - Point(1.0, -2.0);
  for (const double t : {0.1, 1.0, 9.0}) {
    const double c = std::cos(0.7 * t), s = std::sin(0.7 * t);
    expect_near(travel(field, start, 0.0, t, 500),
                Point(1.0, -2.0) + Point(c * r.x - s * r.y, s * r.x + c * r.y), 1e-8);
  }
}

TEST(Rotation, ZalesaksTurnsTheUnitSquareOncePerPeriod) {
  const ZalesakRotation field(628.0);
  EXPECT_EQ(field.name(), "zalesak");
  // On Zalesak's grid of 100 cells: u = (pi/314)(50 - y), v = (pi/314)(x - 50).
  expect_near(100.0 * field.velocity({0.3, 0.9}, 0.0), Point(pi / 314 * (50 - 90), pi / 314 * (30 - 50)),
              1e-14);
  expect_near(travel(field, {0.5, 0.75}, 0.0, 157.0, 200), {0.25, 0.5}, 1e-9);
  expect_near(travel(field, {0.5, 0.75}, 0.0, 628.0, 800), {0.5, 0.75}, 1e-9);
}

TEST(Translation, IsTheSameEverywhere) {
  const Translation field({3.0, -1.0});
  for (const Point& x : random_points(10, -5, 5)) EXPECT_EQ(field.velocity(x, x.x), Point(3.0, -1.0));
}

TEST(Shear, MovesLayersByTheirHeight) {
  const Shear field({0.0, 1.0}, 2.0);
  EXPECT_EQ(travel(field, {0.25, 3.0}, 0.0, 1.0, 1, Integrator::Euler), Point(4.25, 3.0));
  EXPECT_EQ(field.velocity({17.0, 1.0}, 3.0), Point(0.0, 0.0));
}

TEST(Rotor, TurnsTheDiscRigidlyAndNothingElse) {
  const Rotor field({1.0, 1.0}, 0.5, 2.0);
  for (const double t : {0.0, 0.3, 12.0}) {
    EXPECT_EQ(field.displacement({1.6, 1.0}, t), Point(0.0, 0.0));
    const Point turned = Point(1.5, 1.0) + field.displacement({1.5, 1.0}, t);
    expect_near(turned, {1.0 + 0.5 * std::cos(2.0 * t), 1.0 + 0.5 * std::sin(2.0 * t)}, 1e-14);
  }
}

TEST(TurnedMinusSelf, LosesNoDigitsAtSmallAngles) {
  const double a = 1e-9;
  const Point d = turned_minus_self({1.0, 0.0}, a);
  EXPECT_NEAR(d.x / (-0.5 * a * a), 1.0, 1e-12);  // cos(a) - 1 would give 0
  EXPECT_NEAR(d.y / a, 1.0, 1e-12);
}

TEST(Pitch, IsExactAtAnyTime) {
  const double amplitude = 1.01 * pi / 180.0, omega = 106.69842;
  const Pitch field({0.248, 0.0}, amplitude, omega);
  for (const double t : {0.0, 0.01, 0.37, 100.0}) {
    const double alpha = amplitude * std::sin(omega * t);
    expect_near(Point(1.248, 0.0) + field.displacement({1.248, 0.0}, t),
                {0.248 + std::cos(alpha), std::sin(alpha)}, 1e-15);
    EXPECT_EQ(field.displacement({0.248, 0.0}, t), Point(0.0, 0.0));
  }
}

TEST(Pitch, IsPositiveCounterClockwise) {
  const Pitch field({0.0, 0.0}, 0.1, 1.0);
  EXPECT_GT(field.displacement({1.0, 0.0}, 0.5 * pi).y, 0.0);
}

TEST(Plunge, MovesAlongTheDirectionWhateverItsLength) {
  const Plunge field({3.0, 4.0}, 2.0, pi);
  expect_near(field.displacement({9.0, 9.0}, 0.5), {1.2, 1.6}, 1e-15);
  expect_near(field.displacement({0.0, 9.0}, 1.5), {-1.2, -1.6}, 1e-15);
  EXPECT_EQ(field.displacement({0.0, 0.0}, 0.0), Point(0.0, 0.0));
}

TEST(PointVortices, AloneTurnsAtTheClosedFormsSpeed) {
  const double strength = 3.0, core = 0.2;
  const PointVortices field({{1.0, -1.0}}, {strength}, core);
  EXPECT_EQ(field.velocity({1.0, -1.0}, 0.0), Point(0.0, 0.0));
  for (const double r : {0.01, core, 0.7, 50.0}) {
    const double speed = strength * r / (2.0 * pi * (r * r + core * core));
    expect_near(field.velocity({1.0 + r, -1.0}, r), {0.0, speed}, 1e-14);
    expect_near(field.velocity({1.0, -1.0 - r}, r), {speed, 0.0}, 1e-14);
    const double a = speed / r * 2.0;  // angle at time 2
    expect_near(travel(field, {1.0 + r, -1.0}, 0.0, 2.0, 2000),
                {1.0 + r * std::cos(a), -1.0 + r * std::sin(a)}, 1e-8);
  }
  EXPECT_DOUBLE_EQ(field.velocity({1.0 + core, -1.0}, 0.0).y, strength / (4.0 * pi * core));
}

TEST(PointVortices, AddUpAndTurnAgainstEachOtherByTheirSign) {
  const std::vector<Point> points{{-0.5, 0.0}, {0.5, 0.0}};
  const PointVortices pair(points, {1.0, -1.0}, 0.1);
  expect_near(pair.velocity({0.0, 0.0}, 0.0), {0.0, 2.0 * 0.5 / (2.0 * pi * 0.26)}, 1e-15);
  for (const Point& x : random_points(50, -1, 1)) {
    const Point sum = PointVortices({points[0]}, {1.0}, 0.1).velocity(x, 0.0) +
                      PointVortices({points[1]}, {-1.0}, 0.1).velocity(x, 0.0);
    expect_near(pair.velocity(x, 0.0), sum, 1e-14);
    EXPECT_NEAR(divergence(pair, x, 0.0), 0.0, 1e-7);
  }
}

TEST(Swirl, HasLeVequesFormula) {
  const Swirl field({}, 8.0);
  for (const Point& x : random_points(100, 0, 1)) {
    const double t = 3.0 * x.x, g = std::cos(pi * t / 8.0);
    const double sx = std::sin(pi * x.x), sy = std::sin(pi * x.y);
    expect_near(field.velocity(x, t),
                {-sx * sx * std::sin(2 * pi * x.y) * g, sy * sy * std::sin(2 * pi * x.x) * g}, 1e-14);
  }
}

TEST(Swirl, ReturnsAfterItsPeriodWithTheOrderOfTheIntegrator) {
  const Swirl field({}, 8.0);
  double worst_coarse = 0.0, worst_fine = 0.0, farthest = 0.0;
  for (const Point& x : random_points(50, 0.05, 0.95)) {
    worst_coarse = std::max(worst_coarse, glm::distance(travel(field, x, 0.0, 8.0, 320), x));
    worst_fine = std::max(worst_fine, glm::distance(travel(field, x, 0.0, 8.0, 640), x));
    farthest = std::max(farthest, glm::distance(travel(field, x, 0.0, 4.0, 80), x));
  }
  EXPECT_GT(farthest, 0.3);
  EXPECT_LT(worst_fine, 1e-6);
  EXPECT_GT(worst_coarse / worst_fine, 14.0);  // order 4 would give 16, a symmetric path more
}

TEST(Swirl, StandsStillOnTheBoxBorderAndOutside) {
  const VortexBox box{{3.0, 1.0}, {2.0, 4.0}};
  const Swirl field(box, 1.0);
  for (const double s : {0.0, 0.1, 0.37, 0.5, 0.9, 1.0}) {
    for (const Point& x : {Point(2.0, -1.0 + 4 * s), Point(4.0, -1.0 + 4 * s)})
      EXPECT_EQ(field.velocity(x, 0.1), Point(0.0));
    for (const Point& x : {Point(2.0 + 2 * s, -1.0), Point(2.0 + 2 * s, 3.0)})
      EXPECT_EQ(field.velocity(x, 0.1), Point(0.0));
    EXPECT_EQ(field.velocity({1.9, -1.0 + 4 * s}, 0.1), Point(0.0));
  }
}

TEST(TaylorGreen, HasTheFormulaAndIsTangentialOnTheBorder) {
  const TaylorGreen field({});
  for (const Point& x : random_points(100, -1, 2))
    expect_near(field.velocity(x, 5.0),
                {std::sin(pi * x.x) * std::cos(pi * x.y), -std::cos(pi * x.x) * std::sin(pi * x.y)}, 1e-14);
  for (const double s : {0.0, 0.3, 0.5, 1.0}) {
    EXPECT_EQ(field.velocity({0.0, s}, 0.0).x, 0.0);
    EXPECT_EQ(field.velocity({1.0, s}, 0.0).x, 0.0);
    EXPECT_EQ(field.velocity({s, 0.0}, 0.0).y, 0.0);
    EXPECT_EQ(field.velocity({s, 1.0}, 0.0).y, 0.0);
  }
}

TEST(TaylorGreen, KeepsItsStreamFunctionAlongPaths) {
  const TaylorGreen field({});
  const auto psi = [](const Point& x) { return std::sin(pi * x.x) * std::sin(pi * x.y); };
  for (const Point& x : random_points(20, 0.1, 0.9))
    EXPECT_NEAR(psi(travel(field, x, 0.0, 5.0, 500)), psi(x), 1e-8);
}

TEST(Gresho, HasItsSpeedProfile) {
  const Gresho field({});
  const auto speed = [&](double r) { return field.velocity(Point(0.5 + r, 0.5), 0.0).y; };
  EXPECT_EQ(field.velocity({0.5, 0.5}, 0.0), Point(0.0, 0.0));
  EXPECT_NEAR(speed(0.1), 0.5, 1e-14);
  EXPECT_NEAR(speed(0.2), 1.0, 1e-14);
  EXPECT_NEAR(speed(0.3), 0.5, 1e-14);
  EXPECT_EQ(speed(0.4), 0.0);
  EXPECT_EQ(speed(0.49), 0.0);
  for (const Point& x : random_points(50, 0, 1))
    EXPECT_NEAR(glm::dot(field.velocity(x, 0.0), x - Point(0.5)), 0.0, 1e-15);  // no radial part
}

TEST(Twist, TurnsTheCentreAndReturns) {
  const Twist field({{0.0, 0.0}, {2.0, 2.0}}, 1.5, 4.0);
  const double turned = 1.5 * 4.0 / pi, tiny = 1e-4;  // at half the period
  expect_near(travel(field, {tiny, 0.0}, 0.0, 2.0, 200) / tiny, {std::cos(turned), std::sin(turned)}, 1e-6);
  for (const Point& x : random_points(50, -1, 1)) {
    expect_near(travel(field, x, 0.0, 4.0, 400), x, 1e-8);
    EXPECT_NEAR(glm::length(travel(field, x, 0.0, 1.0, 200)), glm::length(x),
                1e-9);  // circles, at its own speed
  }
}

TEST(Twist, HasTheFormulaAndStandsStillOnTheBorder) {
  const Twist field({}, 1.0, 8.0);
  const Point x(0.7, 0.2), half = 2.0 * x - 1.0;
  const double d = std::pow((1 - half.x * half.x) * (1 - half.y * half.y), 2);
  expect_near(field.velocity(x, 0.0), 0.5 * d * Point(-half.y, half.x), 1e-15);
  for (const double s : {-0.2, 0.0, 0.4, 1.0, 1.3})
    for (const Point& at : {Point(0.0, s), Point(1.0, s), Point(s, 0.0), Point(s, 1.0)})
      EXPECT_EQ(field.velocity(at, 0.0), Point(0.0));
}

TEST(Fields, FlowsOfIncompressibleFluidsAreFreeOfDivergence) {
  const VortexBox box{{1.0, 2.0}, {2.0, 3.0}};
  const Swirl swirl(box, 8.0);
  const TaylorGreen taylor_green(box);
  const Gresho gresho(box);
  const Rotation rotation({0.2, 0.3}, 2.0);
  const Shear shear({0.0, 0.0}, 2.0);
  for (const VelocityField* field :
       std::initializer_list<const VelocityField*>{&swirl, &taylor_green, &rotation, &shear})
    for (const Point& x : random_points(200, 0, 4))
      EXPECT_NEAR(divergence(*field, x, 1.0), 0.0, 1e-6) << field->name();
  for (const Point& x : random_points(200, 0, 4)) {
    const double r = glm::length((x - box.center) / box.size);
    if (std::abs(r - 0.2) > 1e-3 && std::abs(r - 0.4) > 1e-3) {  // but for the kinks
      EXPECT_NEAR(divergence(gresho, x, 0.0), 0.0, 1e-6);
    }
  }
}

TEST(Fields, GrowWithTheirBox) {
  const VortexBox box{{3.0, -1.0}, {4.0, 4.0}};
  const auto grown = [&](const VelocityField& unit, const VelocityField& big) {
    for (const Point& p : random_points(20, 0, 1))
      expect_near(big.velocity(box.center + (p - 0.5) * box.size, 0.3), unit.velocity(p, 0.3) * box.size,
                  1e-13);
  };
  grown(Swirl({}, 2.0), Swirl(box, 2.0));
  grown(TaylorGreen({}), TaylorGreen(box));
  grown(Gresho({}), Gresho(box));
  grown(Twist({}, 1.0, 2.0), Twist(box, 1.0, 2.0));
}

TEST(SumField, AddsItsParts) {
  const auto shift = std::make_shared<Translation>(Point(1.0, 2.0));
  const auto shear = std::make_shared<Shear>(Point(0.0, 0.0), 3.0);
  EXPECT_EQ(SumField({shift, shear, shift}).velocity({0.0, 2.0}, 0.0), Point(8.0, 4.0));
  EXPECT_EQ(SumField({}).velocity({0.0, 2.0}, 0.0), Point(0.0, 0.0));
}

TEST(DiscField, ActsInsideOnly) {
  const DiscField field(std::make_shared<Translation>(Point(1.0, 2.0)), {1.0, 0.0}, 0.5);
  EXPECT_EQ(field.velocity({1.5, 0.0}, 0.0), Point(1.0, 2.0));
  EXPECT_EQ(field.velocity({1.51, 0.0}, 0.0), Point(0.0, 0.0));
  EXPECT_EQ(field.name(), "translate");
}

}  // namespace
}  // namespace kinemesh
