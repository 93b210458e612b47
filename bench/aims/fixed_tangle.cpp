// The same tangle in larger and larger meshes: what a repair costs beside its detection.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "kinemesh/build.h"
#include "kinemesh/shapes.h"
#include "motion/fields/noise.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

constexpr int block = 64;  // vertices either way that are moved, in the middle
constexpr int repeats = 7;

// A vertex of the block goes the same way in spacings, whatever the size of the grid.
Move tangle_in_grid(int vertices) {
  const int cells = static_cast<int>(std::lround(std::sqrt(vertices))) - 1, first = (cells - block) / 2;
  Mesh mesh = build_mesh(make_grid(cells, cells));
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  const Jitter jitter(0.5, 1);
  for (int j = 0; j < block; ++j) {
    for (int i = 0; i < block; ++i) {
      const UserVertex user((first + j) * (cells + 1) + first + i);
      const auto key = static_cast<std::uint64_t>(j * block + i);
      positions[mesh.vertex_of_user(user)] += jitter.kick(key, 0, 1.0, 1.0 / cells);
    }
  }
  return {std::move(mesh), std::move(positions)};
}

struct Cost {
  double ms;
  int faces;  // of the regions
};

Cost repair_cost(int vertices) {
  const Move move = tangle_in_grid(vertices);
  const auto global = make_strategy("global");
  std::vector<double> times;
  int faces = 0;
  for (int i = 0; i < repeats; ++i) {
    Mesh mesh = moved(move);
    const Stopwatch repairing;
    const auto outcome = global->repair(mesh, {});
    times.push_back(repairing.milliseconds() - outcome.record.detect_ms);
    require_valid(outcome);
    if (i == 0) require_valid(mesh);
    faces = outcome.record.region_faces();
  }
  return {median(times), faces};
}

}  // namespace

void fixed_tangle(int n) {
  const ThreadLimit one(1);
  std::vector<double> times;
  std::string detail;
  int faces = 0;
  for (int vertices = std::min(n, 10'000); vertices <= n; vertices *= 10) {
    const Cost cost = repair_cost(vertices);
    if (faces != 0 && std::abs(cost.faces - faces) > faces / 100) throw std::logic_error("another tangle");
    faces = cost.faces;
    times.push_back(cost.ms);
    detail += fmt::format("{:g} vertices {:.4g} ms; ", static_cast<double>(vertices), cost.ms);
    if (vertices > n / 10) break;
  }
  const auto [smallest, largest] = std::minmax_element(times.begin(), times.end());
  report({"one tangle in larger and larger meshes: longest / shortest repair", Aim::Kind::AtMost, 1.5,
          *largest / *smallest, detail + fmt::format("{} faces replaced", faces)});
}

}  // namespace kinemesh::aims
