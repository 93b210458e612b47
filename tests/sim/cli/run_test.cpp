// `kinemesh run`: the whole way from a scenario to its files, and every way in which it ends.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

const char* const jitter_toml =
    "[mesh]\nshape = \"square\"\nvertices = 300\nseed = 3\n"
    "[[motion]]\nfield = \"jitter\"\namplitude = 0.2\nseed = 7\n"
    "[time]\ndt = 0.1\nsteps = 20\n"
    "[output]\nevery = 10\n";

// The inner circle of a ring moves to the right, over vertices that stay, until it meets the outer one.
const char* const collision_toml =
    "[mesh]\nshape = \"annulus\"\nvertices = 400\n"
    "[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\non = \"marker:inner\"\n"
    "[repair]\nallow_escaped = true\n"
    "[border]\nouter = \"fixed\"\n"
    "[time]\ndt = 0.2\nsteps = 10\n";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Run : public ProgramTest {
 protected:
  // The last mesh of a run, whatever its format.
  std::string last_mesh(const std::string& folder) const {
    for (const auto& entry : fs::directory_iterator(path(folder)))
      if (entry.path().stem() == "final") return entry.path().string();
    ADD_FAILURE() << "no last mesh in " << folder;
    return "";
  }

  void expect_complete(const std::string& folder, int rows) const {
    for (const char* name :
         {"scenario.toml", "run.json", "steps.csv", "regions.csv", "mesh.pvd", "mesh_000000.vtu"})
      EXPECT_TRUE(fs::exists(path(folder) / name)) << name;
    EXPECT_EQ(lines_of(read_text(path(folder) / "steps.csv")).size(), static_cast<size_t>(rows) + 1);
    EXPECT_EQ(run({"check", last_mesh(folder)}).code, 0);
  }
};

