// A run from its scenario to the files it leaves.
#include "kinemesh/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "kinemesh/mesh_io.h"
#include "sim/run/csv_log.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using test::content_of;
using test::Csv;
using test::read_csv;
using test::results_in;
using testing::ElementsAre;
using testing::HasSubstr;

// Rotates the inside of a grid so that a ring around it tangles, in 12 steps.
const std::string ring =
    "[mesh]\nfile = 'in.su2'\n"
    "[[motion]]\nfield = 'rotor'\ncenter = [0.5, 0.5]\nradius = 0.33\nrate = 6\n"
    "[time]\ndt = 0.05\nsteps = 12\n"
    "[output]\nevery = 5\n";

class RunTest : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(folder_ / "in.su2", test::grid(12));
    folder_.write("ring.toml", ring);
  }

  Scenario load(const std::vector<std::string>& overrides = {}) {
    return load_scenario(folder_ / "ring.toml", overrides);
  }

  RunSummary go(const Scenario& scenario, RunOptions options = {}) {
    if (options.directory.empty()) options.directory = out();
    RunObserver silent;
    return kinemesh::run(scenario, options, silent);
  }

  std::string error_of(const Scenario& scenario, const RunOptions& options = {}) {
    try {
      (void)go(scenario, options);
      return "no error";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::filesystem::path out() const { return folder_ / "out"; }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(out()))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RunTest, LeavesTheFilesItSays) {
  const RunSummary summary = go(load());
  EXPECT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_THAT(files(), ElementsAre("checkpoint.bin", "checkpoint_prev.bin", "final.su2", "mesh.pvd",
                                   "mesh_000000.vtu", "mesh_000005.vtu", "mesh_000010.vtu", "mesh_000012.vtu",
                                   "regions.csv", "run.json", "scenario.toml", "steps.csv"));
  EXPECT_EQ(summary.steps, 12);
  EXPECT_EQ(summary.time, 0.05 * 12);
  EXPECT_THAT(summary.files, ElementsAre(out() / "mesh.pvd", out() / "final.su2", out() / "steps.csv",
                                         out() / "regions.csv"));
}

TEST_F(RunTest, WritesOnlyTheFirstAndTheLastMeshForEveryZero) {
  (void)go(load({"output.every=0"}));
  EXPECT_THAT(files(), testing::Contains("mesh_000012.vtu"));
  EXPECT_EQ(std::ranges::count_if(files(), [](const auto& n) { return n.starts_with("mesh_0"); }), 2);
}

TEST_F(RunTest, NamesTheSeriesAfterStepsAndTimes) {
  (void)go(load());
  const std::string pvd = content_of(out() / "mesh.pvd");
  for (const char* name : {"mesh_000000.vtu", "mesh_000005.vtu", "mesh_000010.vtu", "mesh_000012.vtu"})
    EXPECT_THAT(pvd, HasSubstr(name));
  EXPECT_THAT(pvd, HasSubstr("\"0.25\""));
}

TEST_F(RunTest, LogsTheColumnsOfTheContract) {
  (void)go(load());
  EXPECT_EQ(
      read_csv(out() / "steps.csv").header,
      "step,time,dt,vertices,faces,inverted,degenerate,components,regions,region_faces,region_faces_max,"
      "explored,replaced,crease_edges,retries,escaped,quality_flips,min_angle_deg,min_area,move_ms,detect_ms,"
      "explore_ms,triangulate_ms,splice_ms,quality_ms,total_ms,accepted,interior_ms,quality_moves");
  EXPECT_EQ(read_csv(out() / "regions.csv").header,
            "step,region,seed,faces,inverted,components,explored,border_edges,crease_edges,self_overlap,"
            "retries,x,y");
}

