// What the program may not do to files: write through links, replace what is not its own, write where another
// process writes; and what its exit codes say of what it wrote.
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "program.h"
#include "tests/sim/helpers.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

const std::string rotor =
    "[mesh]\nshape = \"square\"\nvertices = 300\n"
    "[[motion]]\nfield = \"rotor\"\ncenter = [0.5, 0.5]\nradius = 0.3\nrate = 6.283\n";

std::string steps(int n, const std::string& more = "") {
  return rotor + "[time]\ndt = 0.02\nsteps = " + std::to_string(n) + "\n[output]\ncheckpoint = 5\n" + more;
}

// All files below a folder with their contents; of links where they lead.
std::map<std::string, std::string> everything_in(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_symlink())
      all[name] = "-> " + fs::read_symlink(entry.path()).string();
    else if (entry.is_regular_file())
      all[name] = read_text(entry.path());
  }
  return all;
}

class Files : public ProgramTest {
 protected:
  // The command ends with exit code 2 and leaves every file as it was.
  void expect_untouched(const std::vector<std::string>& arguments,
                        std::initializer_list<const char*> words) const {
    const auto before = everything_in(path("."));
    expect_error(run(arguments), 2, words);
    EXPECT_TRUE(everything_in(path(".")) == before) << arguments.front();
  }

  Result run_limited(int resource, rlim_t limit, const std::vector<std::string>& arguments) const {
    rlimit old{};
    EXPECT_EQ(getrlimit(resource, &old), 0);
    const rlimit small{limit, old.rlim_max};
    EXPECT_EQ(setrlimit(resource, &small), 0);
    const pid_t process = start(arguments);
    EXPECT_EQ(setrlimit(resource, &old), 0);
    return wait(process);
  }

  // As it would be if the run had been killed.
  void make_unfinished(const std::string& folder) const {
    std::string json = read_text(path(folder + "/run.json"));
    json.replace(json.find("\"done\""), 6, "\"running\"");
    write(folder + "/run.json", json);
  }

