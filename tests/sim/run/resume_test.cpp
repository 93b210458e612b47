// Runs that are interrupted in every possible way and gone on with: in the end nothing tells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "sim/run/checkpoint.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;
using test::results_in;
using testing::HasSubstr;

// A turning disc, increments from the initial positions, and noise; several meshes, checkpoints out of step
// with them.
const std::string scenario_text =
    "[mesh]\nshape = 'square'\nvertices = 150\n"
    "[[motion]]\nfield = 'rotor'\ncenter = [0.5, 0.5]\nradius = 0.33\nrate = 6\n"
    "[[motion]]\nfield = 'jitter'\namplitude = 0.25\n"
    "[time]\ndt = 0.05\nsteps = 12\n"
    "[output]\nevery = 5\ncheckpoint = 3\npatches = true\n";

class StopAfter : public RunObserver {
 public:
  explicit StopAfter(int step) : step_(step) {}
  void stepped(const StepRecord& record, const Mesh&) override {
    if (record.step == step_) std::raise(SIGINT);
  }
  void started(const RunPlan& plan) override { steps_done = plan.steps_done; }
  int steps_done = -1;

 private:
  int step_;
};

class ResumeTest : public testing::Test {
 protected:
  Scenario scenario(const std::vector<std::string>& overrides = {}) const {
    return parse_scenario(scenario_text, (folder_ / "s.toml").string(), overrides);
  }

  RunSummary run_in(const std::string& name, const Scenario& of, bool resume, int stop_after = 0) {
    StopAfter observer(stop_after);
    RunOptions options;
    options.directory = folder_ / name;
    options.resume = resume;
    options.threads = 1;
    auto summary = kinemesh::run(of, options, observer);
    steps_done_ = observer.steps_done;
    return summary;
  }

  std::string resume_error(const std::string& name, const Scenario& of) {
    try {
      (void)run_in(name, of, true);
      return "none";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  test::TemporaryFolder folder_;
  int steps_done_ = -1;  // before, as the last run said
};

class EachWay : public ResumeTest,
                public testing::WithParamInterface<std::tuple<const char*, const char*, const char*>> {};

// After every step, and some more than once.
TEST_P(EachWay, GoesOnToTheSameBits) {
  const auto& [strategy, quality, every] = GetParam();
  const Scenario way =
      scenario({std::string("repair.strategy=") + strategy, std::string("repair.quality=") + quality,
                std::string("output.every=") + every});
  const auto whole = run_in("whole", way, false);
  ASSERT_FALSE(whole.stopped);
  const auto expected = results_in(folder_ / "whole");
  for (int n = 1; n < 12; ++n) {
    const std::string name = "stopped" + std::to_string(n);
    const auto stopped = run_in(name, way, n % 2 == 0, n);
    ASSERT_THAT(*stopped.stopped, HasSubstr("SIGINT after step " + std::to_string(n)));
    EXPECT_TRUE(stopped.can_resume);
    const bool is_stopped_twice = n % 3 == 0 && n < 10;
    if (is_stopped_twice) {
      ASSERT_TRUE(run_in(name, way, true, n + 2).stopped);
    }
    const auto resumed = run_in(name, way, true);
    EXPECT_FALSE(resumed.stopped);
    EXPECT_EQ(steps_done_, is_stopped_twice ? n + 2 : n);
    EXPECT_EQ(resumed.steps, 12);
    EXPECT_EQ(resumed.inverted, whole.inverted);
    EXPECT_EQ(resumed.share_mean, whole.share_mean);
    EXPECT_EQ(resumed.region_faces_max, whole.region_faces_max);
    ASSERT_EQ(results_in(folder_ / name), expected) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachWay,
                         testing::Combine(testing::Values("global", "local"),
                                          testing::Values("none", "delaunay", "smooth"),
                                          testing::Values("5", "0")),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param)) + "_" + std::get<1>(param.param) +
                                  "_every_" + std::get<2>(param.param);
                         });

