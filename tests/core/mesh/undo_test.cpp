// What is done to a mesh's connectivity can be taken back, bit for bit.
#include "core/mesh/undo.h"

#include <gtest/gtest.h>

#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/random_tangles.h"
#include "untangle/fill/region_repair.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh::test {
namespace {

void flip_some(Undo& undo, Random& random) {
  const Mesh& mesh = undo.mesh();
  for (int i = 0; i < mesh.n_edges(); ++i) {
    const Side side = random_edge(mesh, random);
    if (mesh.is_flippable(side) && mesh.apex(side) != mesh.apex(mesh.opposite(side))) undo.flip(side);
  }
}

// All regions of the mesh as it is, or none if it has no valid one.
void splice_all(Undo& undo) {
  RegionRepair repair;
  GlobalWalk().run(undo.mesh(), detect(undo.mesh()), repair.regions());
  repair.start();
  const RepairOptions options{.allow_escaped = true};
  if (repair.remesh_new(undo.mesh(), options) || repair.remesh_touching(undo.mesh(), options)) return;
  for (int region = 0; region < repair.regions().count(); ++region) undo.splice(repair.patch(region).patch);
}

TEST(Undo, TakesFlipsAndSplicesBackBitForBit) {
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh mesh = random_tangle(seed).mesh;
    const auto before = snapshot_of(mesh);
    Random random(seed);
    {
      Undo undo(mesh);
      splice_all(undo);
      flip_some(undo, random);
      changed += !(snapshot_of(mesh) == before);
    }
    EXPECT_TRUE(snapshot_of(mesh) == before) << seed;
  }
  EXPECT_EQ(changed, 200);
}

TEST(Undo, LeavesWhatIsKept) {
  Mesh mesh = random_tangle(3).mesh;
  const auto before = snapshot_of(mesh);
  Random random(3);
  Undo undo(mesh);
  flip_some(undo, random);
  const auto flipped = snapshot_of(mesh);
  undo.keep();
  undo.take_back();
  EXPECT_TRUE(snapshot_of(mesh) == flipped);
  EXPECT_FALSE(flipped == before);
}

}  // namespace
}  // namespace kinemesh::test
