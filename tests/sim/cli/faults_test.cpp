// Every call of a run that changes a file goes wrong in turn: what the run leaves is whole steps, and
// --resume makes of it what an undisturbed run leaves. KINEMESH_ALL_FAULTS: all of them instead of a share,
// for scripts/inject_faults.sh.
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

#include "program.h"
#include "tests/sim/helpers.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KINEMESH_NO_PRELOAD 1
#else
#define KINEMESH_NO_PRELOAD 0
#endif

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;
using Results = std::map<std::string, std::string>;

const char* const scenario =
    "[mesh]\nshape = \"square\"\nvertices = 120\n"
    "[[motion]]\nfield = \"jitter\"\namplitude = 0.4\n"
    "[time]\ndt = 0.1\nsteps = 6\n"
    "[output]\nevery = 2\ncheckpoint = 3\npatches = true\n";

class Faults : public ProgramTest {
 protected:
  void SetUp() override {
    if (KINEMESH_NO_PRELOAD) GTEST_SKIP() << "sanitizers want to be loaded first";
    write("s.toml", scenario);
    ASSERT_EQ(run(command("whole")).code, 0);
    expected_ = test::results_in(path("whole"));
  }

  static std::vector<std::string> command(const std::string& folder) {
    return {"run", "s.toml", "-o", folder, "-q", "--threads", "1", "--resume"};
  }

  int calls_of(const std::string& folder) const {
    const std::string counter = path("count").string();
    fs::remove(counter);
    const Environment counting({{"LD_PRELOAD", KINEMESH_FAILING_FILES}, {"KINEMESH_FAULT_COUNT", counter}});
    EXPECT_EQ(run(command(folder)).code, 0);
    return static_cast<int>(fs::file_size(counter));
  }

  Result run_with_fault(const std::string& folder, const std::string& fault, int call) const {
    const Environment faulty({{"LD_PRELOAD", KINEMESH_FAILING_FILES},
                              {"KINEMESH_FAULT", fault},
                              {"KINEMESH_FAULT_AT", std::to_string(call)}});
    return run(command(folder));
  }

  // Logs of whole steps, the same number of them in both, and meshes that belong to them. Where it has not
  // come so far that there is a folder, nothing.
  void expect_whole_steps(const std::string& folder) const {
    if (!fs::exists(path(folder))) return;
    const Results left = test::results_in(path(folder));
    size_t steps = 0;
    for (const auto& [name, content] : left) {
      const auto& whole = expected_.count(name) ? expected_.at(name) : content;
      if (name == "steps.csv") {
        EXPECT_EQ(whole.substr(0, content.size()), content);
        EXPECT_TRUE(content.empty() || content.back() == '\n');
        steps = lines_of(content).size();
      } else if (name == "regions.csv" || name == "patches.bin") {
        EXPECT_TRUE(whole.starts_with(content)) << name;
      } else if (name != "mesh.pvd" && !name.starts_with("final.")) {
        EXPECT_TRUE(content == whole) << name;
      }
    }
    expect_regions_of(left, steps);
  }

  void expect_regions_of(const Results& left, size_t rows) const {
    if (!left.count("regions.csv") || rows == 0) return;
    std::string upto;
    for (const auto& line : lines_of(expected_.at("regions.csv")))
      if (line.starts_with("step") || std::stoul(line) < rows) upto += line + "\n";
    // A run that could not be gone on with has its regions as they were found, behind its checkpoint, too.
    const bool has_not_begun = rows == rows_found_;
    // A new one that could not write its headers has neither steps nor regions.
    const bool has_headers_only = rows == 1 && rows_found_ == 0;
    if (has_not_begun)
      EXPECT_TRUE(left.at("regions.csv").starts_with(upto));
    else if (has_headers_only)
      EXPECT_TRUE(upto.starts_with(left.at("regions.csv")));
    else
      EXPECT_EQ(left.at("regions.csv"), upto);
  }

  void expect_resumes(const std::string& folder) const {
    const Result resumed = run(command(folder));
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_TRUE(test::results_in(path(folder)) == expected_);
  }

  // prepare() makes the folder as it is before the run with the fault.
  template <class Prepare>
  void try_all(const Prepare& prepare) {
    prepare("counted");
    const int calls = calls_of("counted");
    EXPECT_GT(calls, 40);
    const int stride = std::getenv("KINEMESH_ALL_FAULTS") ? 1 : 4;
    int points = 0;
    for (const std::string fault : {"fail", "full", "kill"}) {
      for (int call = 1 + points % stride; call <= calls; call += stride, ++points) {
        SCOPED_TRACE(fault + " at call " + std::to_string(call) + " of " + std::to_string(calls));
        prepare("faulty");
        expect_survives(run_with_fault("faulty", fault, call), fault == "kill");
        fs::remove_all(path("faulty"));
        if (HasFailure()) return;
      }
    }
    RecordProperty("calls", calls);
    RecordProperty("points", points);
    if (stride == 1) printf("%d calls that change files, %d faults\n", calls, points);
  }

  // A call whose failure does not matter may fail without ending the run.
  void expect_survives(const Result& result, bool is_killed) const {
    if (is_killed) {
      EXPECT_EQ(result.code, 128 + SIGKILL) << result.err;
    } else if (result.code != 0) {
      EXPECT_LE(result.code, 2) << result.err;
      EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
      EXPECT_EQ(result.err.rfind("kinemesh: ", 0), 0u) << result.err;
      EXPECT_NE(result.err.find("faulty"), std::string::npos) << "no file in: " << result.err;
      if (result.code == 1) expect_whole_steps("faulty");  // 2: not a step was done
    }
    expect_resumes("faulty");
  }

  Results expected_;
  size_t rows_found_ = 0;  // of steps.csv up to the checkpoint, with its header, where there is one
};

TEST_F(Faults, OfANewRunLoseNothing) {
  try_all([](const std::string&) {});
}

TEST_F(Faults, OfAResumedRunLoseNothing) {
  const int late = calls_of("scratch") * 3 / 4;
  ASSERT_EQ(run_with_fault("killed", "kill", late).code, 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(path("killed/checkpoint.bin")));
  rows_found_ = 1 + 3;
  try_all([&](const std::string& folder) { fs::copy(path("killed"), path(folder)); });
}

// As on a full disk, but without one: no file may become longer. The program gets no signal for it.
TEST_F(Faults, AFileThatMayNotGrowEndsTheRun) {
  write("s.toml", std::string(scenario) + "[repair]\nretain = true\n");
  ASSERT_EQ(run({"run", "s.toml", "-o", "long", "-q", "--set", "time.steps=300"}).code, 0);
  const auto expected = test::results_in(path("long"));
  const std::vector<std::string> limited = {"run",      "s.toml", "-o",    "short",
                                            "--resume", "-q",     "--set", "time.steps=300"};
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{40000, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const pid_t process = start(limited);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  const Result result = wait(process);
  EXPECT_EQ(result.code, 1) << result.err;
  ASSERT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_NE(result.err.find("File too large; to go on: kinemesh run"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(path("short/checkpoint.bin")));
  const auto left = test::results_in(path("short"));
  EXPECT_EQ(expected.at("steps.csv").substr(0, left.at("steps.csv").size()), left.at("steps.csv"));
  EXPECT_EQ(run(limited).code, 0);
  EXPECT_TRUE(test::results_in(path("short")) == expected);
}

}  // namespace
}  // namespace kinemesh::testing
