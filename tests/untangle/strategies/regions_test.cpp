// Global untangling against brute force.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kinemesh/mesh_io.h"
#include "kinemesh/shapes.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

TEST(GlobalUntangling, EqualsBruteForceOnRandomTangles) {
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 6000 && broken < 5; ++seed) {
    const auto wrong = check_random_tangle(seed);
    EXPECT_EQ(wrong, "");
    broken += !wrong.empty();
  }
}

// The sweep would prove little if its tangles were all alike.
TEST(RandomTangles, AreOfEveryKind) {
  int tangled = 0, light = 0, heavy = 0, several = 0, padded = 0, escaped = 0, unseeded = 0, labelled = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Mesh mesh = random_tangle(seed).mesh;
    const auto record = repair(mesh, true).record;
    const double share = static_cast<double>(record.region_faces()) / mesh.n_faces();
    tangled += share > 0;
    light += share > 0 && share < 0.2;
    heavy += share > 0.9;
    several += record.regions.size() > 1;
    padded += std::any_of(record.regions.begin(), record.regions.end(),
                          [](const RegionRecord& r) { return r.padding_faces() > 0; });
    unseeded += std::any_of(record.regions.begin(), record.regions.end(),
                            [](const RegionRecord& r) { return r.seed == none; });
    escaped += record.escaped > 0;
    labelled += !mesh.domain().labels.empty();
  }
  EXPECT_GT(tangled, 600);
  for (const int kind : {light, heavy, several, padded, unseeded, escaped, labelled}) EXPECT_GT(kind, 50);
}

// Lemma 2.6: the conflict set of one inverted component covers its shadow k + 1 times.
TEST(GlobalUntangling, EqualsBruteForceOnUmbilics) {
  for (int k = 2; k <= 5; ++k) {
    MeshData data = make_umbilic(k, 300 * k);
    for (auto& p : data.points) p = snapped(p);
    const Mesh before = build_mesh(data);
    ASSERT_FALSE(detect(before).inverted.empty());
    Mesh mesh = before;
    const auto outcome = repair(mesh);
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_EQ(regions_wrong(before, outcome.record), "") << "k = " << k;
    EXPECT_EQ(contract_broken(before, mesh, outcome), "") << "k = " << k;
    EXPECT_EQ(outcome.record.retries(), 0);
  }
}

// Stored tangles with the regions they must have.
class Case : public testing::TestWithParam<std::string> {
 protected:
  static std::filesystem::path folder() { return std::filesystem::path(KINEMESH_SHARED_DIR) / "cases"; }
  MeshData data() const { return read_mesh(folder() / (GetParam() + ".off")).mesh; }
  static nlohmann::json parse(const std::filesystem::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
  }
  nlohmann::json expected() const { return parse(folder() / (GetParam() + ".json"))["global"]; }
  void SetUp() override {
    if (!std::filesystem::exists(folder() / (GetParam() + ".off")))
      GTEST_SKIP() << folder() << " is not here";
  }

  void expect_regions(const MeshData& tangled) const {
    const Mesh before = build_mesh(tangled);
    Mesh mesh = before;
    const auto outcome = repair(mesh);
    ASSERT_TRUE(outcome) << message(outcome.defect);
    std::vector<int> faces;
    for (const auto& region : outcome.record.regions)
      faces.insert(faces.end(), region.user_faces.begin(), region.user_faces.end());
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(faces, expected()["triangles"].get<std::vector<int>>());
    EXPECT_EQ(outcome.record.components, expected()["components"].get<int>());
    EXPECT_EQ(outcome.record.inverted, expected()["inverted"].get<int>());
    EXPECT_EQ(outcome.record.retries(), 0);
    EXPECT_EQ(contract_broken(before, mesh, outcome), "");
  }
};

TEST_P(Case, HasTheExpectedRegions) {
  expect_regions(data());
}

TEST_P(Case, HasTheExpectedRegionsMirroredTurnedAndScaled) {
  expect_regions(mirrored(data()));
  auto turned = data();
  for (auto& p : turned.points) p = {-p.y, p.x};
  expect_regions(turned);
  expect_regions(mapped(data(), {0x1p300, 0x1p300}, {0, 0}));
  expect_regions(mapped(data(), {0x1p-300, 0x1p-300}, {0, 0}));
  expect_regions(mapped(data(), {0x1p40, 0x1p-40}, {0, 0}));
}

