// What exploring reads, and how its time grows with the region.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "aims.h"
#include "kinemesh/build.h"
#include "kinemesh/local.h"
#include "kinemesh/shapes.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

struct Reads {
  double worst = 1.0;  // explored / faces
  std::int64_t regions = 0, faces = 0;

  void add(const RepairRecord& record) {
    for (const auto& region : record.regions) {
      const double share = static_cast<double>(region.explored) / static_cast<double>(region.faces.size());
      if (std::abs(share - 1.0) >= std::abs(worst - 1.0)) worst = share;
      ++regions;
      faces += static_cast<std::int64_t>(region.faces.size());
    }
  }
};

void repair_and_count(const Move& move, const std::string& strategy, Reads& reads) {
  Mesh mesh = moved(move);
  const auto outcome = make_strategy(strategy)->repair(mesh, {});
  require_valid(outcome);
  require_valid(mesh);
  reads.add(outcome.record);
}

// A bump pushes what is around the middle over what lies ahead of it: the same fold, three sheets deep,
// whatever the number of vertices.
Point pushed(const Point& p) {
  const double radius = 0.3, way = 0.35;
  const double r = glm::distance(p, Point(0.45, 0.5)) / radius;
  return r < 1.0 ? p + Point(way * (1.0 - r * r) * (1.0 - r * r), 0.0) : p;
}

Mesh folded(int vertices) {
  Mesh mesh = build_mesh(make_square(vertices));
  for (Point& p : mesh.positions()) p = pushed(p);
  return mesh;
}

RepairRecord repair_locally(const Mesh& tangled) {
  Mesh mesh = tangled;
  auto outcome = LocalUntangling().repair(mesh, {});
  require_valid(outcome);
  require_valid(mesh);
  return std::move(outcome.record);
}

struct Growth {
  int faces = 0;    // of the regions
  double us = 0.0;  // per face
};

Growth growth_at(int vertices) {
  const Mesh tangled = folded(vertices);
  const int repeats = std::clamp(200'000 / vertices, 5, 501);
  std::vector<double> times;
  RepairRecord record;
  for (int i = 0; i < repeats; ++i) {
    record = repair_locally(tangled);
    times.push_back(record.explore_ms + record.triangulate_ms + record.splice_ms);
  }
  return {record.region_faces(), 1e3 * median(times) / record.region_faces()};
}

}  // namespace

void explored(int n) {
  Reads reads;
  repair_and_count(jitter_of(n, 0.2), "global", reads);
  repair_and_count(rotor_of(n), "global", reads);
  repair_and_count(jitter_of(n / 10, 0.2), "local", reads);
  report({"faces explored / faces of R*, the region farthest from 1", Aim::Kind::Exactly, 1.0, reads.worst,
          fmt::format("{} regions with {} faces", reads.regions, reads.faces)});
}

void local_growth(int n) {
  const ThreadLimit one(1);
  std::vector<Growth> all;
  std::string detail;
  for (double vertices = n; vertices >= 80.0; vertices /= std::sqrt(10.0)) {
    const Growth growth = all.emplace_back(growth_at(static_cast<int>(vertices)));
    detail += fmt::format("{}: {:.3g} us; ", growth.faces, growth.us);
  }
  const auto over_log = [](const Growth& g) { return g.us / std::log(g.faces); };
  double worst = 0.0;
  for (const auto& growth : all) worst = std::max(worst, over_log(growth) / over_log(all.back()));
  report({"local, time per face of R* over its logarithm, worst / smallest region", Aim::Kind::AtMost, 1.0,
          worst, "faces of R* and time per face: " + detail});
}

}  // namespace kinemesh::aims
