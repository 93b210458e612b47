// Long runs, every mesh validated, once undisturbed and once killed again and again.
//   endurance SCENARIO VERTICES STEPS KILLS FOLDER
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <random>

#include "kinemesh/run.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

struct Arguments {
  std::filesystem::path scenario;
  std::string vertices, steps;
  int kills;
  std::filesystem::path folder;
};

Scenario long_scenario(const Arguments& arguments) {
  const std::vector<std::string> overrides = {"mesh.vertices=" + arguments.vertices,
                                              "time.steps=" + arguments.steps, "output.every=1000",
                                              "output.checkpoint=25"};
  return load_scenario(arguments.scenario, overrides);
}

class Validate : public RunObserver {
 public:
  void stepped(const StepRecord& record, const Mesh& mesh) override {
    if (const auto defect = validate(mesh)) {
      fmt::print("step {}: {}\n", record.step, defect->message());
      std::fflush(stdout);
      std::_Exit(3);
    }
    ++steps;
    smallest_angle = std::min(smallest_angle, record.min_angle_deg);
  }
  int steps = 0;
  double smallest_angle = 180.0;
};

// In a process of its own.
int run_to_the_end(const Arguments& arguments, const char* name) {
  Validate observer;
  RunOptions options;
  options.directory = arguments.folder / name;
  options.resume = true;
  const auto summary = run(long_scenario(arguments), options, observer);
  if (summary.stopped) fmt::print("{}\n", *summary.stopped);
  if (observer.steps > 0 && summary.plan.steps_done == 0)
    fmt::print(
        "{} steps, all valid, {} tangled, {} faces replaced, {:.3g} % a step, smallest angle {:.2g} "
        "degrees\n",
        observer.steps, summary.steps_tangled, summary.replaced, 100 * summary.share_mean,
        observer.smallest_angle);
  std::fflush(stdout);
  return summary.stopped ? 1 : 0;
}

pid_t start(const Arguments& arguments, const char* name) {
  const pid_t process = fork();
  if (process == 0) std::_Exit(run_to_the_end(arguments, name));
  return process;
}

// Its exit code, or -1 if it was killed.
int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Kills at random moments, that many times in the time an undisturbed run takes; returns their number, or
// none if the run failed.
int run_with_kills(const Arguments& arguments, double seconds) {
  std::mt19937 random(7);
  int kills = 0;
  for (;;) {
    const pid_t process = start(arguments, "killed");
    if (kills < arguments.kills) {
      usleep(static_cast<useconds_t>(1e6 * seconds / arguments.kills * (0.5 + 1e-3 * (random() % 1000))));
      kill(process, SIGKILL);
    }
    const int code = wait_for(process);
    if (code == 0) return kills;
    if (code > 0) return none;
    ++kills;
  }
}

int endure(const Arguments& arguments) {
  const auto begin = std::time(nullptr);
  if (wait_for(start(arguments, "whole")) != 0) return 1;
  const auto seconds = static_cast<double>(std::time(nullptr) - begin);
  const int kills = run_with_kills(arguments, seconds);
  const bool is_same =
      test::results_in(arguments.folder / "whole") == test::results_in(arguments.folder / "killed");
  fmt::print("{} s; killed {} times: {}\n", seconds, kills, is_same ? "the same files" : "OTHER FILES");
  return is_same && kills != none ? 0 : 1;
}

}  // namespace
}  // namespace kinemesh

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  return kinemesh::endure({argv[1], argv[2], argv[3], std::atoi(argv[4]), argv[5]});
}