INSTANTIATE_TEST_SUITE_P(Shared, Case,
                         testing::Values("extend", "grow", "overlap", "overstep", "separate", "umbilic"),
                         [](const auto& param_info) { return param_info.param; });

TEST(GlobalUntangling, DoesNothingToAValidMesh) {
  Random random(1);
  Mesh mesh = build_mesh(u_shape(50, random), {.frame = 0.5});
  const auto before = snapshot_of(mesh);
  const auto outcome = repair(mesh);
  EXPECT_TRUE(outcome);
  EXPECT_TRUE(outcome.record.regions.empty());
  EXPECT_EQ(outcome.record.replaced, 0);
  EXPECT_TRUE(snapshot_of(mesh) == before);
}

// The same object serves meshes of different size, and failures leave no trace in its memory.
TEST(GlobalUntangling, KeepsNothingBetweenMeshes) {
  const auto strategy = make_strategy("global");
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Mesh first = random_tangle(seed).mesh, again = first;
    const bool allow = seed % 3 != 0;
    const auto kept = strategy->repair(first, RepairOptions{.allow_escaped = allow});
    const auto fresh = repair(again, allow);
    EXPECT_EQ(static_cast<bool>(kept), static_cast<bool>(fresh));
    EXPECT_TRUE(snapshot_of(first) == snapshot_of(again)) << seed;
  }
}

TEST(GlobalUntangling, GivesTheSameRegionsScaledByPowersOfTwo) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Mesh plain = random_tangle(seed).mesh, scaled = plain;
    for (auto& p : scaled.positions()) p *= Point(0x1p200, 0x1p-150);
    const auto a = repair(plain, true), b = repair(scaled, true);
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b)) << seed << message(b.defect);
    ASSERT_EQ(a.record.regions.size(), b.record.regions.size()) << seed;
    for (std::size_t i = 0; i < a.record.regions.size(); ++i)
      EXPECT_EQ(a.record.regions[i].faces, b.record.regions[i].faces);
    EXPECT_EQ(message(validate(scaled)), "") << seed;
  }
}

TEST(FullRemesh, LeavesNoInvertedFaceAndReplacesAll) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Mesh before = random_tangle(seed).mesh;
    Mesh mesh = before;
    const auto outcome = repair(mesh, true, "remesh");
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_EQ(outcome.record.replaced, mesh.n_faces());
    ASSERT_EQ(outcome.record.regions.size(), 1u);
    EXPECT_EQ(outcome.record.regions[0].border_edges, static_cast<int>(mesh.hull().size()));
    EXPECT_EQ(outcome.record.inverted, static_cast<int>(oracle::inverted(before).size()));
  }
}

TEST(Automatic, DoesWhatTheBetterOneDoes) {
  int as_global = 0, as_remesh = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Mesh before = random_tangle(seed).mesh;
    Mesh mesh = before, by_global = before, by_remesh = before;
    const auto outcome = repair(mesh, true, "auto"), global = repair(by_global, true, "global");
    ASSERT_TRUE(outcome && global && repair(by_remesh, true, "remesh")) << seed;
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    const bool has_remeshed = outcome.record.replaced == mesh.n_faces();
    EXPECT_EQ(snapshot_of(mesh), snapshot_of(has_remeshed ? by_remesh : by_global)) << seed;
    EXPECT_EQ(outcome.record.inverted, global.record.inverted) << seed;
    const bool is_most = 2 * global.record.region_faces() > mesh.n_faces();
    EXPECT_TRUE(has_remeshed || !is_most) << seed;
    EXPECT_TRUE(!has_remeshed || is_most || 10 * global.record.inverted > mesh.n_faces()) << seed;
    ++(has_remeshed ? as_remesh : as_global);
  }
  EXPECT_GT(as_global, 20);
  EXPECT_GT(as_remesh, 20);
}

TEST(Strategies, AreFoundByNameOnly) {
  EXPECT_EQ(make_strategy("global")->name(), "global");
  EXPECT_EQ(make_strategy("remesh")->name(), "remesh");
  try {
    make_strategy("Global");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("\"Global\""), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("global"), std::string::npos);
  }
  EXPECT_THROW(register_strategy({"global", "again", [] { return make_strategy("remesh"); }}), InputError);
}

}  // namespace
}  // namespace kinemesh::test