// Whatever was written after the last checkpoint, whole or not, is dropped.
TEST_F(ResumeTest, DropsWhatIsLaterThanTheCheckpoint) {
  (void)run_in("whole", scenario(), false);
  (void)run_in("out", scenario(), false, 7);
  const fs::path out = folder_ / "out";
  fs::remove(out / "checkpoint.bin");
  ASSERT_EQ(parse_checkpoint(read_file(out / "checkpoint_prev.bin")).step, 6);
  folder_.write("out/steps.csv", test::content_of(out / "steps.csv") + "8,0.4,0.05,15");
  auto json = nlohmann::json::parse(test::content_of(out / "run.json"));
  json["files"].push_back("mesh_000010.vtu");  // as killed after step 10
  folder_.write("out/run.json", json.dump());
  folder_.write("out/mesh_000010.vtu", "later");
  folder_.write("out/.kinemesh-123-4.tmp", "half");
  folder_.write("out/checkpoint_next.bin", "half");
  folder_.write("out/notes.txt", "mine");
  EXPECT_FALSE(run_in("out", scenario(), true).stopped);
  EXPECT_EQ(steps_done_, 6);
  auto expected = results_in(folder_ / "whole");
  expected["notes.txt"] = "mine";
  EXPECT_EQ(results_in(out), expected);
}

TEST_F(ResumeTest, StartsWhereThereIsNothingToGoOnWith) {
  (void)run_in("whole", scenario(), false);
  EXPECT_FALSE(run_in("none", scenario(), true).stopped);
  EXPECT_EQ(steps_done_, 0);
  EXPECT_EQ(results_in(folder_ / "none"), results_in(folder_ / "whole"));
  // Killed before the first checkpoint.
  (void)run_in("early", scenario(), false, 2);
  fs::remove(folder_ / "early/checkpoint.bin");
  EXPECT_FALSE(run_in("early", scenario(), true).stopped);
  EXPECT_EQ(steps_done_, 0);
  EXPECT_EQ(results_in(folder_ / "early"), results_in(folder_ / "whole"));
}

TEST_F(ResumeTest, WritesNoCheckpointsForZeroButWhereItIsStopped) {
  const Scenario none = scenario({"output.checkpoint=0"});
  EXPECT_FALSE(run_in("whole", none, false).stopped);
  EXPECT_FALSE(fs::exists(folder_ / "whole/checkpoint.bin"));
  (void)run_in("out", none, false, 4);
  EXPECT_FALSE(run_in("out", none, true).stopped);
  EXPECT_EQ(steps_done_, 4);
  EXPECT_EQ(results_in(folder_ / "out"), results_in(folder_ / "whole"));
}

TEST_F(ResumeTest, LeavesAFinishedRunAlone) {
  (void)run_in("out", scenario(), false);
  const auto before = test::content_of(folder_ / "out/run.json");
  const auto summary = run_in("out", scenario(), true);
  EXPECT_TRUE(summary.was_finished);
  EXPECT_FALSE(summary.stopped);
  EXPECT_EQ(test::content_of(folder_ / "out/run.json"), before);
}

// The last step done and in its checkpoint, but killed before the last mesh was written.
TEST_F(ResumeTest, WritesTheEndOfARunThatHasNone) {
  (void)run_in("out", scenario(), false);
  const auto expected = results_in(folder_ / "out");
  auto json = nlohmann::json::parse(test::content_of(folder_ / "out/run.json"));
  json["state"] = "running";
  folder_.write("out/run.json", json.dump());
  fs::remove(folder_ / "out/final.su2");
  const auto summary = run_in("out", scenario(), true);
  EXPECT_FALSE(summary.was_finished);
  EXPECT_EQ(steps_done_, 12);
  EXPECT_EQ(results_in(folder_ / "out"), expected);
  EXPECT_EQ(nlohmann::json::parse(test::content_of(folder_ / "out/run.json")).at("state"), "done");
}

TEST_F(ResumeTest, RefusesAnotherScenario) {
  (void)run_in("out", scenario(), false, 5);
  const auto before = results_in(folder_ / "out");
  EXPECT_THAT(resume_error("out", scenario({"time.dt=0.06"})),
              testing::AllOf(HasSubstr("out/scenario.toml: "), HasSubstr("another scenario"),
                             HasSubstr("dt = 0.05 there, dt = 0.06 here")));
  EXPECT_THAT(resume_error("out", scenario({"motion.1.seed=9"})), HasSubstr("seed"));
  fs::remove(folder_ / "out/scenario.toml");
  EXPECT_THAT(resume_error("out", scenario({"time.dt=0.06"})),
              testing::AllOf(HasSubstr("out/checkpoint.bin: "), HasSubstr("another scenario")));
  EXPECT_FALSE(run_in("out", scenario(), true).stopped);
  EXPECT_EQ(before.count("mesh_000005.vtu"), 1u);
}

