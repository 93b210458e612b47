// With `retain`, fewer faces are replaced in the same regions.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinemesh/local.h"
#include "kinemesh/predicates.h"
#include "kinemesh/validate.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

RepairOutcome repair_retaining(Mesh& mesh, const std::string& strategy) {
  return make_strategy(strategy)->repair(mesh, RepairOptions{.allow_escaped = true, .retain = true});
}

// Kept faces are of the region, upright, as they were, and those that are not were replaced.
void expect_kept(const Mesh& before, const Mesh& after, const RegionRecord& region) {
  EXPECT_TRUE(std::is_sorted(region.kept.begin(), region.kept.end()));
  EXPECT_TRUE(
      std::includes(region.faces.begin(), region.faces.end(), region.kept.begin(), region.kept.end()));
  for (const Face face : region.kept) {
    const auto [a, b, c] = before.corners(face);
    EXPECT_EQ(orientation(a, b, c), Orientation::CounterClockwise);
    EXPECT_EQ(before.triangles()[face], after.triangles()[face]);
    EXPECT_EQ(before.label(face), after.label(face));
  }
}

int kept(const RepairRecord& record) {
  int sum = 0;
  for (const auto& region : record.regions) sum += static_cast<int>(region.kept.size());
  return sum;
}

TEST(Retention, FindsTheSameRegionsAndReplacesLess) {
  int saved = 0, replaced = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const auto tangle = random_tangle(seed);
    SCOPED_TRACE(tangle.about + " " + std::to_string(seed));
    Mesh whole = tangle.mesh, less = tangle.mesh;
    const auto plain = repair(whole, true), retaining = repair_retaining(less, "global");
    ASSERT_EQ(message(plain.defect), message(retaining.defect));
    if (!plain) continue;
    ASSERT_EQ(message(validate(less)), "");
    ASSERT_EQ(plain.record.regions.size(), retaining.record.regions.size());
    for (std::size_t i = 0; i < plain.record.regions.size(); ++i) {
      EXPECT_EQ(plain.record.regions[i].faces, retaining.record.regions[i].faces);
      EXPECT_EQ(plain.record.regions[i].border_edges, retaining.record.regions[i].border_edges);
      expect_kept(tangle.mesh, less, retaining.record.regions[i]);
    }
    EXPECT_EQ(retaining.record.replaced + kept(retaining.record), plain.record.replaced);
    EXPECT_EQ(plain.record.escaped, retaining.record.escaped);
    saved += kept(retaining.record);
    replaced += retaining.record.replaced;
  }
  EXPECT_GT(saved, replaced / 10);
}

TEST(Retention, KeepsFacesOfMinimumRegionsWhileOtherTanglesRemain) {
  int saved = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto tangle = random_tangle(seed);
    SCOPED_TRACE(tangle.about + " " + std::to_string(seed));
    Mesh mesh = tangle.mesh;
    LocalUntangling local;
    for (auto tangles = detect(mesh); !tangles.inverted.empty(); tangles = detect(mesh)) {
      const Mesh before = mesh;
      const std::array<Face, 1> seeds{tangles.inverted.front()};
      const auto outcome = local.repair_seeds(mesh, seeds, {.allow_escaped = true, .retain = true});
      if (!outcome) break;
      ASSERT_EQ(message(validate_connectivity(mesh)), "");
      const auto& region = outcome.record.regions.front();
      expect_kept(before, mesh, region);
      EXPECT_EQ(outcome.record.replaced + kept(outcome.record), static_cast<int>(region.faces.size()));
      EXPECT_EQ(detect(mesh).inverted.size(), tangles.inverted.size() - region.inverted);
      saved += kept(outcome.record);
    }
  }
  EXPECT_GT(saved, 300);
}

TEST(Retention, RepairsDegeneratePositionsToo) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const auto tangle = lattice_tangle(seed);
    SCOPED_TRACE(tangle.about + " " + std::to_string(seed));
    Mesh whole = tangle.mesh, less = tangle.mesh;
    const auto plain = repair(whole, true), retaining = repair_retaining(less, "global");
    ASSERT_EQ(message(plain.defect), message(retaining.defect));
    if (!plain) continue;
    ASSERT_EQ(message(validate(less)), "");
  }
}

// A vertex that goes through the opposite edge into the face behind: what has to be replaced are the face it
// turned over and the one it came to lie in, a flip of the edge between them.
TEST(Retention, MakesAFlipOfAVertexThatGoesThroughAnEdge) {
  Random random(3);
  Mesh mesh = build_mesh(random_grid(6, 6, random));
  const auto [face, k] = [&] {
    for (const Face f : mesh.faces()) {
      for (int i = 0; i < 3; ++i) {
        const Face across = mesh.face_across(Mesh::sides(f)[i]);
        const Vertex v = mesh.triangles()[f][(i + 2) % 3];
        if (across != none && !mesh.is_constrained(v)) return std::pair(f, i);
      }
    }
    return std::pair(Face(), 0);
  }();
  const Side side = Mesh::side(face, k);
  const Face across = mesh.face_across(side);
  const auto [a, b, c] = mesh.corners(across);
  const Point middle = 0.5 * (mesh.position(mesh.from(side)) + mesh.position(mesh.to(side)));
  mesh.positions()[mesh.triangles()[face][(k + 2) % 3]] = middle + 0.125 * ((a + b + c) / 3.0 - middle);
  const auto outcome = repair_retaining(mesh, "global");
  ASSERT_TRUE(outcome);
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_EQ(outcome.record.replaced, 2);
  EXPECT_GT(outcome.record.region_faces(), 2);
}

}  // namespace
}  // namespace kinemesh::test
