// A step in which memory runs out, at each allocation in turn, is undone.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <new>

#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/sim/helpers.h"
#include "tests/untangle/quality/delaunay.h"

namespace {

thread_local bool is_limited = false;
thread_local long allocations_left = 0;  // if limited

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  if (is_limited && allocations_left-- <= 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (is_limited && allocations_left-- <= 0) return nullptr;
  return std::malloc(size > 0 ? size : 1);
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace kinemesh {
namespace {

using test::snapshot;

Stepper stepper_with(const StepperOptions& options) {
  Stepper stepper(build_mesh(test::grid_with_hole(10, 4, 6), {.frame = 0.25, .fixed = {}}), options);
  stepper.observe([](const StepChanges&) {});  // to be told takes memory, too
  return stepper;
}

// Tangled here and there.
std::vector<Point> shaken(const Mesh& mesh) {
  test::Random random(3);
  auto next = mesh.user_positions();
  for (const UserVertex v : Numbers<UserVertex>(mesh.n_user_vertices()))
    if (!mesh.is_constrained(mesh.vertex_of_user(v)))
      next[v] += Point(random.between(-0.06, 0.06), random.between(-0.06, 0.06));
  return next;
}

// False where memory ran out.
bool step_with(Stepper& stepper, const std::vector<Point>& next, long allocations) {
  allocations_left = allocations;
  is_limited = true;
  try {
    const auto outcome = stepper.step(next, 0.5);
    is_limited = false;
    EXPECT_TRUE(outcome) << outcome.defect->message();
    return true;
  } catch (const std::bad_alloc&) {
    is_limited = false;
    return false;
  }
}

// Short of memory `angles` ends early and the step is taken, with angles that are no better.
void expect_early_end(const Mesh& mesh, const Mesh& undisturbed) {
  EXPECT_LE(measure(mesh).min_angle_deg, measure(undisturbed).min_angle_deg);
  EXPECT_EQ(mesh.n_user_faces(), undisturbed.n_user_faces());
}

class OutOfMemory : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(OutOfMemory, UndoesTheStepWhereverItHappens) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto& [strategy, quality] = GetParam();
  Stepper stepper = stepper_with({.strategy = strategy, .quality = quality});
  Stepper undisturbed = stepper_with({.strategy = strategy, .quality = quality});
  const auto before = snapshot(stepper.mesh());
  const auto next = shaken(stepper.mesh());
  // First, since TBB waits for ever where memory runs out while it starts itself.
  const auto outcome = undisturbed.step(next, 0.5);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome.record.repair.regions.empty());

  int failures = 0;
  while (!step_with(stepper, next, failures)) {
    ++failures;
    ASSERT_EQ(snapshot(stepper.mesh()), before) << failures;
    ASSERT_EQ(stepper.time(), 0.0);
    ASSERT_EQ(stepper.steps_done(), 0);
  }
  EXPECT_GT(failures, 20);
  RecordProperty("failures", failures);
  EXPECT_FALSE(validate(stepper.mesh()));
  if (quality == std::string("angles")) return expect_early_end(stepper.mesh(), undisturbed.mesh());
  EXPECT_EQ(snapshot(stepper.mesh()), snapshot(undisturbed.mesh()));
  if (quality == std::string("delaunay")) {
    EXPECT_EQ(test::not_delaunay(stepper.mesh()), "");
    EXPECT_EQ(outcome.record.repair.quality_flips > 20, strategy != std::string("remesh"));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, OutOfMemory,
                         testing::Combine(testing::Values("global", "local", "remesh", "kinetic", "auto"),
                                          testing::Values("none", "delaunay", "smooth", "angles")),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param)) + "_" + std::get<1>(param.param);
                         });

}  // namespace
}  // namespace kinemesh
