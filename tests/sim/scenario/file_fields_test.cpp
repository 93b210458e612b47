// Motions that come from files: how scenarios name them, and that they do what the built-in ones do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/setup.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FileFields : public testing::Test {
 protected:
  Scenario scenario(const std::string& motion) const {
    folder_.write("s.toml",
                  "[mesh]\nshape = 'square'\nvertices = 200\n[[motion]]\n" + motion +
                      "on = 'disc:[0.5, 0.5, 0.2]'\nblend = [0.0, 0.2]\n[time]\ndt = 0.1\nend = 2\n");
    return load_scenario(folder_ / "s.toml");
  }

  std::vector<Point> end_of(const std::string& motion, const std::string& name) const {
    RunObserver silent;
    RunOptions options;
    options.directory = folder_ / name;
    const auto summary = run(scenario(motion), options, silent);
    EXPECT_FALSE(summary.stopped) << *summary.stopped;
    EXPECT_GT(summary.steps_tangled, 0);
    return read_mesh(options.directory / "final.su2").mesh.points;
  }

  static double difference(const std::vector<Point>& a, const std::vector<Point>& b) {
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, glm::distance(a[v], b[v]));
    return largest;
  }

  test::TemporaryFolder folder_;
};

// A rotation is bilinear: its samples at four corners are all of it.
TEST_F(FileFields, GridOfARotationIsTheRotation) {
  folder_.write("turn.csv", "x,y,u,v\n0,0,1,-1\n1,0,1,1\n0,1,-1,-1\n1,1,-1,1\n");
  const auto sampled = end_of("field = 'grid'\nfile = 'turn.csv'\n", "grid");
  const auto exact = end_of("field = 'rotation'\ncenter = [0.5, 0.5]\nrate = 2\n", "rotation");
  ASSERT_EQ(sampled.size(), exact.size());
  EXPECT_LT(difference(sampled, exact), 1e-12);
}

TEST_F(FileFields, GridMayHaveQuotes) {
  folder_.write("wind.csv", "x,y,u,v\n0,0,0.1,0\n1,0,0.1,0\n");
  folder_.write("quoted.csv", "\"x\",\"y\",\"u\",\"v\"\n0,\"0\",0.1,0\n\"1\",0,0.1,\"0\"\n");
  EXPECT_EQ(end_of("field = 'grid'\nfile = 'wind.csv'\n", "plain"),
            end_of("field = 'grid'\nfile = 'quoted.csv'\n", "quoted"));
}

TEST_F(FileFields, AreNamedRelativeToTheScenarioAndWrittenOutWhole) {
  folder_.write("wind.csv", "0,0,1,0\n");
  const Scenario one = scenario("field = 'grid'\nfile = 'x/../wind.csv'\n");
  EXPECT_EQ(std::get<std::string>(one.motions[0].parameters.at("file")), (folder_ / "wind.csv").string());
  EXPECT_EQ(to_toml(parse_scenario(to_toml(one), "/elsewhere/s.toml")), to_toml(one));
}

TEST_F(FileFields, AFileThatManyMotionsNameIsReadOnce) {
  std::string table = "x,y,u,v\n", motions;
  for (int i = 0; i < 20'000; ++i) table += std::to_string(i) + ",0,1,0\n";
  for (int i = 0; i < 1000; ++i) motions += "[[motion]]\nfield = 'grid'\nfile = 'x/../wind.csv'\n";
  folder_.write("wind.csv", table);
  const auto before = std::chrono::steady_clock::now();
  const Scenario many = parse_scenario(
      "[mesh]\nshape = 'square'\nvertices = 20\n[time]\ndt = 0.1\nend = 2\n" + motions, folder_ / "s.toml");
  EXPECT_EQ(many.motions.size(), 1000u);
  EXPECT_NO_THROW(set_up(many));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

TEST_F(FileFields, ErrorsNameTheLineOfTheTableOrOfTheScenario) {
  folder_.write("wind.csv", "0,0,1,0\n1,0,1,fast\n");
  const auto error_of = [&](const std::string& motion) -> std::string {
    try {
      (void)scenario(motion);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(error_of("field = 'grid'\nfile = 'wind.csv'\n"),
              AllOf(HasSubstr("s.toml:6: file: "), HasSubstr("wind.csv:2: 'fast' is not a number")));
  EXPECT_THAT(error_of("field = 'grid'\nfile = 3\n"),
              AllOf(HasSubstr("s.toml:6: "), HasSubstr("file = 3, expected the name of a file")));
  EXPECT_THAT(error_of("field = 'grid'\n"), HasSubstr("parameter file is missing"));
  EXPECT_THAT(error_of("field = 'plugin'\nlibrary = 'none.so'\n"),
              AllOf(HasSubstr("s.toml:6: plug-in "), HasSubstr("none.so: there is no such file")));
}

const std::string plugin =
    std::string("field = 'plugin'\nlibrary = '") + SAMPLE_PLUGINS + "/sample_plugin.so'\n";

TEST_F(FileFields, PluginDoesWhatTheSameFormulaDoes) {
  const auto plugged = end_of(plugin + "rate = 0.4\ncenter = [0.5, 0.5]\n", "plugin");
  const auto formula = end_of("field = 'expression'\nu = '0.4*(x - 0.5)'\nv = '-0.4*(y - 0.5)'\n", "formula");
  ASSERT_EQ(plugged.size(), formula.size());
  EXPECT_LT(difference(plugged, formula), 1e-12);
}

// The stages of the step from 0.3 are at 0.3, 0.35 and 0.4: it fails halfway.
TEST_F(FileFields, PluginThatFailsLeavesTheStepBeforeAsItWas) {
  for (const char* mode : {"error", "throw", "nan"}) {
    auto made = set_up(scenario(plugin + "until = 0.33\nmode = '" + mode + "'\n"));
    Stepper stepper(made.mesh);
    for (int n = 0; n < 3; ++n) ASSERT_TRUE(stepper.step(made.motion, 0.1));
    const auto before = test::snapshot(stepper.mesh());
    const double time = stepper.time();
    if (mode == std::string("nan"))
      EXPECT_THAT(stepper.step(made.motion, 0.1).defect->message(), HasSubstr("field \"plugin\" gives"));
    else
      EXPECT_THROW((void)stepper.step(made.motion, 0.1), std::runtime_error) << mode;
    EXPECT_EQ(test::snapshot(stepper.mesh()), before) << mode;
    EXPECT_EQ(stepper.time(), time);
    EXPECT_FALSE(validate(stepper.mesh()));
  }
}

TEST_F(FileFields, PluginThatFailsStopsTheRunWithItsReason) {
  RunObserver silent;
  RunOptions options;
  options.directory = folder_ / "out";
  const auto summary = run(scenario(plugin + "until = 0.33\n"), options, silent);
  EXPECT_THAT(summary.stopped.value_or(""),
              AllOf(HasSubstr("sample_plugin.so fails at ("), HasSubstr("the sea is rough")));
  EXPECT_EQ(summary.steps, 3);
  EXPECT_FALSE(
      validate(build_mesh(read_mesh(options.directory / "final.su2").mesh, {.frame = 0.25, .fixed = {}})));
}

}  // namespace
}  // namespace kinemesh
