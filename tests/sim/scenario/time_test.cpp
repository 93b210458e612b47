// The rule "t_n = n dt; the last step is shortened to end".
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "kinemesh/scenario.h"

namespace kinemesh {
namespace {

TEST(TimeSteps, DoNotAddAStepForRounding) {
  EXPECT_EQ(steps_to_reach(1.0, 0.01), 100);
  EXPECT_EQ(steps_to_reach(0.3, 0.1), 3);
  EXPECT_EQ(steps_to_reach(0.7, 0.1), 7);
  EXPECT_EQ(steps_to_reach(8.0, 0.02), 400);
  EXPECT_EQ(steps_to_reach(1e6, 0.1), 10'000'000);
}

TEST(TimeSteps, RoundUpWhatIsLeft) {
  EXPECT_EQ(steps_to_reach(1.0, 0.3), 4);
  EXPECT_EQ(steps_to_reach(1.0, 2.0), 1);
  EXPECT_EQ(steps_to_reach(1.0, 1.0), 1);
  EXPECT_EQ(steps_to_reach(1.0 + 1e-9, 0.01), 101);
  EXPECT_EQ(steps_to_reach(1e-300, 1e300), 1);
}

TEST(TimeSteps, RefuseMoreThanAnIntHolds) {
  EXPECT_FALSE(steps_to_reach(1.0, 1e-300));
  EXPECT_FALSE(steps_to_reach(1e300, 1e-300));
  EXPECT_EQ(steps_to_reach(2e9, 1.0), 2'000'000'000);
}

TEST(TimeSteps, ReachTheEndExactly) {
  const TimeSpec time{.dt = 0.3, .end = 1.0, .steps = 4, .integrator = Integrator::Rk4};
  EXPECT_EQ(time.time_after(0), 0.0);
  EXPECT_EQ(time.time_after(3), 3 * 0.3);
  EXPECT_EQ(time.time_after(4), 1.0);
}

// Decimal numbers, as people write them: n steps of dt = m / 10^k, the end rounded to the nearest double.
RC_GTEST_PROP(TimeSteps, AreAsManyAsTheDecimalsSay, ()) {
  const int n = *rc::gen::inRange(1, 100'000);
  const long m = *rc::gen::inRange(1, 1000);
  const int k = *rc::gen::inRange(0, 6);
  const double dt = std::stod(std::to_string(m) + "e-" + std::to_string(k));
  const double end = std::stod(std::to_string(m * n) + "e-" + std::to_string(k));
  RC_ASSERT(steps_to_reach(end, dt) == n);
}

// Whatever two are given, the resolved scenario gives the same steps at the same times.
RC_GTEST_PROP(TimeSteps, SurviveBeingWrittenOut, ()) {
  const auto number = [] {
    return std::to_string(*rc::gen::inRange(1, 10'000'000)) + "e" + std::to_string(*rc::gen::inRange(-9, 3));
  };
  const std::string end = "end = " + number() + "\n", dt = "dt = " + number() + "\n",
                    steps = "steps = " + std::to_string(*rc::gen::inRange(1, 1'000'000)) + "\n";
  const std::string two = *rc::gen::element(end + steps, dt + steps, end + dt);
  const std::string rest = "[mesh]\nshape = 'square'\n[[motion]]\nfield = 'swirl'\n[time]\n";
  std::optional<Scenario> one;
  try {
    one = parse_scenario(rest + two, "a.toml");
  } catch (const InputError&) {
    RC_DISCARD("too many steps");
  }
  const TimeSpec again = parse_scenario(to_toml(*one), "a.toml").time;
  RC_ASSERT(again.steps == one->time.steps);
  for (const int n : {1, again.steps / 2, again.steps - 1, again.steps})
    RC_ASSERT(again.time_after(n) == one->time.time_after(n));
}

}  // namespace
}  // namespace kinemesh
