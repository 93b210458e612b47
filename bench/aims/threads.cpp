// Two threads against one, on the same steps and to the same bits.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "aims.h"
#include "core/build.h"
#include "core/shapes.h"
#include "motion/motion.h"
#include "motion/noise.h"
#include "sim/stepper.h"
#include "sim/threads.h"

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

void report_ratio(const std::string& what, double aim, const std::vector<double>& one,
                  const std::vector<double>& two) {
  report({"2 threads against 1, jitter 0.2, same bits: " + what, Aim::Kind::AtLeast, aim,
          median(one) / median(two),
          fmt::format("1 thread {:.4g} ms; 2 threads {:.4g} ms", median(one), median(two))});
}

}  // namespace

void two_threads(int n) {
  const Mesh mesh = build_mesh(make_square(n));
  const Motion motion(mesh, {{std::make_shared<Jitter>(0.2, 1), {}}});
  Runner one{1, Stepper(mesh), {}, {}}, two{2, Stepper(mesh), {}, {}};
  for (int i = 0; i < steps; ++i) {
    one.step(motion);
    two.step(motion);
    if (!same_bits(one.stepper.mesh(), two.stepper.mesh()))
      throw std::logic_error("other bits with two threads");
  }
  require_valid(two.stepper.mesh());
  report_ratio("move + detect", 1.8, one.move_and_detect, two.move_and_detect);
  report_ratio("whole step", 1.6, one.whole, two.whole);
}

}  // namespace kinemesh::aims
