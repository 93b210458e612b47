// Two threads against one, on the same steps and to the same bits.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "aims.h"
#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "motion/fields/noise.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

constexpr int steps = 7;

struct Runner {
  int threads;
  Stepper stepper;
  std::vector<double> move_and_detect, whole;

  void step(const Motion& motion) {
    const ThreadLimit limit(threads);
    const StepOutcome outcome = stepper.step(motion, 1.0);
    if (outcome.defect) throw std::runtime_error(outcome.defect->message());
    move_and_detect.push_back(outcome.record.move_ms + outcome.record.repair.detect_ms);
    whole.push_back(outcome.record.total_ms);
  }
};

bool same_bits(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.positions(), b.positions()) && std::ranges::equal(a.triangles(), b.triangles());
}

// Adding up 128 MB: what the machine's memory has for one thread and for two.
class Reading {
 public:
  void read() {
    one_.push_back(milliseconds(1));
    two_.push_back(milliseconds(2));
  }
  double gain() const { return median(one_) / median(two_); }

 private:
  double milliseconds(int threads) {
    const ThreadLimit limit(threads);
    std::array<std::uint64_t, most_parts> sums{};
    const Stopwatch stopwatch;
    parallel_parts(static_cast<int>(words_.size()), 1 << 16, [&](int part, int begin, int end) {
      sums[part] = std::accumulate(words_.begin() + begin, words_.begin() + end, std::uint64_t{0});
    });
    const double time = stopwatch.milliseconds();
    if (std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}) != words_.size())
      throw std::logic_error("not all has been read");
    return time;
  }

  std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(1 << 24, 1);
  std::vector<double> one_, two_;
};

void report_ratio(const std::string& what, double aim, const std::vector<double>& one,
                  const std::vector<double>& two, const Reading& reading) {
  report(
      {"2 threads against 1, jitter 0.2, same bits: " + what, Aim::Kind::AtLeast, aim,
       median(one) / median(two),
       fmt::format(
           "1 thread {:.4g} ms; 2 threads {:.4g} ms; reading memory, by turns with the steps: {:.3g} times "
           "as fast with 2",
           median(one), median(two), reading.gain())});
}

}  // namespace

void two_threads(int n) {
  const Mesh mesh = build_mesh(make_square(n));
  const Motion motion(mesh, {{std::make_shared<Jitter>(0.2, 1), {}}});
  Runner one{1, Stepper(mesh), {}, {}}, two{2, Stepper(mesh), {}, {}};
  Reading reading;
  for (int i = 0; i < steps; ++i) {
    reading.read();
    one.step(motion);
    two.step(motion);
    if (!same_bits(one.stepper.mesh(), two.stepper.mesh()))
      throw std::logic_error("other bits with two threads");
  }
  require_valid(two.stepper.mesh());
  report_ratio("move + detect", 1.8, one.move_and_detect, two.move_and_detect, reading);
  report_ratio("whole step", 1.6, one.whole, two.whole, reading);
}

}  // namespace kinemesh::aims