TEST_F(RunTest, LogsOfStepsAndRegionsAgree) {
  const RunSummary summary = go(load());
  const Csv steps = read_csv(out() / "steps.csv"), regions = read_csv(out() / "regions.csv");
  ASSERT_EQ(steps.rows.size(), 12u);
  EXPECT_GT(regions.rows.size(), 5u);
  EXPECT_EQ(steps.sum("regions"), static_cast<double>(regions.rows.size()));
  EXPECT_EQ(steps.sum("region_faces"), regions.sum("faces"));
  EXPECT_EQ(steps.sum("explored"), regions.sum("explored"));
  EXPECT_EQ(steps.sum("inverted"), regions.sum("inverted"));
  EXPECT_EQ(steps.sum("components"), regions.sum("components"));
  EXPECT_EQ(steps.sum("crease_edges"), regions.sum("crease_edges"));
  EXPECT_EQ(steps.sum("accepted"), 12.0);
  EXPECT_EQ(steps.sum("replaced"), static_cast<double>(summary.replaced));
  for (size_t i = 0; i < steps.rows.size(); ++i) {
    EXPECT_EQ(steps.number(i, "step"), i + 1.0);
    EXPECT_EQ(steps.number(i, "time"), 0.05 * (i + 1.0));
    EXPECT_EQ(steps.number(i, "vertices"), 169);
    EXPECT_EQ(steps.number(i, "faces"), 288);
    EXPECT_GT(steps.number(i, "min_area"), 0.0);
    EXPECT_GT(steps.number(i, "min_angle_deg"), 0.0);
  }
}

TEST_F(RunTest, SummaryAddsUpTheSteps) {
  const RunSummary summary = go(load());
  const Csv steps = read_csv(out() / "steps.csv");
  EXPECT_GT(summary.steps_tangled, 0);
  EXPECT_EQ(summary.region_faces, steps.sum("region_faces"));
  const double all = summary.plan.faces + summary.plan.padding_faces;
  EXPECT_NEAR(summary.share_mean, steps.sum("replaced") / 12.0 / all, 1e-12);
  EXPECT_GE(summary.share_max, summary.share_mean);
  EXPECT_LE(summary.ms.detect + summary.ms.move, summary.ms.total);
}

TEST_F(RunTest, LastMeshIsInTheInputsFormatWithItsMarkers) {
  (void)go(load());
  const MeshData last = read_mesh(out() / "final.su2").mesh, first = test::grid(12);
  EXPECT_EQ(last.n_faces(), first.n_faces());
  ASSERT_EQ(last.markers.size(), first.markers.size());
  for (size_t m = 0; m < first.markers.size(); ++m) {
    EXPECT_EQ(last.markers[m].name, first.markers[m].name);
    EXPECT_EQ(last.markers[m].edges, first.markers[m].edges);
  }
  EXPECT_EQ(last.points, read_mesh(out() / "mesh_000012.vtu").mesh.points);
  EXPECT_EQ(last.triangles, read_mesh(out() / "mesh_000012.vtu").mesh.triangles);
}

TEST_F(RunTest, RecordsWhatWasRun) {
  RunOptions options;
  options.argv = {"kinemesh", "run", "ring.toml"};
  options.threads = 1;
  (void)go(load(), options);
  const auto json = nlohmann::json::parse(content_of(out() / "run.json"));
  EXPECT_EQ(json.at("schema"), "kinemesh-run-1");
  EXPECT_EQ(json.at("state"), "done");
  EXPECT_EQ(json.at("argv"), (std::vector<std::string>{"kinemesh", "run", "ring.toml"}));
  EXPECT_EQ(json.at("threads"), 1);
  EXPECT_EQ(json.at("steps"), 12);
  EXPECT_EQ(json.at("mesh").at("vertices"), 169);
  EXPECT_TRUE(json.at("seed").is_null());
  EXPECT_TRUE(json.contains("version"));
}

TEST_F(RunTest, ResultsDoNotDependOnThreads) {
  RunOptions one, two;
  one.threads = 1;
  two.threads = 2;
  one.directory = folder_ / "one";
  two.directory = folder_ / "two";
  const Scenario scenario = load({"motion.1={field='jitter', amplitude=0.3}"});
  EXPECT_FALSE(go(scenario, one).stopped);
  EXPECT_FALSE(go(scenario, two).stopped);
  EXPECT_EQ(results_in(one.directory), results_in(two.directory));
}

