// Runs killed with SIGKILL at random moments and gone on with: nothing is lost, nothing comes twice.
// KINEMESH_KILLS: how many, for scripts/kill_and_resume.sh.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

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

class Kill : public ProgramTest {
 protected:
  // Of the moment of the kill, from the start of the program; false if it had ended by then.
  bool start_and_kill(const std::string& folder, Clock::duration moment) const {
    const pid_t process = start({"run", "s.toml", "-o", folder, "-q", "--resume"});
    std::this_thread::sleep_for(moment);
    kill(process, SIGKILL);
    return wait(process).code == 128 + SIGKILL;
  }
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
      kills += start_and_kill(folder, moment());
    } while (random() % 2 == 0);
    const Result result = run({"run", "s.toml", "-o", folder, "-q", "--resume"});
    ASSERT_EQ(result.code, 0) << result.err;
    ASSERT_EQ(test::results_in(path(folder)), expected) << "trial " << trial;
    std::filesystem::remove_all(path(folder));
  }
  RecordProperty("kills", kills);
}

}  // namespace
}  // namespace kinemesh::testing
