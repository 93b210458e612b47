// Whole runs in which the border slides along itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

// Along the sides and across them, from the centre of the unit square turned by the angle of 3-4-5.
Point turned(const Point& p) {
  return {0.8 * (p.x - 0.5) - 0.6 * (p.y - 0.5), 0.6 * (p.x - 0.5) + 0.8 * (p.y - 0.5)};
}
Point turned_back(const Point& p) {
  return {0.8 * p.x + 0.6 * p.y, -0.6 * p.x + 0.8 * p.y};
}

// The stream function cos(pi a) cos(pi b) in the square's own coordinates a, b: tangential on its sides.
const std::string flow =
    "[[motion]]\nfield = 'expression'\n"
    "u = '-0.8 * cos(pi*(0.8*x+0.6*y)) * sin(pi*(0.8*y-0.6*x)) - 0.6 * sin(pi*(0.8*x+0.6*y)) * "
    "cos(pi*(0.8*y-0.6*x))'\n"
    "v = '-0.6 * cos(pi*(0.8*x+0.6*y)) * sin(pi*(0.8*y-0.6*x)) + 0.8 * sin(pi*(0.8*x+0.6*y)) * "
    "cos(pi*(0.8*y-0.6*x))'\n";

class SlidingBorder : public testing::Test {
 protected:
  void SetUp() override {
    MeshData slanted = test::grid(8);
    for (Point& p : slanted.points) p = turned(p);
    write_mesh(folder_ / "slanted.su2", slanted);
  }

  RunSummary run_with_frame(const std::string& mesh, const std::string& motion, double frame) {
    folder_.write("a.toml", "[mesh]\n" + mesh + "\nframe = " + std::to_string(frame) + "\n" + motion +
                                "[border]\ndefault = 'slide'\n[time]\ndt = 0.02\nsteps = 100\n");
    RunOptions options;
    options.directory = folder_ / "out";
    RunObserver nobody;
    return run(load_scenario(folder_ / "a.toml"), options, nobody);
  }
  MeshData last() const { return read_mesh(folder_ / "out/mesh_000100.vtu").mesh; }

  test::TemporaryFolder folder_;
};

TEST_F(SlidingBorder, StaysOnASlantedLineWithinRounding) {
  const RunSummary summary = run_with_frame("file = 'slanted.su2'", flow, 0.25);
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_GT(summary.steps_tangled, 0);
  const MeshData first = test::grid(8), end = last();
  for (const Marker& side : first.markers)
    for (const auto& edge : side.edges)
      for (const int v : edge) {
        const Point from = first.points[v] - Point(0.5, 0.5), to = turned_back(end.points[v]);
        const bool is_level = side.name == "bottom" || side.name == "top";
        EXPECT_NEAR(is_level ? to.y : to.x, is_level ? from.y : from.x, 1e-13) << side.name << ' ' << v;
      }
  const Point slid = turned_back(end.points[2]);  // of the bottom, far from where it began
  EXPECT_GT(std::abs(slid.x - (first.points[2].x - 0.5)), 0.05);
}

TEST_F(SlidingBorder, NeedsNoFrameAlongAnAxisAndOneAlongASlantedLine) {
  const RunSummary summary =
      run_with_frame("shape = 'square'\nvertices = 100", "[[motion]]\nfield = 'taylor-green'\n", 0.0);
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_FALSE(validate(build_mesh(last(), {.frame = 0.0, .fixed = {}})));
  std::filesystem::remove_all(folder_ / "out");
  try {
    run_with_frame("file = 'slanted.su2'", flow, 0.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(": frame = 0, but the outer border slides along a "
                                                 "slanted line at vertex "));
  }
}

}  // namespace
}  // namespace kinemesh