TEST_F(RunTest, ItsScenarioRunsAgainToTheSameBits) {
  (void)go(load());
  const auto first = results_in(out());
  RunOptions again;
  again.directory = folder_ / "again";
  (void)go(load_scenario(out() / "scenario.toml"), again);
  EXPECT_EQ(results_in(again.directory), first);
}

TEST_F(RunTest, RefusesAFolderThatHoldsARun) {
  (void)go(load());
  const auto before = results_in(out());
  EXPECT_THAT(error_of(load()), HasSubstr("holds a run already"));
  EXPECT_EQ(results_in(out()), before);
}

TEST_F(RunTest, ForceRemovesARunAndNothingElse) {
  (void)go(load());
  folder_.write("out/notes.txt", "mine");
  folder_.write("out/mesh_12.vtu", "mine");
  folder_.write("out/final.txt", "mine");
  RunOptions force;
  force.force = true;
  EXPECT_FALSE(go(load({"time.steps=3", "output.every=0"}), force).stopped);
  EXPECT_THAT(files(), ElementsAre("checkpoint.bin", "final.su2", "final.txt", "mesh.pvd", "mesh_000000.vtu",
                                   "mesh_000003.vtu", "mesh_12.vtu", "notes.txt", "regions.csv", "run.json",
                                   "scenario.toml", "steps.csv"));
}

TEST_F(RunTest, RefusesToReplaceItsOwnInput) {
  (void)go(load());
  RunOptions force;
  force.force = true;
  EXPECT_THAT(error_of(load({"mesh.file=out/final.su2"}), force),
              HasSubstr("final.su2: the run would replace"));
  EXPECT_TRUE(std::filesystem::exists(out() / "final.su2"));
}

// Whatever has a name of ours and is not in run.json's list is somebody else's.
TEST_F(RunTest, NothingIsReplacedThatNoRunHasWritten) {
  RunOptions force, resume;
  force.force = resume.resume = true;
  for (const char* name :
       {"steps.csv", "regions.csv", "mesh.pvd", "mesh_000003.vtu", "mesh_999999.vtu", "checkpoint.bin",
        "patches.bin", "failed_step.bin", "final.su2", "final.off", "run.json", "scenario.toml"}) {
    std::filesystem::remove_all(out());
    std::filesystem::create_directory(out());
    folder_.write(std::string("out/") + name, "mine");
    for (const RunOptions& options : {RunOptions(), force, resume})
      EXPECT_THAT(error_of(load(), options), HasSubstr("out")) << name;
    EXPECT_EQ(content_of(out() / name), "mine");
    EXPECT_EQ(files().size(), 1u);
  }
  std::filesystem::remove_all(out());
  (void)go(load());
  folder_.write("out/mesh_000007.vtu", "mine");
  const auto before = results_in(out());
  EXPECT_THAT(error_of(load(), force), HasSubstr("mesh_000007.vtu: is in the way"));
  EXPECT_EQ(results_in(out()), before);
}

TEST_F(RunTest, RunJsonListsWhatTheRunHasWrittenAndIsNotBelievedMoreThanThat) {
  (void)go(load({"output.patches=true"}));
  auto json = nlohmann::json::parse(content_of(out() / "run.json"));
  std::vector<std::string> listed = json["files"];
  EXPECT_THAT(listed, ::testing::UnorderedElementsAreArray(files()));
  folder_.write("precious", "mine");
  folder_.write("out/notes.txt", "mine");
  json["files"].push_back("../precious");
  json["files"].push_back("notes.txt");
  json["files"].push_back((folder_ / "precious").string());
  json["files"].push_back(7);
  folder_.write("out/run.json", json.dump());
  RunOptions force;
  force.force = true;
  EXPECT_FALSE(go(load(), force).stopped);
  EXPECT_EQ(content_of(folder_ / "precious") + content_of(out() / "notes.txt"), "minemine");
}

