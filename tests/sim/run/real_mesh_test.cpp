// Meshes of others, read where they are present.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

std::filesystem::path shared_mesh(const std::string& name) {
  return std::filesystem::path(KINEMESH_SHARED_DIR) / "data" / name;
}

class Watcher : public RunObserver {
 public:
  void stepped(const StepRecord& record, const Mesh& mesh) override {
    const auto defect = validate(mesh);
    EXPECT_FALSE(defect) << "step " << record.step << ": " << defect->message();
  }
};

class RealMesh : public testing::Test {
 protected:
  // Runs the text as a scenario on a mesh of others; nothing where it is not there.
  std::optional<RunSummary> go(const std::string& mesh, const std::string& rest) {
    if (!std::filesystem::exists(shared_mesh(mesh))) return std::nullopt;
    folder_.write("a.toml", "[mesh]\nfile = '" + shared_mesh(mesh).string() + "'\n" + rest);
    RunOptions options;
    options.directory = out();
    Watcher watcher;
    return run(load_scenario(folder_ / "a.toml"), options, watcher);
  }

  std::filesystem::path out() const { return folder_ / "out"; }
  MeshData last() const { return read_mesh(out() / "final.su2").mesh; }

  void expect_same_faces_and_markers(const std::string& mesh) {
    const MeshData before = read_mesh(shared_mesh(mesh)).mesh, after = last();
    EXPECT_EQ(before.n_faces(), after.n_faces());
    ASSERT_EQ(before.markers.size(), after.markers.size());
    for (size_t m = 0; m < before.markers.size(); ++m) {
      EXPECT_EQ(before.markers[m].name, after.markers[m].name);
      EXPECT_EQ(before.markers[m].edges, after.markers[m].edges);
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(RealMesh, AirfoilPitchesByItsPublishedMotion) {
  const double omega = 106.69842, period = 2.0 * 3.141592653589793 / omega;
  const auto summary = go("naca64a010.su2",
                          "[[motion]]\nfield = 'pitch'\ncenter = [0.248, 0]\namplitude_deg = 1.01\n"
                          "omega = 106.69842\non = 'marker:airfoil'\nblend = [0.6, 3]\n"
                          "[time]\nsteps = 250\nend = " +
                              std::to_string(10 * period) + "\n[output]\nevery = 0\n");
  if (!summary) GTEST_SKIP() << "no naca64a010.su2 here";
  ASSERT_FALSE(summary->stopped) << *summary->stopped;
  EXPECT_EQ(summary->steps, 250);
  expect_same_faces_and_markers("naca64a010.su2");
  EXPECT_EQ(test::read_csv(out() / "steps.csv").sum("accepted"), 250.0);
}

// A full turn while the far field stands still: the layer between shears, and tangles in most steps.
TEST_F(RealMesh, AirfoilTurnsOnceAround) {
  const auto summary = go("naca64a010.su2",
                          "[[motion]]\nfield = 'rotation'\ncenter = [0.5, 0]\nrate = 6.283185307179586\n"
                          "on = 'marker:airfoil'\nblend = [0.6, 3]\n[time]\nsteps = 360\nend = 1.0\n"
                          "[output]\nevery = 0\n");
  if (!summary) GTEST_SKIP() << "no naca64a010.su2 here";
  ASSERT_FALSE(summary->stopped) << *summary->stopped;
  EXPECT_EQ(summary->steps, 360);
  EXPECT_GT(summary->steps_tangled, 180);
  EXPECT_LT(summary->share_max, 0.05);
  expect_same_faces_and_markers("naca64a010.su2");
}

// The bump rises until 4 % of the channel's height is left, sinks, rises again, and then goes one step too
// far.
TEST_F(RealMesh, BumpClosesTheChannel) {
  const auto summary =
      go("bump_channel.su2",
         "[[motion]]\nfield = 'displacement'\ndx = '0'\n"
         "dy = '(x > 0.9 && x < 1.9) ? (t < 1.51 ? 0.24 * (1 - cos(2 * pi * t)) : 0.51)"
         " * 16 * (x - 0.9)^2 * (1.9 - x)^2 * (1 - 2 * y) : 0'\n"
         "[border]\ninterface = 'moving'\n[time]\ndt = 0.025\nend = 2.0\n[output]\nevery = 0\n");
  if (!summary) GTEST_SKIP() << "no bump_channel.su2 here";
  ASSERT_TRUE(summary->stopped);
  EXPECT_EQ(summary->steps, 60) << *summary->stopped;
  expect_same_faces_and_markers("bump_channel.su2");
  const auto steps = test::read_csv(out() / "steps.csv");
  EXPECT_EQ(steps.rows.size(), 61u);
  EXPECT_EQ(steps.rows.back().at("accepted"), "0");
  double top_of_bump = 0.0;
  const MeshData mesh = last();
  for (const auto& marker : mesh.markers)
    for (const auto& [v, w] : marker.edges)
      if (marker.name == "interface") top_of_bump = std::max(top_of_bump, mesh.points[v].y);
  EXPECT_NEAR(top_of_bump, 0.48, 1e-3);
}

}  // namespace
}  // namespace kinemesh
