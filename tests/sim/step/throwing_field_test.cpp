// Fields, users' callbacks, that throw: at each of their calls in turn, in steps and in runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>

#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/registry.h"
#include "kinemesh/run.h"
#include "kinemesh/stepper.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using test::snapshot;

// A swirl that throws where its calls are used up.
struct Calls {
  std::atomic<long> left{1L << 40};
  void count() {
    if (left-- <= 0) throw std::runtime_error("the field has had enough");
  }
};

class SwirlThatThrows : public VelocityField {
 public:
  explicit SwirlThatThrows(Calls& calls) : calls_(calls) {}
  std::string_view name() const override { return "swirl that throws"; }
  Point velocity(const Point& x, double t) const override {
    calls_.count();
    return {3.0 * (1 + t) * (x.y - 0.5) * x.x * (1 - x.x), -9.0 * (x.x - 0.5) * x.y * (1 - x.y)};
  }

 private:
  Calls& calls_;
};

class ShearThatThrows : public DisplacementField {
 public:
  explicit ShearThatThrows(Calls& calls) : calls_(calls) {}
  std::string_view name() const override { return "shear that throws"; }
  Point displacement(const Point& initial, double t) const override {
    calls_.count();
    return {0.3 * t * initial.y * (1 - initial.y) * initial.x * (1 - initial.x), 0.0};
  }

 private:
  Calls& calls_;
};

class KickThatThrows : public NoiseField {
 public:
  explicit KickThatThrows(Calls& calls) : calls_(calls) {}
  std::string_view name() const override { return "kick that throws"; }
  Point kick(std::uint64_t vertex, std::uint64_t step, double, double spacing) const override {
    calls_.count();
    return 0.5 * spacing * Point(static_cast<double>((vertex * 7 + step) % 11) / 11 - 0.5, 0.2);
  }

 private:
  Calls& calls_;
};

Mesh initial_mesh() {
  return build_mesh(test::grid_with_hole(6, 2, 4), {.frame = 0.25, .fixed = {}});
}

Motion motion_on(const Mesh& mesh, Calls& calls) {
  return Motion(mesh, {{std::make_shared<SwirlThatThrows>(calls), {}},
                       {std::make_shared<ShearThatThrows>(calls), {}},
                       {std::make_shared<KickThatThrows>(calls), {}}});
}

class ThrowingField : public testing::TestWithParam<const char*> {};

// The second step, so that there is something to lose.
TEST_P(ThrowingField, UndoesTheStepAtEachOfItsCalls) {
  Calls calls, enough;
  const Mesh initial = initial_mesh();
  const Motion motion = motion_on(initial, calls), undisturbed_motion = motion_on(initial, enough);
  const StepperOptions options{.allow_escaped = true, .quality = GetParam()};
  Stepper stepper(initial, options), undisturbed(initial, options);
  for (Stepper* s : {&stepper, &undisturbed}) ASSERT_TRUE(s->step(undisturbed_motion, 0.05));
  const auto before = snapshot(stepper.mesh());

  long throws = 0;
  for (bool done = false; !done;) {
    calls.left = throws;
    try {
      const auto outcome = stepper.step(motion, 0.05);
      ASSERT_TRUE(outcome) << outcome.defect->message();
      done = true;
    } catch (const std::runtime_error& error) {
      ASSERT_STREQ(error.what(), "the field has had enough");
      ++throws;
      ASSERT_EQ(snapshot(stepper.mesh()), before) << throws;
      ASSERT_EQ(stepper.time(), 0.05);
      ASSERT_EQ(stepper.steps_done(), 1);
    }
  }
  EXPECT_GT(throws, 100);
  RecordProperty("throws", static_cast<int>(throws));
  const auto outcome = undisturbed.step(undisturbed_motion, 0.05);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(snapshot(stepper.mesh()), snapshot(undisturbed.mesh()));
}

INSTANTIATE_TEST_SUITE_P(Each, ThrowingField, testing::Values("none", "delaunay", "smooth"),
                         [](const auto& quality) { return std::string(quality.param); });

Calls& calls_of_runs() {
  static Calls calls;
  return calls;
}

