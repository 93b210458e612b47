// A run's own output, taken as the motion of another run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

const std::string head = "[mesh]\nshape = 'square'\nvertices = 300\n[[motion]]\n";

std::string tail(int steps) {
  return "[time]\ndt = 0.05\nsteps = " + std::to_string(steps) + "\n[output]\nevery = 5\n";
}

RunSummary run_scenario(const test::TemporaryFolder& folder, const std::string& name,
                        const std::string& text) {
  folder.write(name + ".toml", text);
  RunOptions options;
  options.directory = folder / name;
  RunObserver nobody;
  return run(load_scenario(folder / (name + ".toml")), options, nobody);
}

class RecordedRun : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(run_scenario(folder_, "first", head + "field = 'swirl'\nperiod = 4\n" + tail(40)).stopped);
  }
  std::vector<Point> points(const std::string& run, int step) const {
    return read_mesh(folder_ / (run + "/mesh_0000" + (step < 10 ? "0" : "") + std::to_string(step) + ".vtu"))
        .mesh.points;
  }
  std::string error_of(const std::string& text) const {
    try {
      run_scenario(folder_, "again", text);
      return "no error";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(RecordedRun, IsAtTheSamePlacesAtTheTimesWritten) {
  const auto again =
      run_scenario(folder_, "again", head + "field = 'recorded'\nfile = 'first/mesh.pvd'\n" + tail(40));
  ASSERT_FALSE(again.stopped) << *again.stopped;
  EXPECT_GT(again.steps_tangled, 5);
  for (int step = 0; step <= 40; step += 5) {
    const auto one = points("first", step), two = points("again", step);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t v = 0; v < one.size(); ++v) EXPECT_LE(glm::distance(one[v], two[v]), 1e-14) << step;
  }
  EXPECT_GT(glm::distance(points("first", 20)[150], points("first", 0)[150]), 0.01);
}

TEST_F(RecordedRun, IsRefusedBeforeTheFirstStepWhereTheRecordDoesNotFit) {
  const std::string recorded = "field = 'recorded'\nfile = 'first/mesh.pvd'\n";
  EXPECT_THAT(
      error_of(head + recorded + tail(41)),
      testing::AllOf(testing::HasSubstr("again.toml:6: "),
                     testing::HasSubstr("mesh.pvd: positions from time 0 to 2, but needed from 0 to 2.05")));
  EXPECT_THAT(error_of("[mesh]\nshape = 'square'\nvertices = 301\n[[motion]]\n" + recorded + tail(40)),
              testing::AllOf(testing::HasSubstr("again.toml:6: "),
                             testing::HasSubstr("mesh.pvd: 300 vertices, expected 301 as in the mesh")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "again"));
}

}  // namespace
}  // namespace kinemesh