TEST_F(RunTest, LinksPipesAndFoldersInThePlaceOfItsFilesAreRefused) {
  folder_.write("victim", "precious");
  RunOptions force, resume;
  force.force = resume.resume = true;
  for (const char* name :
       {"steps.csv", "mesh.pvd", "run.json", "checkpoint.bin", "mesh_000000.vtu", "final.su2"}) {
    for (const char* kind : {"link", "pipe", "folder"}) {
      std::filesystem::remove_all(out());
      (void)go(load());
      std::filesystem::remove(out() / name);
      if (kind == std::string("link")) std::filesystem::create_symlink("../victim", out() / name);
      if (kind == std::string("pipe")) (void)mkfifo((out() / name).c_str(), 0600);
      if (kind == std::string("folder")) std::filesystem::create_directory(out() / name);
      for (const RunOptions& options : {force, resume})
        EXPECT_THAT(error_of(load(), options), HasSubstr(name)) << kind;
      EXPECT_EQ(content_of(folder_ / "victim"), "precious");
    }
  }
}

// A log is continued in place: not under another name's feet.
TEST_F(RunTest, ALogWithASecondNameIsNotContinued) {
  (void)go(load({"output.checkpoint=4"}));
  auto json = nlohmann::json::parse(content_of(out() / "run.json"));
  json["state"] = "running";
  folder_.write("out/run.json", json.dump());
  std::filesystem::create_hard_link(out() / "steps.csv", folder_ / "kept.csv");
  const std::string kept = content_of(folder_ / "kept.csv");
  RunOptions resume;
  resume.resume = true;
  EXPECT_THAT(error_of(load({"output.checkpoint=4"}), resume), HasSubstr("steps.csv: has other names"));
  EXPECT_EQ(content_of(folder_ / "kept.csv"), kept);
  std::filesystem::remove(folder_ / "kept.csv");
  EXPECT_FALSE(go(load({"output.checkpoint=4"}), resume).stopped);
}

TEST_F(RunTest, TheResolvedScenarioRunsAgainInItsFolderAndStaysAsItIs) {
  (void)go(load());
  const auto first = results_in(out());
  RunOptions force;
  force.force = true;
  EXPECT_FALSE(go(load_scenario(out() / "scenario.toml"), force).stopped);
  EXPECT_EQ(results_in(out()), first);
  const std::vector<std::string> other{"time.steps=3"};
  EXPECT_THAT(error_of(load_scenario(out() / "scenario.toml", other), force),
              HasSubstr("the run would replace"));
  EXPECT_EQ(results_in(out()), first);
}

TEST_F(RunTest, RunsIntoAFolderThatHoldsOtherThings) {
  std::filesystem::create_directory(out());
  folder_.write("out/notes.txt", "mine");
  EXPECT_FALSE(go(load()).stopped);
  EXPECT_EQ(content_of(out() / "notes.txt"), "mine");
}

TEST_F(RunTest, RefusesAFileInPlaceOfAFolder) {
  folder_.write("out", "a file");
  EXPECT_THAT(error_of(load()), HasSubstr("is not a folder"));
}