void register_once() {
  static const bool is_registered = [] {
    register_field({"throwing", "for a test", {}}, [](const CheckedParameters&) {
      return AnyField(std::make_shared<SwirlThatThrows>(calls_of_runs()));
    });
    return true;
  }();
  (void)is_registered;
}

// The run ends with what the field has said; the mesh and the checkpoint are those of the step before, and a
// run that is resumed ends like one that was never disturbed.
TEST(ThrowingFieldOfARun, EndsItAndLosesNothing) {
  register_once();
  const test::TemporaryFolder folder;
  const auto scenario = parse_scenario(
      "[mesh]\nshape = 'square'\nvertices = 60\n[[motion]]\nfield = 'throwing'\n"
      "[time]\ndt = 0.1\nsteps = 9\n[output]\nevery = 4\ncheckpoint = 3\n",
      (folder / "s.toml").string());
  const auto go = [&](const char* name, long calls) {
    RunObserver silent;
    RunOptions options;
    options.directory = folder / name;
    options.resume = true;
    options.dump_on_failure = true;
    calls_of_runs().left = calls;
    return run(scenario, options, silent);
  };
  ASSERT_FALSE(go("whole", 1L << 40).stopped);
  const auto expected = test::results_in(folder / "whole");
  const long all = (1L << 40) - calls_of_runs().left;
  const long in_a_step = all / 9;
  for (int step = 1; step <= 9; ++step) {
    const std::string name = "thrown" + std::to_string(step);
    const auto thrown = go(name.c_str(), (step - 1) * in_a_step + 7 * step);
    ASSERT_EQ(thrown.stopped, "the field has had enough");
    EXPECT_TRUE(thrown.can_resume);
    EXPECT_EQ(thrown.steps, step - 1);
    EXPECT_EQ(test::read_csv(folder / name / "steps.csv").rows.size(), step - 1u);
    EXPECT_FALSE(std::filesystem::exists(folder / name / "failed_step.bin"));  // it cannot be done again
    ASSERT_FALSE(go(name.c_str(), 1L << 40).stopped);
    EXPECT_EQ(test::results_in(folder / name), expected);
  }
}

template <class Error>
class ThrowsInTheSecondStep : public VelocityField {
 public:
  std::string_view name() const override { return "throws in the second step"; }
  Point velocity(const Point&, double t) const override {
    if (t > 0.15) throw Error();
    return {0.0, 0.0};
  }
};

struct OurMistake : std::logic_error {
  OurMistake() : std::logic_error("this cannot be") {}
};

struct TheirMistake : std::runtime_error {
  TheirMistake() : std::runtime_error("this is too much") {}
};

template <class Error>
RunSummary stopped_by(const std::filesystem::path& folder, const std::string& name) {
  static const bool is_registered = [&] {
    register_field({name, "for a test", {}}, [](const CheckedParameters&) {
      return AnyField(std::make_shared<ThrowsInTheSecondStep<Error>>());
    });
    return true;
  }();
  (void)is_registered;
  const auto scenario = parse_scenario("[mesh]\nshape = 'square'\nvertices = 60\n[[motion]]\nfield = '" +
                                           name + "'\n[time]\ndt = 0.1\nsteps = 9\n",
                                       (folder / "s.toml").string());
  RunObserver silent;
  RunOptions options;
  options.directory = folder / name;
  return run(scenario, options, silent);
}

// What an exception is about decides by what code the program exits.
TEST(Run, TellsLackOfMemoryFromMistakes) {
  const test::TemporaryFolder folder;
  const auto memory = stopped_by<std::bad_alloc>(folder / "", "forgetful");
  EXPECT_EQ(memory.stopped, "out of memory");
  EXPECT_EQ(memory.stop_cause, StopCause::Memory);
  EXPECT_EQ(memory.steps, 1);
  const auto ours = stopped_by<OurMistake>(folder / "", "mistaken");
  EXPECT_EQ(ours.stopped, "internal error: this cannot be");
  EXPECT_EQ(ours.stop_cause, StopCause::Bug);
  const auto theirs = stopped_by<TheirMistake>(folder / "", "demanding");
  EXPECT_EQ(theirs.stopped, "this is too much");
  EXPECT_EQ(theirs.stop_cause, StopCause::Other);
}

}  // namespace
}  // namespace kinemesh
