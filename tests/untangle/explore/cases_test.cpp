// Named meshes: hard cases with their regions, and the umbilics of Lemma 2.6.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/shapes.h"
#include "tests/untangle/explore/compare.h"
#include "tests/untangle/explore/local_oracle.h"
#include "untangle/explore/local_exploration.h"

namespace kinemesh::test {
namespace {

using nlohmann::json;
using std::filesystem::path;

class HardCase : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const path folder = path(KINEMESH_SHARED_DIR) / "cases";
    if (!exists(folder)) GTEST_SKIP() << "no folder " << folder;
    tangle_ = read_mesh(folder / (GetParam() + ".off")).mesh;
    expected_ = json::parse(std::ifstream(folder / (GetParam() + ".json")));
  }

  MeshData tangle_;
  json expected_;
};

INSTANTIATE_TEST_SUITE_P(All, HardCase,
                         ::testing::Values("extend", "grow", "overlap", "overstep", "separate", "umbilic"),
                         [](const auto& instance) { return instance.param; });

TEST_P(HardCase, HasTheRegionsOnRecord) {
  const Mesh mesh = build_mesh(tangle_);
  std::map<UserFace, Face> face_of_user;
  for (const Face face : mesh.faces()) face_of_user[mesh.user_face(face)] = face;
  ASSERT_FALSE(expected_["regions"].empty());
  for (const json& region : expected_["regions"]) {
    SCOPED_TRACE(region["seed"]);
    LocalExploration exploration(mesh);
    EXPECT_TRUE(exploration.run(face_of_user.at(UserFace(region["seed"].get<int>()))));
    std::vector<int> faces;
    for (const Face face : exploration.faces()) faces.push_back(mesh.user_face(face));
    std::ranges::sort(faces);
    EXPECT_EQ(faces, region["triangles"].get<std::vector<int>>());
    EXPECT_EQ(exploration.components(), region["components"]);
    EXPECT_EQ(exploration.inverted(), region["inverted"]);
    EXPECT_EQ(exploration.gamma_first_stable(), region["gamma_first_stable"]);
    EXPECT_EQ(exploration.gamma(), region["gamma"][0]);
    EXPECT_EQ(exploration.explored(), region["size"]);
    EXPECT_EQ(exploration.grown() > 0, region["grown"] > 0);
  }
}

TEST_P(HardCase, OverlapsItselfWhereRecorded) {
  const Mesh mesh = build_mesh(tangle_);
  const Sheets sheets(mesh, subdivide(mesh));
  const LocalOracle oracle(sheets);
  for (const json& region : expected_["regions"]) {
    const auto recorded = region["triangles"].get<std::set<int>>();
    std::vector<Face> faces;
    for (const Face face : mesh.faces()) {
      if (recorded.contains(mesh.user_face(face))) faces.push_back(face);
    }
    EXPECT_EQ(oracle.overlaps_itself(faces), region["self_overlap"]) << "seed " << region["seed"];
  }
}

TEST_P(HardCase, EqualsBruteForce) {
  Counts counts;
  compare(tangle_, GetParam(), counts, {.subsets = 6, .lifts = 10000, .every_seed = tangle_.n_faces() < 200});
  EXPECT_EQ(counts.degenerate, 0);
  EXPECT_GT(counts.regions, 0);
}

class Umbilic : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(All, Umbilic, ::testing::Values(2, 3, 4), ::testing::PrintToStringParamName());

// Lemma 2.6, with the sheet of the plane glued on. KINEMESH_UMBILICS in the environment says how many jitters
// of each; one otherwise.
TEST_P(Umbilic, CoversItsShadowKPlusOneTimesAndEqualsBruteForce) {
  const int k = GetParam();
  const char* all = std::getenv("KINEMESH_UMBILICS");
  for (int jitter = 1; jitter <= (all ? std::atoi(all) : 1); ++jitter) {
    const MeshData tangle = make_umbilic(k, 189 * k + 1, jitter);
    const Mesh mesh = build_mesh(tangle);
    const Sheets sheets(mesh, subdivide(mesh));
    const LocalOracle oracle(sheets);
    int most = 0;
    for (int c = 0; c < sheets.n_components(); ++c)
      most = std::max(most, oracle.region(c).gamma_first_stable);
    EXPECT_EQ(most, k + 1);
    Counts counts;
    compare(tangle, "umbilic" + std::to_string(k) + "_" + std::to_string(jitter), counts,
            {.subsets = 4, .lifts = 1 << 20, .every_seed = false});
    EXPECT_EQ(counts.degenerate, 0);
    EXPECT_GT(counts.gamma_2, 0);
    EXPECT_GT(counts.minima, 0);
  }
}

}  // namespace
}  // namespace kinemesh::test
