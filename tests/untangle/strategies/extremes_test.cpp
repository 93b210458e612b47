// Coordinates at the ends of what doubles hold.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mesh/sample_meshes.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

void expect_repaired(Mesh mesh, const std::string& about) {
  const Mesh before = mesh;
  const auto outcome = repair(mesh, true);
  ASSERT_TRUE(outcome) << about << ": " << message(outcome.defect);
  EXPECT_EQ(contract_broken(before, mesh, outcome), "") << about;
}

TEST(Extremes, RepairsTinyAndHugeMeshes) {
  for (const double scale : {1e-305, 1e-150, 1e-20, 1e20, 1e150, 1e300}) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      Mesh mesh = random_tangle(seed).mesh;
      for (auto& p : mesh.positions()) p *= scale;
      expect_repaired(mesh, std::to_string(scale) + " " + std::to_string(seed));
    }
  }
}

// Denormals: a lattice in units of the smallest number there is.
TEST(Extremes, RepairsDenormalLattices) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    auto data = mapped(random_grid(4, 4, random), {0x1p-1074, 0x1p-1074}, {0, 0});
    Mesh mesh = build_mesh(data);
    const int a = 6 + random.below(3), b = 16 + random.below(3);
    const Point p = position_of(mesh, a);
    place(mesh, a, position_of(mesh, b));
    place(mesh, b, p);
    expect_repaired(mesh, std::to_string(seed));
  }
}

// Squeezed by a thousand million and turned: every face a sliver, every sign near rounding.
TEST(Extremes, RepairsThinMeshes) {
  for (const double thickness : {1e-3, 1e-6, 1e-9}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Random random(seed);
      auto data = random_square(40, random);
      const auto squeeze = [&](const Point& p) {
        return Point(0.8 * p.x - 0.6 * thickness * p.y, 0.6 * p.x + 0.8 * thickness * p.y);
      };
      for (auto& p : data.points) p = squeeze(p);
      Mesh mesh = build_mesh(data);
      for (int user = 4; user < 40; ++user) {
        if (random.one_in(3))
          place(mesh, user, squeeze({random.between(0.1, 0.9), random.between(0.1, 0.9)}));
      }
      expect_repaired(mesh, std::to_string(thickness) + " " + std::to_string(seed));
    }
  }
}

TEST(Extremes, RepairsAMeshFarFromTheOrigin) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Mesh mesh = lattice_tangle(seed).mesh;
    const auto near = [&] {
      Mesh copy = mesh;
      return static_cast<bool>(repair(copy, true));
    }();
    if (!near || !mesh.frame().empty()) continue;
    for (auto& p : mesh.positions()) p += Point(0x1p50, -0x1p51);  // exact on a lattice
    expect_repaired(mesh, std::to_string(seed));
  }
}

// Many hull vertices on straight lines, which may slide along them.
TEST(Extremes, RepairsACollinearHullThatSlides) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    Mesh mesh = build_mesh(random_grid(8, 3, random));
    const double aside = random.between(-0.99, 0.99);
    for (int user = 1; user < 8; ++user) place(mesh, user, position_of(mesh, user) + Point(aside, 0));
    jump_on_lattice(mesh, random);
    Mesh copy = mesh;
    const auto outcome = repair(copy);
    if (!outcome) {
      EXPECT_EQ(outcome.defect->kind, DefectKind::CoincidentVertices);
      continue;
    }
    expect_repaired(mesh, std::to_string(seed));
  }
}

TEST(Extremes, RepairsInsideASingleFace) {
  MeshData data;
  data.points = {{0, 0}, {4, 0}, {0, 4}, {1, 1}};
  data.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (int x = 1; x < 40; ++x) {
    for (int y = 1; x + y < 40; ++y) {
      Mesh mesh = build_mesh(data);
      place(mesh, 3, {0.1 * x, 0.1 * y});
      expect_repaired(mesh, "inside");
    }
  }
}

}  // namespace
}  // namespace kinemesh::test