TEST_F(ResumeTest, RefusesADamagedCheckpointAndChangesNothing) {
  (void)run_in("whole", scenario(), false);
  (void)run_in("out", scenario(), false, 7);
  const fs::path file = folder_ / "out/checkpoint.bin";
  std::string content = test::content_of(file);
  content[content.size() / 2] ^= 1;
  folder_.write("out/checkpoint.bin", content);
  const auto before = results_in(folder_ / "out");
  EXPECT_THAT(resume_error("out", scenario()),
              testing::AllOf(HasSubstr(file.string()), HasSubstr("is damaged"),
                             HasSubstr("checkpoint_prev.bin is whole, of step 6")));
  EXPECT_EQ(results_in(folder_ / "out"), before);
  fs::rename(folder_ / "out/checkpoint_prev.bin", file);
  EXPECT_FALSE(run_in("out", scenario(), true).stopped);
  EXPECT_EQ(results_in(folder_ / "out"), results_in(folder_ / "whole"));
}

TEST_F(ResumeTest, RefusesLogsThatAreTooShort) {
  (void)run_in("out", scenario(), false, 7);
  folder_.write("out/steps.csv", "step\n");
  EXPECT_THAT(resume_error("out", scenario()),
              testing::AllOf(HasSubstr("out/steps.csv: 5 bytes long"), HasSubstr("checkpoint")));
}

// The mesh file may be gone: the checkpoint holds the mesh.
TEST_F(ResumeTest, NeedsNoMeshFile) {
  write_mesh(folder_ / "in.off", test::grid(9));
  const auto from_file = [&] {
    return parse_scenario(
        "[mesh]\nfile = 'in.off'\n" + scenario_text.substr(scenario_text.find("[[motion]]")),
        (folder_ / "s.toml").string());
  };
  (void)run_in("whole", from_file(), false);
  (void)run_in("out", from_file(), false, 5);
  fs::remove(folder_ / "in.off");
  EXPECT_FALSE(run_in("out", from_file(), true).stopped);
  EXPECT_EQ(results_in(folder_ / "out"), results_in(folder_ / "whole"));
}

// A step that has no valid mesh has none again, and is logged once.
TEST_F(ResumeTest, StopsAgainWhereARunHadToStop) {
  write_mesh(folder_ / "hole.su2", test::grid_with_hole(12, 9, 11));
  const auto collision = parse_scenario(
      "[mesh]\nfile = 'hole.su2'\n[[motion]]\nfield = 'translate'\nvelocity = [1, 0]\n"
      "on = 'marker:hole'\n[time]\ndt = 0.0125\nend = 1\n[output]\nevery = 4\n",
      (folder_ / "hole.toml").string());
  const auto first = run_in("out", collision, false);
  ASSERT_TRUE(first.stopped);
  EXPECT_FALSE(first.can_resume);
  const auto expected = results_in(folder_ / "out");
  const auto again = run_in("out", collision, true);
  EXPECT_EQ(steps_done_, 6);
  EXPECT_EQ(again.stopped, first.stopped);
  EXPECT_EQ(results_in(folder_ / "out"), expected);
}

TEST_F(ResumeTest, ForceMakesWayForAnotherScenario) {
  (void)run_in("out", scenario(), false, 7);
  RunObserver silent;
  RunOptions options;
  options.directory = folder_ / "out";
  options.force = true;
  EXPECT_FALSE(kinemesh::run(scenario({"time.steps=2", "output.checkpoint=0"}), options, silent).stopped);
  EXPECT_FALSE(fs::exists(folder_ / "out/checkpoint.bin"));
  EXPECT_FALSE(fs::exists(folder_ / "out/checkpoint_prev.bin"));
}

}  // namespace
}  // namespace kinemesh
