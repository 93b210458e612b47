// A strategy from outside: derived, registered, and used by everything that takes the name of one.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "kinemesh/compare.h"
#include "kinemesh/error.h"
#include "kinemesh/run.h"
#include "kinemesh/scenario.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"
#include "tests/sim/step/kicks.h"

namespace kinemesh {
namespace {

// Flips edges, which is cheap, and replaces regions where flips get stuck: always ends valid.
class FlipsThenGlobal : public Strategy {
 public:
  static inline int n_stuck = 0;

  std::string_view name() const override { return "flips-then-global"; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override {
    if (auto flipped = flips_->repair(mesh, move)) return flipped;
    ++n_stuck;
    return global_->repair(mesh, move);
  }

 private:
  std::unique_ptr<Strategy> flips_ = make_strategy("flips"), global_ = make_strategy("global");
};

const StrategyInfo info{"flips-then-global",
                        "flips edges, and replaces regions where that gets stuck; always ends valid",
                        [] { return std::make_unique<FlipsThenGlobal>(); }};

// Tests may run in any order, and all in one process.
void register_once() {
  static const bool done = (register_strategy(info), true);
  ASSERT_TRUE(done);
}

constexpr const char* jittered = R"(
[mesh]
shape = "square"
vertices = 400
[[motion]]
field = "jitter"
amplitude = 0.15
[time]
dt = 1.0
steps = 12
[repair]
strategy = "flips-then-global"
)";

TEST(RegisteredStrategy, IsListedAndRefusedTwice) {
  register_once();
  EXPECT_EQ(make_strategy("flips-then-global")->name(), "flips-then-global");
  EXPECT_EQ(strategies().back().description, info.description);
  const auto n = strategies().size();
  try {
    register_strategy(info);
    ADD_FAILURE() << "registered twice";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "there is already a strategy \"flips-then-global\"");
  }
  EXPECT_EQ(strategies().size(), n);
}

TEST(RegisteredStrategy, Steps) {
  register_once();
  std::mt19937 random(3);
  Stepper stepper = test::stepper_on(test::two_labels(12), {.strategy = "flips-then-global"});
  int replaced = 0;
  const int stuck_before = FlipsThenGlobal::n_stuck;
  for (int n = 0; n < 20; ++n) {
    const auto outcome = stepper.step(test::kicked(stepper, 0.03 + 0.003 * n, random), 0.1);
    ASSERT_TRUE(outcome) << outcome.defect->message();
    EXPECT_FALSE(validate(stepper.mesh()));
    replaced += outcome.record.repair.replaced;
  }
  EXPECT_GT(replaced, 20);
  const int stuck = FlipsThenGlobal::n_stuck - stuck_before;
  EXPECT_GT(stuck, 0);   // so that it turned to global
  EXPECT_LT(stuck, 20);  // and did not always
}

TEST(RegisteredStrategy, IsTakenFromAScenario) {
  register_once();
  const test::TemporaryFolder folder;
  const auto scenario = parse_scenario(jittered, "jittered.toml");
  RunObserver silent;
  RunOptions options;
  options.directory = folder / "out";
  const auto summary = run(scenario, options, silent);
  EXPECT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_EQ(summary.plan.strategy, "flips-then-global");
  EXPECT_EQ(summary.steps, 12);
  EXPECT_GT(summary.replaced, 0);
}

// All of them, those that may fail and the one that moves vertices: each starts every step from the common
// positions, and one that has failed goes on with the mesh of one that has not.
TEST(RegisteredStrategy, IsComparedWithTheOthers) {
  register_once();
  const std::vector<std::string> names{"optimize", "flips", "flips-then-global", "global"};
  std::map<std::string, int> accepted;
  std::map<std::string, std::vector<Point>> positions;
  int n = 0, n_moved = 0, inverted = 0;
  const std::vector<std::string> overrides{"motion.0.amplitude=0.04", "time.steps=30"};
  const auto scenario = parse_scenario(jittered, "jittered.toml", overrides);
  EXPECT_FALSE(compare_strategies(scenario, set_up(scenario), names, [&](const Round& round) {
    accepted[round.strategy] += round.record.accepted;
    EXPECT_FALSE(validate(round.mesh)) << round.strategy;
    positions[round.strategy] = round.mesh.user_positions();
    if (++n % names.size() != 0) return;  // the last of this step
    inverted += round.record.repair.inverted;
    EXPECT_EQ(positions["flips-then-global"], positions["global"]);
    n_moved += positions["optimize"] != positions["global"];
  }));
  EXPECT_GT(inverted, 20);
  EXPECT_EQ(accepted["flips-then-global"], 30);
  EXPECT_EQ(accepted["global"], 30);
  EXPECT_GT(accepted["optimize"], 0);
  EXPECT_LT(accepted["flips"], 30);
  EXPECT_GT(accepted["flips"], 0);
  EXPECT_GT(n_moved, 0);
}

}  // namespace
}  // namespace kinemesh