TEST_F(RunTest, DryRunWritesNothing) {
  RunOptions dry;
  dry.dry_run = true;
  const RunSummary summary = go(load(), dry);
  EXPECT_EQ(summary.plan.steps, 12);
  EXPECT_EQ(summary.plan.vertices, 169);
  EXPECT_THAT(summary.plan.markers, ElementsAre("bottom", "right", "top", "left"));
  EXPECT_EQ(summary.steps, 0);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

// What the mesh alone can tell is an error before the first step, with the scenario's line.
TEST_F(RunTest, BadInputLeavesNothingBehind) {
  const std::string file = (folder_ / "ring.toml").string();
  MeshData tangled = test::grid(12);
  tangled.points[80] = {0.9, 0.51};
  write_mesh(folder_ / "tangled.su2", tangled);
  folder_.write("lines.toml", ring + "[border]\nwing = 'fixed'\n");
  folder_.write("on.toml",
                "[mesh]\nfile = 'in.su2'\nframe = 0\n[[motion]]\nfield = 'translate'\n"
                "velocity = [1, 0]\non = 'marker:leftt'\n[time]\ndt = 1\nsteps = 1\n");
  folder_.write("label.toml",
                "[mesh]\nfile = 'in.su2'\n[[motion]]\nfield = 'translate'\n"
                "velocity = [1, 0]\non = 'label:7'\n[time]\ndt = 1\nsteps = 1\n");
  const auto at = [&](const char* name) { return (folder_ / name).string(); };
  EXPECT_THAT(error_of(load({"mesh.file=none.su2"})), HasSubstr("none.su2"));
  EXPECT_THAT(error_of(load({"mesh.file=none.xyz"})), HasSubstr("none.xyz"));
  EXPECT_THAT(error_of(load({"mesh.file=tangled.su2"})),
              testing::AllOf(HasSubstr("tangled.su2: face "), HasSubstr("is inverted"),
                             HasSubstr("kinemesh untangle")));
  EXPECT_THAT(error_of(load_scenario(folder_ / "lines.toml")),
              HasSubstr(at("lines.toml") +
                        ":14: no marker 'wing' in the mesh, expected one of: bottom, right, top, left"));
  EXPECT_THAT(error_of(load_scenario(folder_ / "on.toml")),
              HasSubstr(at("on.toml") + ":7: no marker 'leftt' in the mesh, did you mean 'left'?"));
  EXPECT_THAT(
      error_of(load_scenario(folder_ / "on.toml", std::vector<std::string>{"motion.0.on=marker:left"})),
      HasSubstr(at("on.toml") + ":3: frame = 0, but the outer border may move"));
  EXPECT_THAT(error_of(load_scenario(folder_ / "label.toml")), HasSubstr(at("label.toml") + ":6: "));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

// A hole's border moves without a frame, the convex hull does not.
TEST_F(RunTest, MovesAHoleWithoutAFrame) {
  write_mesh(folder_ / "hole.su2", test::grid_with_hole(12, 5, 7));
  folder_.write("hole.toml",
                "[mesh]\nfile = 'hole.su2'\nframe = 0\n[[motion]]\nfield = 'plunge'\ndirection = [1, 0.5]\n"
                "amplitude = 0.2\nomega = 3.14159\non = 'marker:hole'\nblend = [0, 0.24]\n"
                "[time]\ndt = 0.1\nend = 1\n");
  const RunSummary summary = go(load_scenario(folder_ / "hole.toml"));
  EXPECT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_GT(summary.steps_tangled, 0);
  EXPECT_EQ(read_mesh(out() / "final.su2").mesh.markers.size(), 5u);
}

TEST_F(RunTest, StopsAtAStepWithoutAValidMesh) {
  // The hole, one cell of 1/12 away from the right border, runs into it in the seventh step.
  write_mesh(folder_ / "hole.su2", test::grid_with_hole(12, 9, 11));
  folder_.write("hole.toml",
                "[mesh]\nfile = 'hole.su2'\n[[motion]]\nfield = 'translate'\nvelocity = [1, 0]\n"
                "on = 'marker:hole'\n[time]\ndt = 0.0125\nend = 1\n[output]\nevery = 4\n");
  const RunSummary summary = go(load_scenario(folder_ / "hole.toml"));
  ASSERT_TRUE(summary.stopped);
  EXPECT_THAT(*summary.stopped, HasSubstr("step 7 has no valid mesh"));
  EXPECT_THAT(*summary.stopped, HasSubstr("at time 0.0875"));
  EXPECT_EQ(summary.steps, 6);
  EXPECT_THAT(files(), testing::IsSupersetOf({"final.su2", "mesh_000004.vtu", "mesh_000006.vtu"}));
  const Csv steps = read_csv(out() / "steps.csv");
  ASSERT_EQ(steps.rows.size(), 7u);
  EXPECT_EQ(steps.rows[5].at("accepted"), "1");
  EXPECT_EQ(steps.rows[6].at("accepted"), "0");
  const MeshData last = read_mesh(out() / "final.su2").mesh;
  EXPECT_NEAR(last.points[9 * 13 + 9].x, 9.0 / 12 + 6 * 0.0125, 1e-12);
  EXPECT_EQ(nlohmann::json::parse(content_of(out() / "run.json")).at("state"), "stopped");
}

class StopAt : public RunObserver {
 public:
  StopAt(int step, int signal) : step_(step), signal_(signal) {}
  void stepped(const StepRecord& record, const Mesh&) override {
    if (record.step == step_) std::raise(signal_);
    ++steps_seen;
  }
  int steps_seen = 0;

 private:
  int step_, signal_;
};

TEST_F(RunTest, ASignalEndsItAfterTheStep) {
  for (const int signal : {SIGINT, SIGTERM}) {
    StopAt observer(3, signal);
    RunOptions options;
    options.directory = folder_ / ("out" + std::to_string(signal));
    const RunSummary summary = kinemesh::run(load(), options, observer);
    ASSERT_TRUE(summary.stopped);
    // A signal is looked for once the step has been told of.
    EXPECT_EQ(*summary.stopped,
              std::string("stopped by ") + (signal == SIGINT ? "SIGINT" : "SIGTERM") + " after step 3");
    EXPECT_EQ(observer.steps_seen, 3);
    EXPECT_EQ(read_csv(options.directory / "steps.csv").rows.size(), 3u);
    EXPECT_TRUE(std::filesystem::exists(options.directory / "mesh_000003.vtu"));
    EXPECT_TRUE(std::filesystem::exists(options.directory / "final.su2"));
  }
}

TEST_F(RunTest, ALogIsANewFileOrOneThatIsLongEnough) {
  const auto log = folder_ / "log.csv";
  { LineFile file(log, "header"); }
  EXPECT_THROW(LineFile(log, "header"), InputError);
  EXPECT_THROW(LineFile(log, std::uint64_t{8}), InputError);
  EXPECT_THROW(LineFile("/dev/null", std::uint64_t{0}), InputError);
  { LineFile(log, std::uint64_t{7}).write("row"); }
  EXPECT_EQ(content_of(log), "header\nrow\n");
}

// A folder that goes away in mid-run: a clear end, no crash.
class RemoveFolder : public RunObserver {
 public:
  explicit RemoveFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void stepped(const StepRecord& record, const Mesh&) override {
    if (record.step == 2) std::filesystem::remove_all(folder_);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(RunTest, SaysWhatItCouldNotWrite) {
  RemoveFolder observer(out());
  RunOptions options;
  options.directory = out();
  const RunSummary summary = kinemesh::run(load(), options, observer);
  ASSERT_TRUE(summary.stopped);
  EXPECT_THAT(*summary.stopped, HasSubstr("out/run.json: cannot be written"));
  EXPECT_TRUE(summary.files.empty());
}

class Recorder : public RunObserver {
 public:
  void note(const std::string& text) override { events.push_back("note " + text); }
  void detail(const std::string& text) override { events.push_back("detail " + text.substr(0, 12)); }
  void started(const RunPlan& plan) override { events.push_back("started " + std::to_string(plan.steps)); }
  void stepped(const StepRecord& record, const Mesh&) override {
    events.push_back("step " + std::to_string(record.step));
  }
  void finished(const RunSummary& summary) override {
    events.push_back("finished " + std::to_string(summary.steps));
  }
  std::vector<std::string> events;
};

TEST_F(RunTest, TellsItsObserver) {
  Recorder recorder;
  RunOptions options;
  options.directory = out();
  (void)kinemesh::run(load({"time.steps=2"}), options, recorder);
  EXPECT_THAT(recorder.events, ElementsAre("started 2", "step 1", "step 2", "finished 2"));
}

TEST_F(RunTest, RefusesNegativeThreads) {
  RunOptions options;
  options.threads = -1;
  EXPECT_THAT(error_of(load(), options), HasSubstr("threads"));
}

// The same motion by repair and by re-meshing: the same positions, valid meshes both.
TEST_F(RunTest, StrategiesMoveTheSameVerticesTheSameWay) {
  RunOptions other;
  other.directory = folder_ / "remesh";
  EXPECT_FALSE(go(load()).stopped);
  EXPECT_FALSE(go(load({"repair.strategy=remesh"}), other).stopped);
  EXPECT_EQ(read_mesh(out() / "final.su2").mesh.points, read_mesh(other.directory / "final.su2").mesh.points);
  EXPECT_EQ(read_csv(other.directory / "steps.csv").sum("accepted"), 12.0);
}

}  // namespace
}  // namespace kinemesh