  bool wait_for(const std::string& name) const {
    for (int i = 0; i < 2000 && !fs::exists(path(name)); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return fs::exists(path(name));
  }
};

// ---- Inputs -----------------------------------------------------------------------------------------------

TEST_F(Files, ARecordedSeriesIsNotReplacedByItsRun) {
  write("s.toml", steps(20, "every = 5\n"));
  ASSERT_EQ(run({"run", "s.toml", "-o", "prev", "-q"}).code, 0);
  fs::create_directory(path("series"));
  for (const char* name : {"mesh.pvd", "mesh_000000.vtu", "mesh_000005.vtu", "mesh_000010.vtu",
                           "mesh_000015.vtu", "mesh_000020.vtu"})
    fs::copy(path("prev") / name, path("series") / name);
  fs::copy(path("prev/mesh_000000.vtu"), path("start.vtu"));
  const std::string motion = "[[motion]]\nfield = \"recorded\"\nfile = \"";
  const std::string time = "\"\n[time]\ndt = 0.2\nend = 0.4\n[border]\ndefault = \"moving\"\n";
  write("rec.toml", "[mesh]\nfile = \"start.vtu\"\n" + motion + "series/mesh.pvd" + time);
  for (const char* option : {"-q", "--force", "--resume"})
    expect_untouched({"run", "rec.toml", "-o", "series", option}, {"series", "would replace"});
  // Of a run's own folder, where each of them is listed.
  write("own.toml", "[mesh]\nfile = \"start.vtu\"\n" + motion + "prev/mesh.pvd" + time);
  expect_untouched({"run", "own.toml", "-o", "prev", "--force"}, {"would replace"});
  // Through links of both kinds.
  fs::create_directory(path("linked"));
  fs::create_symlink("../prev/mesh_000000.vtu", path("linked/first.vtu"));
  write("mesh.toml", "[mesh]\nfile = \"linked/first.vtu\"\n" + motion + "series/mesh.pvd" + time);
  expect_untouched({"run", "mesh.toml", "-o", "prev", "--force"}, {"mesh_000000.vtu", "would replace"});
  fs::create_hard_link(path("prev/mesh_000000.vtu"), path("hard.vtu"));
  write("hard.toml", "[mesh]\nfile = \"hard.vtu\"\n" + motion + "series/mesh.pvd" + time);
  expect_untouched({"run", "hard.toml", "-o", "prev", "--force"}, {"mesh_000000.vtu", "would replace"});
  EXPECT_EQ(run({"run", "rec.toml", "-o", "new", "-q"}).code, 0);
}

TEST_F(Files, TheTableOfABodyIsNotReplacedByItsRun) {
  ASSERT_TRUE(fs::create_directory(path("d")));
  write("d/steps.csv", "t,x,y,angle\n0,0,0,0\n1,0.1,0,0\n");
  write("b.toml",
        "[mesh]\nshape = \"channel\"\nvertices = 300\n[[body]]\non = \"marker:cylinder\"\n"
        "motion = [{field = \"rigid\", file = \"d/steps.csv\"}]\n[time]\ndt = 0.1\nsteps = 2\n");
  for (const char* option : {"-q", "--force", "--resume"}) {
    const auto before = everything_in(path("."));
    EXPECT_EQ(run({"run", "b.toml", "-o", "d", option}).code, 2);
    EXPECT_TRUE(everything_in(path(".")) == before);
  }
  EXPECT_EQ(run({"run", "b.toml", "-o", "new", "-q"}).code, 0);
  expect_untouched({"run", "b.toml", "-o", "longer", "-q", "--set", "time.steps=20"},
                   {"b.toml:6: ", "d/steps.csv: rows from time 0 to 1, but needed from 0 to 2"});
}

TEST_F(Files, InputsOfABenchmarkAreNotReplacedByIt) {
  ASSERT_TRUE(fs::create_directory(path("b")));
  write("b/bench.csv", "strategy,step,time\nx,y,u,v\n0,0,1,0\n1,0,1,0\n0,1,1,0\n1,1,1,0\n");
  write("g.toml",
        "[mesh]\nshape = \"square\"\nvertices = 300\n[[motion]]\nfield = \"grid\"\nfile = \"b/bench.csv\"\n"
        "[time]\ndt = 0.02\nsteps = 2\n");
  const auto before = everything_in(path("."));
  EXPECT_EQ(run({"bench", "g.toml", "--strategies", "global", "-o", "b", "--force"}).code, 2);
  EXPECT_TRUE(everything_in(path(".")) == before);
}

TEST_F(Files, TwoArgumentsMayNotNameOneFile) {
  const std::string mesh = write("m.off", grid_off(3, {{5, 2.5, 1.5}}));
  fs::create_symlink("m.off", path("link.off"));
  fs::create_hard_link(path("m.off"), path("hard.off"));
  expect_untouched({"convert", "m.off", "m.off"}, {"m.off", "IN", "OUT"});
  expect_untouched({"convert", "m.off", "./x/../m.off"}, {"m.off"});
  expect_untouched({"convert", "m.off", "link.off"}, {"link.off", "same file"});
  expect_untouched({"convert", "hard.off", "m.off"}, {"same file"});
  expect_untouched({"untangle", "m.off", "-o", "m.off"}, {"MESH", "--output"});
  expect_untouched({"untangle", "m.off", "-o", "o.off", "--report", "m.off"}, {"MESH", "--report"});
  expect_untouched({"untangle", "m.off", "-o", "o.off", "--report", "o.off"}, {"--output", "--report"});
  fs::create_symlink("o.off", path("r.json"));
  expect_untouched({"untangle", "m.off", "-o", "o.off", "--report", "r.json"}, {"--output", "--report"});
  fs::create_symlink("pic.svg", path("drawn.off"));
  write("pic.svg", grid_off(3));
  expect_untouched({"draw", "drawn.off", "-o", "pic.svg"}, {"MESH", "--output"});
}

TEST_F(Files, FilesOfARunAreNotReplacedByAPicture) {
  write("in.su2", "");
  ASSERT_EQ(run({"convert", write("m.off", grid_off(6)), "in.su2"}).code, 0);
  write("s.toml",
        "[mesh]\nfile = \"in.su2\"\n[[motion]]\nfield = \"jitter\"\namplitude = 0.2\n"
        "[time]\ndt = 0.1\nsteps = 3\n[output]\npatches = true\n");
  ASSERT_EQ(run({"run", "s.toml", "-o", "d", "-q"}).code, 0);
  fs::create_symlink("d", path("alias"));
  for (const char* name : {"d/steps.csv", "d/mesh.pvd", "d/final.su2", "d/run.json", "alias/steps.csv",
                           "d/mesh_000777.vtu", "in.su2"})
    expect_untouched({"report", "d", "-o", name}, {name});
  expect_untouched({"draw", "d", "--step", "1", "-o", "d/final.svg"}, {"final.svg", "file of the run"});
  write("d/report.html", "<title>somebody else's</title>");
  expect_untouched({"report", "d"}, {"report.html", "-o"});
  EXPECT_EQ(run({"report", "d", "-o", "d/page.html"}).code, 0);
  EXPECT_EQ(run({"report", "d", "-o", "d/page.html"}).code, 0) << "a page of ours is replaced";
}

// ---- Links, pipes, folders --------------------------------------------------------------------------------

TEST_F(Files, NothingIsWrittenThroughLinks) {
  write("s.toml", steps(20));
  write("victim", "precious");
  ASSERT_EQ(run({"run", "s.toml", "-o", "d", "-q"}).code, 0);
  fs::create_symlink("../victim", path("d/report.html"));
  expect_untouched({"report", "d"}, {"report.html", "symbolic link"});
  fs::create_symlink("victim", path("p.html"));
  expect_untouched({"report", "d", "-o", "p.html"}, {"p.html", "symbolic link"});
  make_unfinished("d");
  fs::remove(path("d/steps.csv"));
  fs::create_symlink("../victim", path("d/steps.csv"));
  expect_untouched({"run", "s.toml", "-o", "d", "-q", "--resume"}, {"steps.csv", "symbolic link"});
  expect_untouched({"run", "s.toml", "-o", "d", "-q", "--force"}, {"steps.csv", "symbolic link"});
  fs::create_symlink("victim", path("p.svg"));
  write("m.off", grid_off(3));
  expect_untouched({"draw", "m.off", "-o", "p.svg"}, {"p.svg", "symbolic link"});
  EXPECT_EQ(read_text(path("victim")), "precious");
}

TEST_F(Files, ABenchmarkWritesThroughNoLinkEither) {
  write("s.toml", steps(2));
  write("victim", "precious");
  ASSERT_TRUE(fs::create_directory(path("elsewhere")));
  for (const char* name :
       {"bench.csv", "bench_regions.csv", "bench_bound.csv", "plots/steps.gp", "plots/steps.svg"}) {
    fs::remove_all(path("b"));
    ASSERT_TRUE(fs::create_directories(path("b/plots")));
    fs::create_symlink(path("victim"), path("b") / name);
    expect_untouched({"bench", "s.toml", "--strategies", "global", "-o", "b", "--force"}, {"symbolic link"});
    fs::remove(path("b") / name);
    ASSERT_EQ(mkfifo((path("b") / name).c_str(), 0600), 0);
    expect_error(run({"bench", "s.toml", "--strategies", "global", "-o", "b", "--force"}), 2,
                 {"regular file"});
  }
  fs::remove_all(path("b"));
  ASSERT_TRUE(fs::create_directory(path("b")));
  fs::create_symlink("../elsewhere", path("b/plots"));
  expect_untouched({"bench", "s.toml", "--strategies", "global", "-o", "b"}, {"plots", "is not a folder"});
  EXPECT_TRUE(fs::is_empty(path("elsewhere")));
}

TEST_F(Files, ABenchmarkReplacesOnlyWhatABenchmarkHasWritten) {
  write("s.toml", steps(2));
  const std::vector<std::string> bench = {"bench", "s.toml", "--strategies", "global", "-o", "b"};
  std::vector<std::string> forced = bench;
  forced.push_back("--force");
  ASSERT_TRUE(fs::create_directory(path("b")));
  write("b/bench_regions.csv", "mine");
  expect_untouched(bench, {"bench_regions.csv", "--force"});
  expect_untouched(forced, {"bench_regions.csv", "in the way"});
  write("b/bench_regions.csv", "");  // as left by a process that was killed
  EXPECT_EQ(run(forced).code, 0);
  EXPECT_EQ(run(forced).code, 0);
}

// What the user names may be a link: it leads to what is meant.
TEST_F(Files, AnOutputThatTheUserNamesByALinkIsWhatItLeadsTo) {
  write("m.off", grid_off(3));
  fs::create_symlink("real.obj", path("link.obj"));
  ASSERT_EQ(run({"convert", "m.off", "link.obj"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.obj")));
  EXPECT_TRUE(fs::is_regular_file(path("real.obj")));
}

// ---- One writer -------------------------------------------------------------------------------------------

TEST_F(Files, AFolderHasOneWriter) {
  write("s.toml", steps(400, "patches = true\n"));
  ASSERT_EQ(run({"run", "s.toml", "-o", "ref", "-q"}).code, 0);
  const pid_t first = start({"run", "s.toml", "-o", "d", "-q", "--threads", "1"});
  ASSERT_TRUE(wait_for("d/checkpoint.bin"));
  kill(first, SIGSTOP);
  for (const char* option : {"--resume", "--force"}) {
    expect_error(run({"run", "s.toml", "-o", "d", "-q", option}), 2, {"d", "another kinemesh"});
    expect_error(run({"bench", "s.toml", "--strategies", "global", "-o", "d", "--force"}), 2,
                 {"d", "another kinemesh"});
  }
  kill(first, SIGCONT);
  EXPECT_EQ(wait(first).code, 0);
  EXPECT_TRUE(test::results_in(path("d")) == test::results_in(path("ref")));
}

TEST_F(Files, TheLockOfAKilledRunIsGone) {
  write("s.toml", steps(400));
  const pid_t first = start({"run", "s.toml", "-o", "d", "-q"});
  ASSERT_TRUE(wait_for("d/checkpoint.bin"));
  kill(first, SIGKILL);
  EXPECT_EQ(wait(first).code, 128 + SIGKILL);
  EXPECT_EQ(run({"run", "s.toml", "-o", "d", "-q", "--resume", "--set", "time.steps=400"}).code, 0);
}

// ---- Exit codes -------------------------------------------------------------------------------------------

TEST_F(Files, AFullDiskIsOneOfARunAndThreeOfOthers) {
  write("m.off", grid_off(20, {{50, 12.5, 1.5}}));
  const Result converted = run_limited(RLIMIT_FSIZE, 500, {"convert", "m.off", "o.off"});
  expect_error(converted, 3, {"o.off", "File too large"});
  EXPECT_FALSE(fs::exists(path("o.off")));
  const Result untangled = run_limited(RLIMIT_FSIZE, 500, {"untangle", "m.off", "-o", "o.off"});
  expect_error(untangled, 3, {"o.off", "File too large"});
  write("s.toml", steps(5));
  const Result stopped = run_limited(RLIMIT_FSIZE, 2500, {"run", "s.toml", "-o", "d", "-q"});
  expect_error(stopped, 1, {"d", "File too large", "to go on"});
  EXPECT_EQ(run({"run", "s.toml", "-o", "d", "-q", "--resume"}).code, 0);
  EXPECT_EQ(run_limited(RLIMIT_FSIZE, 500, {"report", "d"}).code, 3);
  EXPECT_FALSE(fs::exists(path("d/report.html")));
  expect_error(run_limited(RLIMIT_FSIZE, 250, {"bench", "s.toml", "--strategies", "global", "-o", "b"}), 3,
               {"b", "File too large"});
}

TEST_F(Files, StandardOutputThatIsFullIsAFailure) {
  write("m.off", grid_off(3));
  write("s.toml", steps(2));
  const auto code_of = [&](const std::string& command) {
    const int status = std::system(
        ("cd " + path(".").string() + " && " KINEMESH_PROGRAM " " + command + " > /dev/full 2> err").c_str());
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(code_of("check m.off"), 3);
  EXPECT_EQ(code_of("list"), 3);
  EXPECT_EQ(code_of("run s.toml"), 1);
}

// Both outputs or none of them.
TEST_F(Files, BadInputMeansThatNothingWasWritten) {
  write("m.off", grid_off(4, {{6, 2.5, 2.5}}));
  expect_untouched({"untangle", "m.off", "-o", "o.off", "--report", "none/r.json"}, {"none/r.json"});
  expect_untouched({"untangle", "m.off", "-o", "o.off", "--report", "."}, {"is a directory"});
  expect_untouched({"untangle", "m.off", "-o", "none/o.off"}, {"none/o.off"});
  write("s.toml", steps(3));
  expect_untouched({"bench", "s.toml", "--strategies", "global", "-o", "b", "--sweep", "mesh.frame=0.25,0",
                    "--set", "border.default=\"moving\""},
                   {"frame"});
  expect_untouched({"bench", "s.toml", "--strategies", "global", "-o", "s.toml"}, {"is not a folder"});
}

}  // namespace
}  // namespace kinemesh::testing
