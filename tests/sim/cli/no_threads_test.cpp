// Where the system gives no threads, or fewer than there are cores, all is done without, to the same bits.
#include <sys/resource.h>

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

class NoThreads : public ProgramTest {
 protected:
  void SetUp() override {
    if (KINEMESH_NO_PRELOAD) GTEST_SKIP() << "sanitizers want to be loaded first";
    write("s.toml",
          "[mesh]\nshape = \"square\"\nvertices = 20000\n[[motion]]\nfield = \"jitter\"\namplitude = 0.3\n"
          "[time]\ndt = 0.1\nsteps = 3\n[output]\npatches = true\n");
    write("tangled.off", grid_off(150, {{5000, 20.3, 35.4}, {9000, 95.2, 61.7}, {20000, 66.1, 130.3}}));
  }

  // A program that can make so many threads.
  Result run_with(int threads, const std::vector<std::string>& arguments) const {
    const Environment environment(
        {{"LD_PRELOAD", KINEMESH_FAILING_THREADS}, {"KINEMESH_THREADS", std::to_string(threads)}});
    return run(arguments);
  }

  // With so much address space.
  Result run_limited(rlim_t megabytes, const std::vector<std::string>& arguments) const {
    rlimit old{};
    EXPECT_EQ(getrlimit(RLIMIT_AS, &old), 0);
    const rlimit small{megabytes << 20, old.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_AS, &small), 0);
    const pid_t process = start(arguments);
    EXPECT_EQ(setrlimit(RLIMIT_AS, &old), 0);
    return wait(process);
  }
};

TEST_F(NoThreads, ARunWritesTheSameFiles) {
  ASSERT_EQ(run({"run", "s.toml", "-o", "usual", "-q"}).code, 0);
  const auto expected = test::results_in(path("usual"));
  for (const int threads : {0, 1, 2}) {
    const Result result = run_with(threads, {"run", "s.toml", "-o", "without", "-q", "--force"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(test::results_in(path("without")) == expected) << threads;
  }
}

TEST_F(NoThreads, AResumedRunToo) {
  ASSERT_EQ(run({"run", "s.toml", "-o", "usual", "-q"}).code, 0);
  ASSERT_EQ(
      run_with(0, {"run", "s.toml", "-o", "without", "-q", "--set", "time.steps=3", "--threads", "8"}).code,
      0);
  EXPECT_TRUE(test::results_in(path("without")) == test::results_in(path("usual")));
}

TEST_F(NoThreads, ACheckSaysTheSame) {
  const Result usual = run({"check", "tangled.off", "--json"});
  for (const int threads : {0, 1, 2}) {
    const Result result = run_with(threads, {"check", "tangled.off", "--json"});
    EXPECT_EQ(result.code, usual.code);
    EXPECT_EQ(result.out, usual.out);
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(NoThreads, TheSameMeshIsUntangledAndConverted) {
  for (const char* strategy : {"global", "local", "remesh"}) {
    ASSERT_EQ(run({"untangle", "tangled.off", "-o", "usual.vtu", "--strategy", strategy}).code, 0);
    const Result result =
        run_with(0, {"untangle", "tangled.off", "-o", "without.vtu", "--strategy", strategy});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(read_text(path("usual.vtu")) == read_text(path("without.vtu"))) << strategy;
  }
  for (const char* file : {"without.su2", "without.vtu", "without.msh"})
    EXPECT_EQ(run_with(0, {"convert", "usual.vtu", file}).code, 0) << file;
  EXPECT_EQ(run_with(0, {"check", "without.su2"}).code, 0);
}

TEST_F(NoThreads, ABenchmarkReplacesTheSame) {
  const std::vector<std::string> command{"bench", "s.toml", "--strategies", "global,remesh", "-o"};
  const auto with = [&](const std::string& folder) {
    auto words = command;
    words.push_back(folder);
    return words;
  };
  ASSERT_EQ(run(with("usual")).code, 0);
  const Result result = run_with(0, with("without"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(read_text(path("without/bench_regions.csv")) == read_text(path("usual/bench_regions.csv")));
  EXPECT_EQ(lines_of(read_text(path("without/bench.csv"))).size(),
            lines_of(read_text(path("usual/bench.csv"))).size());
}

// Of memory, too: whatever the limit is, the answer is right, or one line says what is missing.
TEST_F(NoThreads, LittleMemoryIsAnErrorNoCrash) {
  const std::string usual = run({"check", "tangled.off"}).out;
  for (rlim_t megabytes = 48; megabytes < 400; megabytes += megabytes / 6) {
    const Result result = run_limited(megabytes, {"check", "tangled.off"});
    SCOPED_TRACE(std::to_string(megabytes) + " MiB: " + result.err);
    if (result.code == 127) continue;  // not even its libraries could be loaded
    if (result.err.empty()) {
      EXPECT_EQ(result.out, usual);
      EXPECT_EQ(result.code, 1);
    } else {
      EXPECT_EQ(result.err, "kinemesh: out of memory\n");
      EXPECT_EQ(result.code, 3);
    }
  }
}

// A run, too, that has begun: this is not the code of a step without valid mesh.
TEST_F(NoThreads, LittleMemoryInARunIsNoInvalidMesh) {
  for (const rlim_t megabytes : {88, 96, 104, 112, 120}) {
    const Result result = run_limited(megabytes, {"run", "s.toml", "-o", "little", "-q", "--force"});
    SCOPED_TRACE(std::to_string(megabytes) + " MiB: " + result.err);
    if (result.code == 127) continue;
    EXPECT_EQ(result.code, result.err.empty() ? 0 : 3);
    EXPECT_EQ(result.err.empty(), result.err.find("out of memory") == std::string::npos);
  }
}

}  // namespace
}  // namespace kinemesh::testing
