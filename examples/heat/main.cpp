// Heat in a square with a turning body. Checks that a constant stays constant and that a manufactured
// solution converges with second order while regions of the mesh are replaced; then heats one side of the
// body. Exit 1 where a check fails.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <numbers>

#include "examples/heat/heat_equation.h"

namespace {

using namespace heat;
using std::numbers::pi;

constexpr TurningBody shape{.rate = 2 * pi};
constexpr double end = 2.0;  // two turns

// The body's outline slips by four edges a step.
int steps_for(double h) {
  return static_cast<int>(std::lround(end * shape.rate * shape.radius / (4 * h)));
}

std::unique_ptr<HeatEquation> run(const Problem& problem, double h) {
  auto equation = std::make_unique<HeatEquation>(problem, h);
  const int steps = steps_for(h);
  for (int n = 0; n < steps; ++n) equation->step(end / steps);
  return equation;
}

// Rows that were summed when faces were replaced are what summing all rows of the mesh gives.
double distance_from_new_matrices(const HeatEquation& equation) {
  const P1Matrices fresh(equation.stepper().mesh().domain());
  double largest = 0.0;
  for (int v = 0; v < fresh.n_vertices(); ++v) {
    const auto kept = equation.matrices().row(v), made = fresh.row(v);
    if (kept.size() != made.size()) return HUGE_VAL;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i].column != made[i].column) return HUGE_VAL;
      largest = std::max(largest, std::abs(kept[i].stiffness - made[i].stiffness));
    }
  }
  return largest;
}

bool constant_stays_constant() {
  const auto one = [](const Point&, double) { return 1.0; };
  const auto nothing = [](const Point&, double, int) { return 0.0; };
  const auto solved = run({shape, one, nothing}, 1.0 / 16);
  const HeatEquation& equation = *solved;
  double off = 0.0;
  for (const double u : equation.u()) off = std::max(off, std::abs(u - 1));
  const double rows =
      static_cast<double>(equation.matrices().rows_summed()) / equation.matrices().n_vertices();
  std::printf("constant: off by %.1e after %d steps, %ld regions and %ld faces replaced\n", off,
              equation.stepper().steps_done(), equation.regions(), equation.faces_replaced());
  const double distance = distance_from_new_matrices(equation);
  std::printf("matrix: each row summed %.1f times in %d steps; off by %.1e from one summed at the end\n",
              rows, equation.stepper().steps_done(), distance);
  const bool is_in_place = equation.stepper().mesh().user_positions() == equation.x();
  if (!is_in_place) std::printf("a repair has moved or renumbered a vertex\n");
  return is_in_place && off < 1e-12 && equation.regions() > 5 && distance < 1e-10;
}

// u = (1 + e^-t) sin(2 pi x) cos(pi y), and the source that makes it one.
double manufactured(const Point& x, double t) {
  return (1 + std::exp(-t)) * std::sin(2 * pi * x.x) * std::cos(pi * x.y);
}

double manufactured_source(const Point& x, double t, int label) {
  const double s = std::sin(2 * pi * x.x), c = std::cos(2 * pi * x.x);
  const double sy = std::sin(pi * x.y), cy = std::cos(pi * x.y), a = 1 + std::exp(-t);
  const Point v = shape.velocity(x, label);
  return -std::exp(-t) * s * cy + a * (v.x * 2 * pi * c * cy - v.y * pi * s * sy) + 5 * pi * pi * a * s * cy;
}

bool manufactured_solution_converges() {
  std::printf("%8s %9s %6s %8s %9s %11s %6s\n", "h", "vertices", "steps", "regions", "replaced", "L2 error",
              "order");
  double before = 0.0, order = 0.0;
  long regions = 0;
  for (const int n : {8, 16, 32, 64}) {
    const auto solved = run({shape, manufactured, manufactured_source}, 1.0 / n);
    const HeatEquation& equation = *solved;
    const double error = equation.error();
    order = before > 0 ? std::log2(before / error) : 0.0;
    regions = equation.regions();
    std::printf("%8.5f %9zu %6d %8ld %9ld %11.3e", 1.0 / n, equation.x().size(),
                equation.stepper().steps_done(), regions, equation.faces_replaced(), error);
    std::printf(before > 0 ? " %6.2f\n" : "\n", order);
    before = error;
  }
  return order > 1.8 && order < 2.3 && regions > 200;
}

// One side of the body is heated, the walls are kept at 0.
double hottest(double rate) {
  TurningBody turning = shape;
  turning.rate = rate;
  const auto zero = [](const Point&, double) { return 0.0; };
  const auto heating = [&](const Point& x, double t, int label) {
    return label == body && turning.turned(x, -t).x > turning.centre.x ? 100.0 : 0.0;
  };
  HeatEquation equation({turning, zero, heating}, 1.0 / 32);
  for (int n = 0; n < 80; ++n) equation.step(0.0025);
  return *std::ranges::max_element(equation.u());
}

bool turning_spreads_the_heat() {
  const double still = hottest(0.0), turned = hottest(40 * pi);
  std::printf("heated on one side: at most %.3f in the body at rest, %.3f in the turning one\n", still,
              turned);
  return turned > 0.5 * still && turned < 0.98 * still;
}

}  // namespace

int main() {
  try {
    std::printf("solved with %s\n", make_solver()->name());
    const bool constant = constant_stays_constant(), order = manufactured_solution_converges();
    const bool heated = turning_spreads_the_heat();
    return constant && order && heated ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