TEST_F(Run, EndToEnd) {
  write("shaken.toml", jitter_toml);
  const Result result = run({"run", "shaken.toml"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_complete("shaken", 20);
  EXPECT_TRUE(fs::exists(path("shaken/mesh_000020.vtu")));
  for (const char* row :
       {"steps ", "20 of 20", "steps that tangled", "triangles replaced", "share of the mesh",
        "time of a step", "with a full re-mesh", "times as long", "shaken/mesh.pvd"})
    EXPECT_TRUE(has(result.out, row)) << row << " in\n" << result.out;
  EXPECT_EQ(files(), (std::vector<std::string>{"shaken", "shaken.toml"}));
}

TEST_F(Run, ProgressIsPlainLinesNowAndThen) {
  write("s.toml", jitter_toml);
  const Result result = run({"run", "s.toml"});
  const std::vector<std::string> lines = result.err_lines();
  EXPECT_GE(lines.size(), 5u) << result.err;
  EXPECT_LE(lines.size(), 15u) << result.err;
  EXPECT_TRUE(has(lines.back(), "step 20/20"));
  EXPECT_FALSE(has(result.err, "\r"));
  EXPECT_FALSE(has(result.err, "\x1b"));
  for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
}

TEST_F(Run, QuietSaysNothing) {
  write("s.toml", jitter_toml);
  const Result result = run({"run", "s.toml", "-q"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
  expect_complete("s", 20);
}

TEST_F(Run, NobodyHasToListen) {
  write("s.toml", jitter_toml);
  const std::string program =
      "cd " + path(".").string() + " && " KINEMESH_PROGRAM " run s.toml --force > out 2";
  EXPECT_EQ(std::system((program + ">&-").c_str()), 0);
  expect_complete("s", 20);
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(std::system((program + "> /dev/full").c_str()), 0);
  expect_complete("s", 20);
}

TEST_F(Run, VerboseSaysEveryStep) {
  write("s.toml", jitter_toml);
  const Result result = run({"run", "s.toml", "-v"});
  EXPECT_EQ(result.code, 0);
  for (int step = 1; step <= 20; ++step)
    EXPECT_TRUE(has(result.err, "step " + std::to_string(step) + "/20 ")) << step;
}

TEST_F(Run, TerminalHasOneLiveLine) {
  if (!has_terminals()) GTEST_SKIP() << "no /dev/pts";
  write("s.toml", jitter_toml);
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  const Result coloured = run_on_terminal({"run", "s.toml", "--force"});
  EXPECT_EQ(coloured.code, 0) << coloured.err;
  EXPECT_TRUE(has(coloured.err, "\r")) << coloured.err;
  EXPECT_TRUE(has(coloured.err, "step 20/20"));
  EXPECT_TRUE(has(coloured.err, "\x1b[3"));
  EXPECT_FALSE(has(coloured.out, "\x1b"));
  EXPECT_EQ(std::count(coloured.err.begin(), coloured.err.end(), '\n'), 0) << coloured.err;
  setenv("NO_COLOR", "1", 1);
  const Result plain = run_on_terminal({"run", "s.toml", "--force"});
  unsetenv("NO_COLOR");
  EXPECT_TRUE(has(plain.err, "step 20/20"));
  EXPECT_FALSE(has(plain.err, "\x1b[3")) << plain.err;
}

TEST_F(Run, TheLiveLineDoesNotWrap) {
  if (!has_terminals()) GTEST_SKIP() << "no /dev/pts";
  write("s.toml", jitter_toml);
  setenv("TERM", "xterm", 1);
  setenv("NO_COLOR", "1", 1);
  const Result result = run_on_terminal({"run", "s.toml"}, 40);
  unsetenv("NO_COLOR");
  EXPECT_TRUE(has(result.err, "step 20/20 t = ")) << result.err;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line, '\r');)
    EXPECT_LE(line.substr(0, line.find('\x1b')).size(), 39u) << line;
  // The last line names the program as it was called, here by its whole path.
  for (const auto& line : lines_of(result.out))
    EXPECT_TRUE(line.size() <= 100 || has(line, " report ")) << line;
}

TEST_F(Run, DryRunSaysThePlanAndWritesNothing) {
  write("s.toml", jitter_toml);
  const Result result = run({"run", "s.toml", "--dry-run"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* part : {"shape square", "300 vertices", "bottom", "right", "top", "left", "jitter",
                           "amplitude = 0.2", "20 steps", "global"})
    EXPECT_TRUE(has(result.out, part)) << part << " in\n" << result.out;
  EXPECT_EQ(files(), std::vector<std::string>{"s.toml"});
}

TEST_F(Run, DryRunSaysWhatBodiesInteriorBorderAndQualityAre) {
  write("s.toml",
        "[mesh]\nshape = 'square'\nvertices = 300\n[[body]]\non = ['marker:left', 'marker:right']\n"
        "motion = [{field = 'rigid', x = '0.1*t'}]\n[border]\ntop = 'slide'\n[time]\ndt = 0.1\nsteps = 1\n"
        "[[motion]]\nfield = 'jitter'\namplitude = 0.1\non = 'marker:left'\n");
  const Result result = run({"run", "s.toml", "--dry-run"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* part : {"marker:left, marker:right; rigid center = [0, 0] x = \"0.1*t\"\n",
                           "default fixed, top slide\n", "harmonic\n", "angles, of 25 degrees\n"})
    EXPECT_TRUE(has(result.out, part)) << part << " in\n" << result.out;
  EXPECT_TRUE(has(result.err, "s.toml:15: on: jitter moves nothing")) << result.err;
  const Result other =
      run({"run", "s.toml", "--dry-run", "--set", "interior.follow=none", "--set", "repair.quality=none"});
  EXPECT_TRUE(has(other.out, "interior follows      none\n")) << other.out;
}

TEST_F(Run, SetChangesTheScenario) {
  write("s.toml", jitter_toml);
  const Result result =
      run({"run", "s.toml", "-o", "short", "--set", "time.steps=3", "--set", "motion.0.amplitude=0.1"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "3 of 3")) << result.out;
  expect_complete("short", 3);
  EXPECT_TRUE(has(read_text(path("short/scenario.toml")), "amplitude = 0.1"));
}

TEST_F(Run, FolderWithARunIsRefusedWithoutForce) {
  write("s.toml", jitter_toml);
  ASSERT_EQ(run({"run", "s.toml"}).code, 0);
  const std::string before = read_text(path("s/steps.csv"));
  expect_error(run({"run", "s.toml"}), 2, {"s", "--force"});
  EXPECT_EQ(read_text(path("s/steps.csv")), before);
  const Result forced = run({"run", "s.toml", "--force", "--set", "time.steps=4"});
  EXPECT_EQ(forced.code, 0) << forced.err;
  expect_complete("s", 4);
}

TEST_F(Run, ForceRemovesTheReportOfWhatItReplaces) {
  write("s.toml", jitter_toml);
  ASSERT_EQ(run({"run", "s.toml"}).code, 0);
  ASSERT_EQ(run({"report", "s"}).code, 0);
  ASSERT_EQ(run({"run", "s.toml", "--force"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("s/report.html")));
  write("s/report.html", "<title>somebody else's</title>");
  ASSERT_EQ(run({"run", "s.toml", "--force"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("s/report.html")));
}

TEST_F(Run, ThreadsDoNotChangeTheResult) {
  write("s.toml", jitter_toml);
  ASSERT_EQ(run({"run", "s.toml", "-o", "one", "--threads", "1"}).code, 0);
  ASSERT_EQ(run({"run", "s.toml", "-o", "two", "--threads", "2"}).code, 0);
  EXPECT_EQ(read_text(last_mesh("one")), read_text(last_mesh("two")));
  EXPECT_EQ(read_text(path("one/mesh_000020.vtu")), read_text(path("two/mesh_000020.vtu")));
}

TEST_F(Run, BadScenariosAreNamedWithTheirLine) {
  write("syntax.toml", "[mesh\n");
  expect_error(run({"run", "syntax.toml"}), 2, {"syntax.toml:1: "});
  write("key.toml", std::string(jitter_toml) + "evry = 2\n");
  expect_error(run({"run", "key.toml"}), 2, {"key.toml:14: ", "evry"});
  write("field.toml",
        "[mesh]\nshape = \"disk\"\n[[motion]]\nfield = \"jiter\"\n[time]\ndt = 1.0\nsteps = 1\n");
  expect_error(run({"run", "field.toml"}), 2, {"field.toml:4: ", "jiter", "jitter"});
  write("good.toml", jitter_toml);
  expect_error(run({"run", "good.toml", "--set", "time.stps=3"}), 2, {"stps"});
  expect_error(run({"run", "good.toml", "--set", "nonsense"}), 2, {"nonsense"});
  expect_error(
      run({"run", "good.toml", "--set", "mesh.file=\"absent.off\"", "--set", "repair.strategy=magic"}), 2,
      {});
  expect_error(run({"run", "good.toml", "-o", "good.toml/folder"}), 2, {"good.toml"});
  for (const std::string& name : files()) EXPECT_EQ(fs::path(name).extension(), ".toml") << name;
}

TEST_F(Run, QuadrilateralsNeedTheOptionOrTheKey) {
  write("quad.off", "OFF\n4 1 0\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n4 0 1 2 3\n");
  write("s.toml",
        "[mesh]\nfile = \"quad.off\"\n[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\n"
        "[border]\ndefault = \"moving\"\n[time]\ndt = 0.1\nsteps = 2\n");
  expect_error(run({"run", "s.toml"}), 2, {"quad.off:7: ", "--split-quads"});
  EXPECT_EQ(run({"run", "s.toml", "--set", "mesh.split_quads=true", "-o", "key"}).code, 0);
  ASSERT_EQ(run({"run", "s.toml", "--split-quads", "-o", "option"}).code, 0);
  EXPECT_EQ(read_text(path("key/final.off")), read_text(path("option/final.off")));
  EXPECT_TRUE(has(read_text(path("option/scenario.toml")), "split_quads = true"));
}

TEST_F(Run, WhatIsWrongWithAMeshIsSaidWithItsFile) {
  write("bad.su2",
        "NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 2 3\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\n"
        "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 1 3\n");
  write("s.toml",
        "[mesh]\nfile = \"bad.su2\"\n[[motion]]\nfield = \"jitter\"\namplitude = 0.1\nseed = 1\n"
        "[time]\ndt = 1.0\nsteps = 2\n");
  expect_error(run({"run", "s.toml"}), 2, {"bad.su2: ", "wall", "1-3"});
}

TEST_F(Run, TangledStartPointsToUntangle) {
  write("in.off", grid_off(4, {{6, 2.4, 1.2}}));
  write("s.toml",
        "[mesh]\nfile = \"in.off\"\n[[motion]]\nfield = \"jitter\"\namplitude = 0.1\nseed = 1\n"
        "[time]\ndt = 1.0\nsteps = 2\n");
  expect_error(run({"run", "s.toml"}), 2, {"in.off", "untangle"});
  EXPECT_EQ(files(), (std::vector<std::string>{"in.off", "s.toml"}));
  ASSERT_EQ(run({"untangle", "in.off", "-o", "out.off"}).code, 0);
  fs::rename(path("out.off"), path("in.off"));
  EXPECT_EQ(run({"run", "s.toml"}).code, 0);
  EXPECT_EQ(fs::path(last_mesh("s")).extension(), ".off");
}

TEST_F(Run, BordersThatNeverWentTogetherAreABadStart) {
  write("cross.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 -1 0\n3 1 0\n1 1 0\n3 0 1 2\n3 3 4 5\n");
  write("s.toml",
        "[mesh]\nfile = \"cross.off\"\n[[motion]]\nfield = \"jitter\"\namplitude = 0.1\nseed = 1\n"
        "[time]\ndt = 1.0\nsteps = 2\n");
  expect_error(run({"run", "s.toml"}), 2, {"cross.off", "0-1"});
}

TEST_F(Run, StopsWithTheLastValidMeshWhereNoneExists) {
  write("ring.toml", collision_toml);
  const Result result = run({"run", "ring.toml", "-q"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "");
  ASSERT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_EQ(result.err.rfind("kinemesh: ring.toml: ", 0), 0u) << result.err;
  EXPECT_TRUE(has(result.err, "edge")) << result.err;
  EXPECT_EQ(run({"check", last_mesh("ring")}).code, 0);
  EXPECT_TRUE(has(run({"run", "ring.toml", "--force"}).out, "2 of 10"));
}

TEST_F(Run, AdaptiveStepsAreHalvedDownToTheShortest) {
  write("s.toml", collision_toml);
  const Result result =
      run({"run", "s.toml", "--set", "time.adaptive.min_dt=0.04", "--set", "time.adaptive.max_dt=0.4"});
  EXPECT_EQ(result.code, 1);
  const std::string why = result.err_lines().back();
  EXPECT_TRUE(has(why, " has no valid mesh: ")) << why;
  EXPECT_TRUE(has(why, "cannot be halved, min_dt is 0.04")) << why;
  EXPECT_TRUE(has(result.out, " rejected, to t = ")) << result.out;
  const auto rows = lines_of(read_text(path("s/steps.csv")));
  EXPECT_EQ(rows.back().back(), '0');
  EXPECT_GE(std::ranges::count_if(rows, [](const auto& row) { return row.ends_with(",0"); }), 2);
  EXPECT_EQ(run({"check", last_mesh("s")}).code, 0);
}

TEST_F(Run, InterruptEndsTheRunAfterAStep) {
  write("long.toml", jitter_toml);
  const pid_t process =
      start({"run", "long.toml", "-q", "--set", "time.steps=1000000", "--set", "output.every=0"});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (lines_of(read_text(path("long/steps.csv"))).size() < 5 &&
         std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_EQ(kill(process, SIGINT), 0);
  const Result result = wait(process);
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_TRUE(has(result.err, "SIGINT") || has(result.err, "interrupt")) << result.err;
  const auto rows = lines_of(read_text(path("long/steps.csv"))).size() - 1;
  EXPECT_GE(rows, 4u);
  EXPECT_LT(rows, 1000000u);
  expect_complete("long", static_cast<int>(rows));
  // The command it says goes on with that very run, and only with that.
  EXPECT_TRUE(has(result.err, "; to go on: kinemesh run 'long/scenario.toml' -o 'long' --resume\n"))
      << result.err;
  EXPECT_EQ(run({"run", "long/scenario.toml", "-o", "long", "--resume", "--dry-run"}).code, 0);
  expect_error(run({"run", "long/scenario.toml", "-o", "long", "--resume", "--set", "motion.0.seed=8"}), 2,
               {"long/scenario.toml: ", "another scenario", "seed = 7 there, seed = 8 here"});
  expect_error(run({"run", "long.toml", "-q"}), 2, {"--resume", "--force"});
}

}  // namespace
}  // namespace kinemesh::testing
