// Resident memory, of a step and of the largest mesh.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "motion/fields/noise.h"
#include "motion/fields/rigid.h"

namespace kinemesh::aims {
namespace {

constexpr int steps = 3;
constexpr double gib = 1024.0 * 1024.0 * 1024.0;

// The most that was resident since the process began, or since forget_peak.
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  throw std::runtime_error("/proc/self/status does not tell VmHWM");
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  if (!(file << '5' << std::flush)) throw std::runtime_error("/proc/self/clear_refs cannot be written");
}

std::shared_ptr<Rotor> rotor() {
  return std::make_shared<Rotor>(Point(0.5, 0.5), 0.3, std::numbers::pi / 180.0);
}

void do_steps(Stepper& stepper, const Motion& motion) {
  for (int i = 0; i < steps; ++i) {
    const auto outcome = stepper.step(motion, 1.0);
    if (outcome.defect) throw std::runtime_error(outcome.defect->message());
  }
}

// Of everything the process holds: mesh, motion, stepper, program.
double peak_of_steps(int n, const AnyField& field) {
  Stepper stepper(build_mesh(make_square(n)));
  const Motion motion(stepper.mesh(), {{field, {}}});
  forget_peak();
  do_steps(stepper, motion);
  const double peak = peak_bytes();
  require_valid(stepper.mesh());
  return peak;
}

void report_steps(const std::string& what, int n, const AnyField& field) {
  const double peak = peak_of_steps(n, field);
  report({"bytes resident per vertex, peak of a step: " + what, Aim::Kind::AtMost, 200.0, peak / n,
          fmt::format("{:.4g} MiB in all: mesh, motion, stepper, program", peak / 1024.0 / 1024.0)});
}

// A square of (m + 1)^2 vertices whose inner ones stand a little beside their places, so that little is
// collinear.
MeshData uneven_grid(int m) {
  MeshData data = make_grid(m, m);
  const Jitter jitter(0.15, 1);
  for (int j = 1; j < m; ++j) {
    for (int i = 1; i < m; ++i) {
      const std::size_t v = static_cast<std::size_t>(j) * (m + 1) + i;
      data.points[v] += jitter.kick(v, 0, 1.0, 1.0 / m);
    }
  }
  return data;
}

// Without what it is made of.
Mesh mesh_of_grid(int m) {
  return build_mesh(uneven_grid(m));
}

// Whatever asks for more fails with std::bad_alloc.
void limit_memory(double bytes) {
  const rlimit limit{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  if (setrlimit(RLIMIT_AS, &limit) != 0) throw std::runtime_error("memory cannot be limited");
}

}  // namespace

void memory(int n) {
  report_steps("rotor", n, rotor());
  report_steps("jitter 0.2", n, std::make_shared<Jitter>(0.2, 1));
}

void huge(int n) {
  limit_memory(16.0 * gib);
  const int m = static_cast<int>(std::lround(std::sqrt(n))) - 1;
  const Stopwatch building;
  Stepper stepper(mesh_of_grid(m));
  const double build_s = 1e-3 * building.milliseconds();
  const Motion motion(stepper.mesh(), {{rotor(), {}}});
  const Stopwatch stepping;
  do_steps(stepper, motion);
  const double steps_s = 1e-3 * stepping.milliseconds();
  const Stopwatch checking;
  require_valid(stepper.mesh());
  const double check_s = 1e-3 * checking.milliseconds();
  report({fmt::format("{:g} vertices: build, 3 rotor steps, check, in GiB", static_cast<double>(n)),
          Aim::Kind::AtMost, 16.0, peak_bytes() / gib,
          fmt::format("{} faces; build {:.3g} s; steps {:.3g} s; check {:.3g} s; the address space was "
                      "limited to 16 GiB",
                      stepper.mesh().n_user_faces(), build_s, steps_s, check_s)});
}

}  // namespace kinemesh::aims
