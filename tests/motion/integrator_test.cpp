#include "motion/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "kinemesh/parameters.h"

namespace kinemesh {
namespace {

// dx/dt = y + t, dy/dt = -x: solution from (1, 0) at t = 0 is (cos t + ... ) by variation of constants:
// x'' = -x + 1, x(0) = 1, x'(0) = 0, hence x = 1 and y = -t.
Point driven(const Point& x, double t) {
  return {x.y + t, -x.x};
}

// dx/dt = x cos t, dy/dt = y^2: x = exp(sin t), y = 1/(2 - t) from (1, 1/2).
Point nonlinear(const Point& x, double t) {
  return {x.x * std::cos(t), x.y * x.y};
}

double error(Integrator method, int steps) {
  Point x(1.0, 0.5);
  const double dt = 1.0 / steps;
  for (int n = 0; n < steps; ++n) x += integrate(method, nonlinear, x, n * dt, dt);
  return glm::distance(x, Point(std::exp(std::sin(1.0)), 1.0));
}

double observed_order(Integrator method) {
  return std::log2(error(method, 100) / error(method, 200));
}

TEST(Integrator, ConvergesWithItsOrder) {
  EXPECT_NEAR(observed_order(Integrator::Euler), 1.0, 0.05);
  EXPECT_NEAR(observed_order(Integrator::Heun), 2.0, 0.05);
  EXPECT_NEAR(observed_order(Integrator::Rk4), 4.0, 0.1);
}

TEST(Integrator, UsesTheTimeOfEachStage) {
  for (const auto method : {Integrator::Heun, Integrator::Rk4}) {
    const Point x = Point(1.0, -0.5) + integrate(method, driven, {1.0, -0.5}, 0.5, 0.25);
    EXPECT_NEAR(x.x, 1.0, 1e-15);
    EXPECT_NEAR(x.y, -0.75, 1e-15);
  }
}

TEST(Integrator, HasNames) {
  for (const auto method : {Integrator::Euler, Integrator::Heun, Integrator::Rk4})
    EXPECT_EQ(parse_integrator(to_string(method)), method);
  try {
    parse_integrator("rk3");
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "integrator");
    EXPECT_STREQ(error.what(), "unknown integrator \"rk3\", expected euler, heun or rk4");
  }
}

}  // namespace
}  // namespace kinemesh
