// Every scenario in examples/scenarios and in layers/, at a small size and in full length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "kinemesh/measure.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"
#include "tests/sim/run/shipped.h"

namespace kinemesh {
namespace {

using test::shipped;

// Looks at the mesh after every step.
class Watcher : public RunObserver {
 public:
  void stepped(const StepRecord& record, const Mesh& mesh) override {
    const auto defect = validate(mesh);
    EXPECT_FALSE(defect) << "step " << record.step << ": " << defect->message();
    EXPECT_EQ(record.repair.retries(), 0) << record.step;
    EXPECT_EQ(record.repair.doubled_edges, 0) << record.step;
    if (record.step == 1) area_ = measure(mesh).area;
    area_span_ = std::max(area_span_, std::abs(measure(mesh).area - area_));
    smallest_angle_ = std::min(smallest_angle_, record.min_angle_deg);
  }
  double area_span() const { return area_span_; }
  double smallest_angle() const { return smallest_angle_; }

 private:
  double area_ = 0.0, area_span_ = 0.0, smallest_angle_ = 60.0;
};

Edge sorted(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

std::set<Edge> edges_of(const MeshData& mesh) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : mesh.triangles) edges.insert({sorted(a, b), sorted(b, c), sorted(c, a)});
  return edges;
}

void expect_markers_kept(const MeshData& first, const MeshData& last) {
  const auto edges = edges_of(last);
  ASSERT_EQ(first.markers.size(), last.markers.size());
  for (size_t m = 0; m < first.markers.size(); ++m) {
    EXPECT_EQ(first.markers[m].name, last.markers[m].name);
    EXPECT_EQ(first.markers[m].edges, last.markers[m].edges) << first.markers[m].name;
    for (const auto& [a, b] : last.markers[m].edges)
      EXPECT_TRUE(edges.contains(sorted(a, b))) << first.markers[m].name << ' ' << a << ' ' << b;
  }
}

void expect_coherent_logs(const std::filesystem::path& directory, const RunSummary& summary) {
  const auto steps = test::read_csv(directory / "steps.csv"),
             regions = test::read_csv(directory / "regions.csv");
  EXPECT_EQ(steps.rows.size(), static_cast<size_t>(summary.plan.steps));
  EXPECT_EQ(steps.sum("accepted"), summary.plan.steps);
  EXPECT_EQ(steps.sum("regions"), static_cast<double>(regions.rows.size()));
  EXPECT_EQ(steps.sum("region_faces"), regions.sum("faces"));
  EXPECT_EQ(steps.sum("inverted"), regions.sum("inverted"));
  EXPECT_EQ(steps.sum("explored"), steps.sum("region_faces"));
  EXPECT_EQ(steps.sum("faces"), static_cast<double>(summary.plan.faces) * summary.plan.steps);
}

double largest_difference(const std::vector<Point>& a, const std::vector<Point>& b) {
  double largest = 0.0;
  for (size_t v = 0; v < a.size(); ++v) largest = std::max(largest, glm::distance(a[v], b[v]));
  return largest;
}

struct Expectation {
  const char* name;
  int vertices;          // instead of the scenario's
  int tangled_at_least;  // steps
  double returns_to;     // largest distance from the start at the end; infinity: does not return
  double area_change;    // largest change of the domain's area
  double angle = 0.0;    // that each step keeps, in degrees
};

void PrintTo(const Expectation& e, std::ostream* out) {
  *out << e.name;
}

class ShippedScenario : public testing::TestWithParam<Expectation> {};

TEST_P(ShippedScenario, KeepsAValidMeshToItsEnd) {
  const Expectation& expected = GetParam();
  const test::TemporaryFolder folder;
  const std::vector<std::string> small = {"mesh.vertices=" + std::to_string(expected.vertices)};
  const Scenario scenario = load_scenario(shipped(expected.name), small);
  RunOptions options;
  options.directory = folder / "out";
  Watcher watcher;
  const RunSummary summary = run(scenario, options, watcher);
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_EQ(summary.time, scenario.time.end);
  EXPECT_GE(summary.steps_tangled, expected.tangled_at_least);
  EXPECT_LE(watcher.area_span(), expected.area_change);
  EXPECT_GE(watcher.smallest_angle(), expected.angle);
  expect_coherent_logs(options.directory, summary);

  const MeshData first = read_mesh(options.directory / "mesh_000000.vtu").mesh;
  const MeshData last = read_mesh(options.directory / "final.su2").mesh;
  EXPECT_EQ(first.n_faces(), last.n_faces());
  expect_markers_kept(first, last);
  EXPECT_LE(largest_difference(first.points, last.points), expected.returns_to);
}

TEST_P(ShippedScenario, StaysValidUntangledLocallyAndRetaining) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> overrides = {"mesh.vertices=" + std::to_string(GetParam().vertices),
                                              "repair.strategy=local", "repair.retain=true"};
  RunOptions options;
  options.directory = folder / "out";
  Watcher watcher;
  const RunSummary summary = run(load_scenario(shipped(GetParam().name), overrides), options, watcher);
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_GE(summary.steps_tangled, GetParam().tangled_at_least);
  expect_coherent_logs(options.directory, summary);
  const auto steps = test::read_csv(options.directory / "steps.csv");
  if (GetParam().tangled_at_least > 0) {
    EXPECT_LT(steps.sum("replaced"), steps.sum("region_faces"));
  }
}

