// Programs killed with SIGKILL at random moments and started again: nothing is lost, nothing comes twice,
// nothing of the killed stays in the way. Where the system allows it, each is the first process of a pid
// namespace of its own, so that all of them have the same number. KINEMESH_KILLS: how many, for
// scripts/kill_and_resume.sh.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>
#include <utility>

#include "program.h"
#include "tests/sim/helpers.h"

namespace kinemesh::testing {
namespace {

using Clock = std::chrono::steady_clock;

const char* const scenario =
    "[mesh]\nshape = \"square\"\nvertices = 400\n"
    "[[motion]]\nfield = \"rotor\"\ncenter = [0.5, 0.5]\nradius = 0.3\nrate = 6.28\n"
    "[[motion]]\nfield = \"brownian\"\ndiffusion = 1e-3\n"
    "[time]\ndt = 0.01\nsteps = 60\n"
    "[repair]\nquality = \"delaunay\"\n"
    "[output]\nevery = 7\ncheckpoint = 3\npatches = true\n";

int number_of_kills() {
  const char* text = std::getenv("KINEMESH_KILLS");
  return text ? std::atoi(text) : 6;
}

// The only child of a process, or 0.
pid_t child_of(pid_t process) {
  const std::string id = std::to_string(process);
  return std::atoi(read_text("/proc/" + id + "/task/" + id + "/children").c_str());
}

class Kill : public ProgramTest {
 protected:
  Kill() : has_namespaces_(wait(start_in_namespace({"--version"})).code == 0) {
    static bool told = false;
    if (!has_namespaces_ && !std::exchange(told, true))
      std::printf("skipped: pid namespaces, which this system does not allow; numbers of processes differ\n");
  }

  pid_t begin(const std::vector<std::string>& arguments) const {
    return has_namespaces_ ? start_in_namespace(arguments) : start(arguments);
  }

  // Killed some time after its start; false if it had ended by then.
  bool start_and_kill(const std::vector<std::string>& arguments, Clock::duration moment) const {
    const pid_t process = begin(arguments);
    std::this_thread::sleep_for(moment);
    const pid_t child = has_namespaces_ ? child_of(process) : 0;
    kill(child > 0 ? child : process, SIGKILL);
    return wait(process).code == 128 + SIGKILL;
  }

  bool has_namespaces_;
};

// A command that writes, and what it writes.
struct Writing {
  std::vector<std::string> arguments;
  std::vector<std::string> again;  // after a kill
  std::vector<std::string> files;  // each whole or not there; folders: of a run or benchmark
};

// Now and then more than once; where nothing was written yet, the run starts anew.
TEST_F(Kill, AtAnyMomentLosesNothing) {
  write("s.toml", scenario);
  const auto start = Clock::now();
  ASSERT_EQ(run({"run", "s.toml", "-o", "whole", "-q"}).code, 0);
  const auto length = Clock::now() - start;
  const auto expected = test::results_in(path("whole"));
  ASSERT_EQ(expected.count("mesh_000056.vtu"), 1u);

  std::mt19937 random(1);
  const auto moment = [&] { return length * static_cast<int>(random() % 1000) / 1000; };
  int kills = 0;
  for (int trial = 0; kills < number_of_kills(); ++trial) {
    ASSERT_LT(trial, 20 * number_of_kills()) << "the program is always faster than the test";
    const std::string folder = "killed" + std::to_string(trial);
    do {
      kills += start_and_kill({"run", "s.toml", "-o", folder, "-q", "--resume"}, moment());
    } while (random() % 2 == 0);
    const Result result = run({"run", "s.toml", "-o", folder, "-q", "--resume"});
    ASSERT_EQ(result.code, 0) << result.err;
    ASSERT_EQ(test::results_in(path(folder)), expected) << "trial " << trial;
    std::filesystem::remove_all(path(folder));
  }
  RecordProperty("kills", kills);
}

TEST_F(Kill, AnyCommandLeavesWholeFilesAndNothingInTheWay) {
  write("s.toml", scenario);
  write("long.off", grid_off(50, {{200, 40.5, 3.5}, {1300, 12.5, 25.5}}));
  write("bad.toml",
        "[mesh]\nshape = \"annulus\"\nvertices = 400\n"
        "[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\non = \"marker:inner\"\n"
        "[border]\nouter = \"fixed\"\n[time]\ndt = 0.4\nsteps = 10\n");
  ASSERT_EQ(run({"run", "s.toml", "-o", "whole", "-q"}).code, 0);
  ASSERT_EQ(run({"run", "bad.toml", "-o", "bad", "-q", "--dump-on-failure"}).code, 1);
  const std::vector<Writing> all = {
      {{"convert", "long.off", "out/a.vtu"}, {}, {"a.vtu"}},
      {{"untangle", "long.off", "-o", "out/b.off", "--report", "out/b.json"}, {}, {"b.off", "b.json"}},
      {{"replay", "bad/failed_step.bin", "--before", "out/c.su2", "--after", "out/d.su2"},
       {},
       {"c.su2", "d.su2"}},
      {{"report", "whole", "-o", "out/e.html"}, {}, {"e.html"}},
      {{"draw", "long.off", "-o", "out/f.svg"}, {}, {"f.svg"}},
      {{"draw", "long.off", "-o", "out/g.png"}, {}, {"g.png"}},
      {{"bench", "s.toml", "--strategies", "global", "-o", "out"},
       {"bench", "s.toml", "--strategies", "global", "-o", "out", "--force"},
       {}},
      {{"run", "s.toml", "-o", "out", "-q", "--force"},
       {"run", "s.toml", "-o", "out", "-q", "--resume"},
       {}}};

  struct Undisturbed {
    int code;
    Clock::duration length;
    std::map<std::string, std::string> results;
  };
  std::vector<Undisturbed> undisturbed;
  for (const Writing& writing : all) {
    std::filesystem::create_directory(path("out"));
    const auto start_time = Clock::now();
    const int code = wait(begin(writing.arguments)).code;
    undisturbed.push_back({code, Clock::now() - start_time, test::results_in(path("out"))});
    std::filesystem::remove_all(path("out"));
  }

  std::mt19937 random(2);
  int kills = 0;
  for (int trial = 0; kills < number_of_kills(); ++trial) {
    ASSERT_LT(trial, 20 * number_of_kills() + 100);
    const auto& [arguments, again, files] = all[trial % all.size()];
    const auto& [code, length, expected] = undisturbed[trial % all.size()];
    SCOPED_TRACE(arguments.front() + ", trial " + std::to_string(trial));
    std::filesystem::create_directory(path("out"));
    kills += start_and_kill(arguments, length * static_cast<int>(random() % 1000) / 1000);
    for (const std::string& name : files) {
      const bool is_there = std::filesystem::exists(path("out/" + name));
      ASSERT_TRUE(!is_there || read_text(path("out/" + name)) == expected.at(name)) << name;
    }
    const Result result = wait(begin(again.empty() ? arguments : again));
    ASSERT_EQ(result.code, code) << result.err;
    for (const auto& entry : std::filesystem::directory_iterator(path("out")))
      ASSERT_NE(entry.path().extension(), ".tmp") << entry.path();
    const bool has_times = arguments.front() == "bench";
    ASSERT_TRUE(has_times || test::results_in(path("out")) == expected);
    std::filesystem::remove_all(path("out"));
  }
  RecordProperty("kills", kills);
}

}  // namespace
}  // namespace kinemesh::testing
