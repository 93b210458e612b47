// `--set key=value`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemesh/scenario.h"

namespace kinemesh {
namespace {

const std::string text =
    "[mesh]\nshape = 'square'\n"
    "[[motion]]\nfield = 'swirl'\n"
    "[[motion]]\nfield = 'rotation'\ncenter = [0, 0]\nrate = 1\n"
    "[time]\ndt = 0.1\nsteps = 10\n";

Scenario with(const std::vector<std::string>& overrides) {
  return parse_scenario(text, "a.toml", overrides);
}

std::string error_of(const std::vector<std::string>& overrides) {
  try {
    (void)with(overrides);
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Overrides, ReplaceAndAddValues) {
  const Scenario s = with({"mesh.vertices=500", "time.steps=3", "time.dt = 0.25", "output.every=1"});
  EXPECT_EQ(s.mesh.vertices, 500);
  EXPECT_EQ(s.time.steps, 3);
  EXPECT_EQ(s.time.dt, 0.25);
  EXPECT_EQ(s.output.every, 1);
}

TEST(Overrides, ReachIntoLists) {
  const Scenario s = with({"motion.0.period=2", "motion.1.rate=-3.5", "motion.1.center=[1,2]"});
  EXPECT_EQ(std::get<std::int64_t>(s.motions[0].parameters.at("period")), 2);
  EXPECT_EQ(std::get<double>(s.motions[1].parameters.at("rate")), -3.5);
  EXPECT_EQ(std::get<std::vector<double>>(s.motions[1].parameters.at("center")), (std::vector{1.0, 2.0}));
}

TEST(Overrides, ReplaceOneElementOfAList) {
  const Scenario s = with({"motion.1.center.1=5"});
  EXPECT_EQ(std::get<std::vector<double>>(s.motions[1].parameters.at("center")), (std::vector{0.0, 5.0}));
}

TEST(Overrides, AppendToLists) {
  const Scenario s =
      with({"motion.2={field='jitter', amplitude=0.1}", "motion.2.seed=4", "motion.3.field=swirl"});
  ASSERT_EQ(s.motions.size(), 4u);
  EXPECT_EQ(s.motions[2].field, "jitter");
  EXPECT_EQ(std::get<std::int64_t>(s.motions[2].parameters.at("seed")), 4);
  EXPECT_EQ(s.motions[3].field, "swirl");
}

TEST(Overrides, TakeBareWordsAsTexts) {
  const Scenario s = with({"repair.strategy=remesh", "border.default=slide", "border.\"my marker\"=moving",
                           "motion.0.on=disc:[0.5,0.5,0.25]"});
  EXPECT_EQ(s.repair.strategy, "remesh");
  EXPECT_EQ(s.border.conditions.otherwise, BorderCondition::Slide);
  EXPECT_EQ(s.border.conditions.by_marker.at("my marker"), BorderCondition::Moving);
  EXPECT_EQ(s.motions[0].on, std::vector<std::string>{"disc:[0.5,0.5,0.25]"});
}

TEST(Overrides, TheLastOneHolds) {
  EXPECT_EQ(with({"time.steps=3", "time.steps=4"}).time.steps, 4);
}

TEST(Overrides, ErrorsNameTheOverride) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"time.steps=0", "--set time.steps=0: steps: 0, an integer from 1"},
      {"time.stepz=1", "--set time.stepz=1: unknown key 'stepz' in [time], did you mean 'steps'?"},
      {"motion.0.period=red", "--set motion.0.period=red: field \"swirl\": period = \"red\""},
      {"motion.5.rate=1", "--set motion.5.rate=1: motion is a list of 2, a number from 0 to 2 expected"},
      {"motion.x.rate=1", "--set motion.x.rate=1: motion is a list of 2"},
      {"motion.2.rate=1", "--set motion.2.rate=1: [[motion]]: field expected"},
      {"time.dt.x=1", "--set time.dt.x=1: time.dt is neither a table nor a list"},
      {"motion.1.center.0.x=1", "--set motion.1.center.0.x=1: motion.1.center.0 is not a table"},
      {"time.dt", "--set time.dt: key=value expected"},
      {"=3", "--set =3: key=value expected"},
      {"a b=3", "--set a b=3: 'a b' is not a key"},
      {"tme.dt=1", "--set tme.dt=1: unknown key 'tme', did you mean 'time'?"},
      {"time.dt=0.1\nend = 3", "--set time.dt=0.1"},
  };
  for (const auto& [assignment, message] : cases)
    EXPECT_THAT(error_of({assignment}), testing::StartsWith(message)) << assignment;
}

}  // namespace
}  // namespace kinemesh