constexpr double never = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(All, ShippedScenario,
                         testing::Values(Expectation{"swirl", 800, 20, 1e-4, 1e-12},
                                         Expectation{"taylor-green", 800, 5, never, 1e-12},
                                         Expectation{"twist", 800, 20, 1e-4, 1e-12},
                                         Expectation{"vortices", 800, 20, never, 1e-12},
                                         Expectation{"rotor", 800, 90, 1e-9, 1e-12},
                                         Expectation{"jitter", 800, 50, never, 1e-12},
                                         Expectation{"layers/pitching", 1500, 10, 1e-9, 1e-9},
                                         Expectation{"layers/oscillating", 1500, 10, 1e-9, 1e-9},
                                         Expectation{"layers/bump", 1500, 10, 1e-9, 0.1},
                                         Expectation{"layers/revolution", 1500, 50, 1e-4, 1e-4},
                                         Expectation{"pitching-airfoil", 1500, 0, never, 1e-9, 24.9},
                                         Expectation{"oscillating-cylinder", 1500, 0, never, 1e-9, 24.9},
                                         Expectation{"moving-bump", 1500, 10, never, 0.1, 24.9},
                                         Expectation{"airfoil-revolution", 1500, 0, never, 1e-9, 24.9}),
                         [](const auto& expected) {
                           std::string name = std::filesystem::path(expected.param.name).filename();
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// All there, none forgotten here.
TEST(ShippedScenarios, AreAllTested) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(shipped("").parent_path()))
    names.insert(entry.path().stem().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("swirl", "taylor-green", "twist", "rotor", "jitter",
                                                   "pitching-airfoil", "oscillating-cylinder", "moving-bump",
                                                   "airfoil-revolution", "vortices"));
}

// It is a bump, it moves, and it is gone at the end.
TEST(ShippedScenarios, TheBumpTravels) {
  const Scenario scenario =
      load_scenario(shipped("moving-bump"), std::vector<std::string>{"mesh.vertices=1500"});
  struct Tops : RunObserver {
    void stepped(const StepRecord& record, const Mesh& mesh) override {
      Point top{0.0, 0.0};
      for (const auto& marker : mesh.markers())
        for (const auto& edge : marker.edges)
          if (const Point p = mesh.positions()[mesh.vertex_of_user(UserVertex(edge[0]))];
              marker.name == "bottom" && p.y > top.y)
            top = p;
      tops[record.step] = top;
    }
    std::map<int, Point> tops;
  } observer;
  const test::TemporaryFolder folder;
  RunOptions options;
  options.directory = folder / "out";
  ASSERT_FALSE(run(scenario, options, observer).stopped);
  EXPECT_NEAR(observer.tops.at(50).y, 0.25, 0.03);
  EXPECT_NEAR(observer.tops.at(50).x, 2.4, 0.1);
  EXPECT_NEAR(observer.tops.at(80).x, 2.76, 0.1);
  EXPECT_NEAR(observer.tops.at(100).y, 0.0, 1e-9);
}

}  // namespace
}  // namespace kinemesh
