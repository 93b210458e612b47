// Adaptive steps: what is rejected is undone, logged and halved; nothing else changes a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <csignal>
#include <random>

#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "sim/run/adaptive_steps.h"
#include "tests/sim/helpers.h"
#include "tests/sim/step/kicks.h"

namespace kinemesh {
namespace {

using test::Csv;
using test::read_csv;
using test::results_in;
using testing::HasSubstr;

TimeSpec adaptive_time(double dt, int steps, double min_dt, double max_dt) {
  TimeSpec time{.dt = dt, .end = dt * steps, .steps = steps};
  time.adaptive = AdaptiveSpec{.max_region_share = {}, .min_dt = min_dt, .max_dt = max_dt};
  return time;
}

TEST(AdaptiveSteps, WithoutRejectionsAreTheOthers) {
  for (TimeSpec time :
       {TimeSpec{.dt = 0.3, .end = 1.0, .steps = 4}, TimeSpec{.dt = 0.1, .end = 0.3, .steps = 3},
        TimeSpec{.dt = 0.01, .end = 7.0, .steps = 700}}) {
    AdaptiveSteps fixed(time);
    time.adaptive = AdaptiveSpec{.max_region_share = {}, .min_dt = time.dt / 8, .max_dt = time.dt};
    AdaptiveSteps adaptive(time);
    for (int n = 1; n <= time.steps; ++n) {
      ASSERT_FALSE(fixed.is_done());
      ASSERT_FALSE(adaptive.is_done());
      ASSERT_EQ(fixed.next_end(), time.time_after(n));
      ASSERT_EQ(adaptive.next_end(), time.time_after(n));
      fixed.accept();
      adaptive.accept();
    }
    EXPECT_TRUE(fixed.is_done());
    EXPECT_TRUE(adaptive.is_done());
  }
}

TEST(AdaptiveSteps, FixedStepsHaveNoHalf) {
  AdaptiveSteps steps(TimeSpec{.dt = 0.5, .end = 1.0, .steps = 2});
  EXPECT_FALSE(steps.reject());
}

TEST(AdaptiveSteps, HalveAndDoubleWhereTheTimeIsAMultiple) {
  AdaptiveSteps steps(adaptive_time(1.0, 100, 0.125, 4.0));
  std::vector<double> ends;
  const auto accept = [&](int n) {
    for (; n > 0; --n) {
      ends.push_back(steps.next_end());
      steps.accept();
    }
  };
  accept(1);
  EXPECT_TRUE(steps.reject());
  EXPECT_TRUE(steps.reject());
  accept(13);
  EXPECT_THAT(ends, testing::ElementsAre(1, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10));
  accept(4);  // two until 16, then four
  EXPECT_EQ(ends.back(), 20.0);
  EXPECT_EQ(steps.state().length, 4.0);
  EXPECT_EQ(steps.state().rejected, 2);
}

TEST(AdaptiveSteps, EndWhereHalfOfThemIsBelowTheShortest) {
  AdaptiveSteps steps(adaptive_time(1.0, 10, 0.3, 1.0));
  EXPECT_TRUE(steps.reject());
  EXPECT_FALSE(steps.reject());
  AdaptiveSteps exact(adaptive_time(1.0, 10, 0.25, 1.0));
  EXPECT_TRUE(exact.reject());
  EXPECT_TRUE(exact.reject());
  EXPECT_FALSE(exact.reject());
}

// A length of four is shortened to the 0.5 that are left; the next to try is a part of those.
TEST(AdaptiveSteps, HalveWhatIsLeft) {
  TimeSpec time = adaptive_time(1.0, 8, 0.125, 4.0);
  time.end = 8.5;
  time.steps = 9;
  AdaptiveSteps steps(time, {.position = 8.0, .length = 4.0});
  EXPECT_EQ(steps.next_end(), 8.5);
  EXPECT_TRUE(steps.reject());
  EXPECT_EQ(steps.next_end(), 8.25);
}

// Any course of accepted and rejected steps, interrupted anywhere.
RC_GTEST_PROP(AdaptiveSteps, ReachTheEndExactlyInLengthsBetweenTheLimits, ()) {
  const double dt = *rc::gen::inRange(1, 1000) / 997.0;
  TimeSpec time = adaptive_time(dt, *rc::gen::inRange(1, 40), dt / *rc::gen::inRange(1, 100),
                                dt * *rc::gen::inRange(1, 20));
  if (*rc::gen::arbitrary<bool>()) time.end -= 0.4 * dt;
  AdaptiveSteps steps(time);
  double now = 0.0;
  while (!steps.is_done()) {
    const double end = steps.next_end();
    RC_ASSERT(end > now);
    RC_ASSERT(end <= time.end);
    RC_ASSERT(end - now <= time.adaptive->max_dt * (1 + 1e-12));
    RC_ASSERT(end == time.end || end - now >= time.adaptive->min_dt * (1 - 1e-12));
    AdaptiveSteps again(time, steps.state());
    RC_ASSERT(again.next_end() == end);
    auto halved = steps;
    if (*rc::gen::inRange(0, 3) == 0 && halved.reject()) {
      RC_ASSERT(halved.next_end() < end);
      steps = halved;
      continue;
    }
    steps.accept();
    now = end;
  }
  RC_ASSERT(now == time.end);
}

TEST(RegionShare, RefusesAStepAndLeavesNoTrace) {
  int refused = 0, accepted = 0;
  for (auto options : test::all_ways()) {
    options.max_region_share = 0.2;
    for (const bool is_observed : {false, true}) {
      Stepper stepper = test::stepper_on(test::two_labels(12), options);
      int told = 0, steps = 0;
      if (is_observed) stepper.observe([&](const StepChanges&) { ++told; });
      std::mt19937 random(3);
      for (int n = 0; n < 20; ++n) {
        const auto before = test::snapshot(stepper.mesh());
        const double time = stepper.time();
        const auto outcome = stepper.step(test::kicked(stepper, n % 2 ? 0.02 : 0.1, random), 0.1);
        ASSERT_FALSE(outcome.defect) << outcome.defect->message();
        const double share =
            static_cast<double>(outcome.record.repair.region_faces()) / stepper.mesh().n_faces();
        ASSERT_EQ(outcome.too_large.has_value(), share > 0.2) << test::name_of(options);
        ASSERT_EQ(outcome.record.accepted, static_cast<bool>(outcome));
        steps += outcome.record.accepted;
        (outcome ? accepted : refused) += 1;
        ASSERT_EQ(outcome.reason(), outcome ? Refusal::None : Refusal::RegionsTooLarge);
        ASSERT_EQ(outcome.message().empty(), static_cast<bool>(outcome));
        if (outcome) continue;
        ASSERT_THAT(outcome.message(), testing::HasSubstr("of all faces, at most 0.2 expected"));
        ASSERT_EQ(outcome.too_large->share, share);
        ASSERT_EQ(test::snapshot(stepper.mesh()), before) << test::name_of(options);
        ASSERT_EQ(stepper.time(), time);
      }
      ASSERT_EQ(stepper.steps_done(), steps);
      ASSERT_EQ(told, is_observed ? steps : 0);
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(accepted, 100);
}

class Quiet : public RunObserver {
 public:
  explicit Quiet(int interrupted_at = -1) : left_(interrupted_at) {}
  void started(const RunPlan& plan) override { n_faces = plan.faces + plan.padding_faces; }
  void stepped(const StepRecord&, const Mesh&) override {
    ++calls;
    if (--left_ == 0) std::raise(SIGINT);
  }
  int n_faces = 0, calls = 0;

 private:
  int left_;  // steps, rejected ones included
};

class AdaptiveRun : public testing::Test {
 protected:
  // A hole that is pressed together so fast at first that a long step turns it inside out, among vertices
  // that are shaken.
  Scenario press(const std::string& adaptive) const {
    write_mesh(folder_ / "hole.su2", test::grid_with_hole(12, 4, 8));
    return parse_scenario(
        "[mesh]\nfile = 'hole.su2'\n[[motion]]\nfield = 'expression'\nu = '-30*exp(-20*t)*(x-0.5)'\nv = '0'\n"
        "on = 'marker:hole'\n[[motion]]\nfield = 'jitter'\namplitude = 0.4\n"
        "[time]\ndt = 0.1\nend = 1\nintegrator = 'euler'\n" +
            adaptive + "\n[output]\nevery = 4\ncheckpoint = 3\n",
        (folder_ / "press.toml").string());
  }

  Scenario rotor(const std::string& adaptive) const {
    return parse_scenario(
        "[mesh]\nshape = 'square'\nvertices = 400\n[[motion]]\nfield = 'rotor'\ncenter = [0.5, 0.5]\n"
        "radius = 0.33\nrate = 2\n[time]\ndt = 0.1\nsteps = 8\n" +
            adaptive,
        (folder_ / "rotor.toml").string());
  }

  RunSummary run_in(const std::string& name, const Scenario& of, int interrupted_at = -1, int threads = 1) {
    Quiet observer(interrupted_at);
    RunOptions options;
    options.directory = folder_ / name;
    options.resume = true;
    options.threads = threads;
    auto summary = kinemesh::run(of, options, observer);
    n_faces_ = observer.n_faces;
    calls_ = observer.calls;
    return summary;
  }

  Csv steps_of(const std::string& name) const { return read_csv(folder_ / name / "steps.csv"); }

  test::TemporaryFolder folder_;
  int n_faces_ = 0, calls_ = 0;
};

TEST_F(AdaptiveRun, HalvesWhatFailsAndGoesOn) {
  const auto whole = run_in("fixed", press(""));
  ASSERT_TRUE(whole.stopped);
  EXPECT_EQ(whole.steps, 0);
  EXPECT_EQ(whole.rejected, 1);

  const auto summary = run_in("out", press("adaptive = {max_dt = 0.2}"));
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_EQ(summary.time, 1.0);
  const Csv steps = steps_of("out");
  ASSERT_EQ(steps.rows.size(), static_cast<size_t>(summary.steps + summary.rejected));
  EXPECT_GE(summary.rejected, 2);
  EXPECT_GT(summary.inverted, 0);
  double now = 0.0, longest = 0.0;
  for (size_t i = 0; i < steps.rows.size(); ++i) {
    const bool is_accepted = steps.rows[i].at("accepted") == "1";
    EXPECT_NEAR(steps.number(i, "time") - now, steps.number(i, "dt"), 1e-15);
    if (!is_accepted) {
      EXPECT_EQ(steps.rows[i + 1].at("step"), steps.rows[i].at("step"));
      EXPECT_NEAR(steps.number(i + 1, "dt"), steps.number(i, "dt") / 2, 1e-15);
    } else {
      now = steps.number(i, "time");
      longest = std::max(longest, steps.number(i, "dt"));
    }
  }
  EXPECT_EQ(now, 1.0);
  EXPECT_NEAR(longest, 0.2, 1e-15);
}

TEST_F(AdaptiveRun, StopsAtTheShortestStep) {
  const auto summary = run_in("out", press("adaptive = {min_dt = 0.04}"));
  ASSERT_TRUE(summary.stopped);
  EXPECT_THAT(*summary.stopped, testing::AllOf(HasSubstr("step 1 has no valid mesh: "),
                                               HasSubstr("at time 0.05; its length 0.05 cannot be halved, "
                                                         "min_dt is 0.04")));
  EXPECT_FALSE(summary.can_resume);
  EXPECT_EQ(summary.steps, 0);
  EXPECT_EQ(summary.rejected, 2);
  EXPECT_EQ(steps_of("out").rows.size(), 2u);
  EXPECT_EQ(steps_of("out").sum("accepted"), 0.0);
  const auto expected = results_in(folder_ / "out");
  EXPECT_EQ(run_in("out", press("adaptive = {min_dt = 0.04}")).stopped, summary.stopped);
  EXPECT_EQ(results_in(folder_ / "out"), expected);
}

TEST_F(AdaptiveRun, KeepsTheShareOfTheRegions) {
  const auto shares = [&](const std::string& name, bool accepted) {
    const Csv steps = steps_of(name);
    std::vector<double> all;
    for (size_t i = 0; i < steps.rows.size(); ++i)
      if ((steps.rows[i].at("accepted") == "1") == accepted)
        all.push_back(steps.number(i, "region_faces") / n_faces_);
    return all;
  };
  ASSERT_FALSE(run_in("any", rotor("")).stopped);
  const auto any = shares("any", true);
  EXPECT_GT(*std::ranges::max_element(any), 0.1);
  const auto summary = run_in("out", rotor("adaptive = {max_region_share = 0.1}"));
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_EQ(summary.time, 0.1 * 8);
  // Only what was replaced is in regions.csv.
  const Csv steps = steps_of("out");
  double regions = 0.0;
  for (size_t i = 0; i < steps.rows.size(); ++i)
    regions += steps.number(i, "accepted") * steps.number(i, "regions");
  EXPECT_GT(regions, 0.0);
  EXPECT_EQ(read_csv(folder_ / "out/regions.csv").rows.size(), regions);
  EXPECT_THAT(shares("out", true), testing::Each(testing::Le(0.1)));
  EXPECT_THAT(shares("out", false),
              testing::AllOf(testing::Not(testing::IsEmpty()), testing::Each(testing::Gt(0.1))));

  const auto none = run_in("none", rotor("adaptive = {max_region_share = 1e-6, min_dt = 0.03}"));
  ASSERT_TRUE(none.stopped);
  EXPECT_THAT(*none.stopped, testing::AllOf(HasSubstr("step 1 at time 0.05 has regions of 0."),
                                            HasSubstr("max_region_share is 1e-06; its length 0.05 cannot")));
}

// Interrupted after each step, rejected or not, for any number of threads.
TEST_F(AdaptiveRun, GoesOnToTheSameBits) {
  int number = 0;
  for (const Scenario& scenario :
       {press("adaptive = {max_dt = 0.2}"), rotor("adaptive = {max_region_share = 0.1, max_dt = 0.2}")}) {
    const std::string whole = "whole" + std::to_string(number++);
    const auto summary = run_in(whole, scenario);
    ASSERT_FALSE(summary.stopped);
    ASSERT_GT(summary.rejected, 0);
    const auto expected = results_in(folder_ / whole);
    const int calls = calls_;
    for (int n = 1; n < calls; ++n) {
      const std::string name = whole + "_" + std::to_string(n);
      ASSERT_THAT(*run_in(name, scenario, n).stopped, HasSubstr("stopped by SIGINT"));
      const auto resumed = run_in(name, scenario, -1, 1 + n % 2);
      ASSERT_FALSE(resumed.stopped);
      EXPECT_EQ(resumed.rejected, summary.rejected);
      EXPECT_EQ(resumed.steps, summary.steps);
      ASSERT_EQ(results_in(folder_ / name), expected) << n;
    }
  }
}

}  // namespace
}  // namespace kinemesh
