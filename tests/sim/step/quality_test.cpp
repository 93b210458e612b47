// Steps that end with Delaunay flips or with smoothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>

#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/registry.h"
#include "kinemesh/run.h"
#include "kinemesh/setup.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/sim/helpers.h"
#include "tests/sim/run/shipped.h"
#include "tests/untangle/quality/delaunay.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {
namespace {

using test::Random;
using test::snapshot;

int count_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

Scenario shipped(const std::string& name, int vertices) {
  return load_scenario(test::shipped(name),
                       std::vector<std::string>{"mesh.vertices=" + std::to_string(vertices)});
}

StepperOptions options_of(const Scenario& scenario, const std::string& quality) {
  return {.strategy = scenario.repair.strategy,
          .allow_escaped = scenario.repair.allow_escaped,
          .retain = scenario.repair.retain,
          .quality = quality};
}

Stepper stepper_of(const SetUp& made, const Scenario& scenario, const std::string& quality) {
  return Stepper(made.mesh, options_of(scenario, quality));
}

void expect_valid(const Mesh& mesh, const std::string& about) {
  const auto defect = validate(mesh);
  EXPECT_FALSE(defect) << about << ": " << defect->message();
}

std::string at_step(const StepOutcome& outcome) {
  return "step " + std::to_string(outcome.record.step) +
         (outcome.defect ? ": " + outcome.defect->message() : "");
}

// --- delaunay ---

struct Shipped {
  const char* name;
  int vertices;
};

void PrintTo(const Shipped& s, std::ostream* out) {
  *out << s.name;
}

class ShippedQuality : public testing::TestWithParam<Shipped> {};

INSTANTIATE_TEST_SUITE_P(All, ShippedQuality,
                         testing::Values(Shipped{"swirl", 300}, Shipped{"taylor-green", 300},
                                         Shipped{"twist", 300}, Shipped{"rotor", 300}, Shipped{"jitter", 300},
                                         Shipped{"layers/pitching", 500}, Shipped{"layers/oscillating", 500},
                                         Shipped{"layers/bump", 500}, Shipped{"layers/revolution", 500}),
                         [](const auto& shipped) {
                           std::string name = std::filesystem::path(shipped.param.name).filename();
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(ShippedQuality, IsDelaunayAfterEveryStep) {
  const Scenario scenario = shipped(GetParam().name, GetParam().vertices);
  const auto made = set_up(scenario);
  Stepper stepper = stepper_of(made, scenario, "delaunay");
  int flips = 0;
  for (int n = 1; n <= scenario.time.steps; ++n) {
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    ASSERT_TRUE(outcome) << at_step(outcome);
    ASSERT_EQ(test::not_delaunay(stepper.mesh()), "") << at_step(outcome);
    flips += outcome.record.repair.quality_flips;
  }
  expect_valid(stepper.mesh(), GetParam().name);
  EXPECT_GT(flips, 30);
}

template <class T, std::size_t n>
T any_of(const T (&choices)[n], Random& random) {
  return choices[random.below(static_cast<int>(n))];
}

// A part of the mesh that moves, and with it sometimes noise or a border.
std::string random_scenario(std::uint64_t seed) {
  Random random(seed);
  static constexpr const char* shapes[] = {"square", "disk", "annulus"};
  static constexpr const char* fields[] = {
      "field = 'rotor'\ncenter = [0.3, 0.4]\nradius = 0.35\nrate = 3.0",
      "field = 'swirl'\nperiod = 2.0",
      "field = 'taylor-green'",
      "field = 'gresho'",
      "field = 'rotation'\ncenter = [0.5, 0.2]\nrate = 4.0\non = 'disc:[0.5,0.2,0.1]'\nblend = [0.1, 0.3]",
      "field = 'expression'\nu = '2*sin(9*y+t)'\nv = 'cos(7*x)'",
      "field = 'displacement'\ndx = '0.2*t*sin(6*y)'\ndy = '0'",
      "field = 'translate'\nvelocity = [0.5, 0.2]\non = 'disc:[0.6,0.4,0.2]'",
  };
  static constexpr const char* noises[] = {"", "", "[[motion]]\nfield = 'jitter'\namplitude = 0.3\n",
                                           "[[motion]]\nfield = 'jitter'\namplitude = 1.5\n",
                                           "[[motion]]\nfield = 'brownian'\ndiffusion = 0.01\n"};
  static constexpr const char* borders[] = {"fixed", "fixed", "moving"};
  static constexpr const char* strategies[] = {"global", "global", "local", "remesh"};
  static constexpr const char* bools[] = {"true", "false"};
  std::string text = "[mesh]\nshape = '" + std::string(any_of(shapes, random)) +
                     "'\nvertices = " + std::to_string(50 + random.below(150)) +
                     "\nseed = " + std::to_string(seed) + "\n";
  for (int i = random.below(2); i >= 0; --i)
    text += "[[motion]]\n" + std::string(any_of(fields, random)) + "\n";
  text += any_of(noises, random);
  text += "[border]\ndefault = '" + std::string(any_of(borders, random)) + "'\n";
  text += "[time]\ndt = 0.0" + std::to_string(1 + random.below(9)) + "\nsteps = 6\n";
  text += "[repair]\nstrategy = '" + std::string(any_of(strategies, random)) +
          "'\nallow_escaped = " + any_of(bools, random) + "\nretain = " + any_of(bools, random) + "\n";
  return text;
}

struct Tally {
  int steps = 0, tangled = 0, failed = 0, flips = 0, partly = 0;
};

// Until its end or the first step without valid mesh, which has to leave no trace.
void run_random_scenario(std::uint64_t seed, Tally& tally) {
  const Scenario scenario = parse_scenario(random_scenario(seed), "random.toml");
  const auto made = set_up(scenario);
  Stepper stepper = stepper_of(made, scenario, "delaunay");
  for (int n = 1; n <= scenario.time.steps; ++n) {
    const auto before = snapshot(stepper.mesh());
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    if (!outcome) {
      ++tally.failed;
      ASSERT_EQ(snapshot(stepper.mesh()), before) << at_step(outcome);
      return;
    }
    ASSERT_EQ(test::not_delaunay(stepper.mesh()), "") << at_step(outcome);
    ++tally.steps;
    tally.tangled += !outcome.record.repair.regions.empty();
    tally.flips += outcome.record.repair.quality_flips;
    for (size_t v = 0; v < before.positions.size(); ++v)
      if (!stepper.mesh().is_constrained(Vertex(static_cast<int>(v))) &&
          before.positions[v] == stepper.mesh().positions()[v]) {
        ++tally.partly;
        break;
      }
  }
  expect_valid(stepper.mesh(), "last step");
}

TEST(DelaunaySteps, AreDelaunayInRandomScenarios) {
  const int count = count_from("KINEMESH_RANDOM_SCENARIOS", 1000);
  Tally tally;
  for (int seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + random_scenario(seed));
    run_random_scenario(seed, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.steps, 3 * count);
  EXPECT_GT(tally.tangled, count);
  EXPECT_GT(tally.flips, 20 * count);
  EXPECT_GT(tally.partly, count / 4);
  EXPECT_GT(tally.failed, count / 50);
  RecordProperty("steps", tally.steps);
  RecordProperty("tangled", tally.tangled);
  RecordProperty("failed", tally.failed);
  RecordProperty("flips", tally.flips);
}

// What the log says of a step is measured in part before its repair.
TEST(Record, HasTheMinimaOfTheMeshWhateverWasDoneToIt) {
  const MeshData data = test::grid_with_hole(24, 9, 15);
  const Mesh initial = build_mesh(data, {.frame = 0.25, .fixed = {}});
  const Motion motion(initial, {{make_field("jitter", {{"amplitude", 0.25}}), {}}});
  int tangled = 0, failed = 0;
  for (const auto& strategy : strategies()) {
    for (const auto& quality : qualities()) {
      Stepper stepper(initial, {.strategy = strategy.name, .quality = quality.name});
      for (int n = 1; n <= 12; ++n) {
        const auto outcome = stepper.step(motion, 1.0);
        const Measures measures = measure(stepper.mesh());
        ASSERT_EQ(outcome.record.min_angle_deg, measures.min_angle_deg)
            << strategy.name << ", " << at_step(outcome);
        ASSERT_EQ(outcome.record.min_area, measures.min_area) << strategy.name << ", " << at_step(outcome);
        tangled += outcome.record.repair.inverted > 0;
        failed += !outcome;
      }
    }
  }
  EXPECT_GT(tangled, 100);
  EXPECT_GT(failed, 0);
}

// The square's diagonals are no Delaunay edges after a shear: the first step finds all of them though only
// one vertex moves.
TEST(DelaunaySteps, StartFromWhateverTheMeshWas) {
  MeshData data = test::grid(6);
  for (auto& p : data.points) p.x += 0.7 * p.y;
  Stepper stepper(build_mesh(data, {.frame = 0.25, .fixed = {}}), {.quality = "delaunay"});
  ASSERT_NE(test::not_delaunay(stepper.mesh()), "");
  auto next = stepper.mesh().user_positions();
  next[24].x += 1e-3;
  const auto outcome = stepper.step(next, 1.0);
  ASSERT_TRUE(outcome);
  EXPECT_GT(outcome.record.repair.quality_flips, 30);
  EXPECT_GE(outcome.record.repair.quality_ms, 0.0);
  EXPECT_EQ(test::not_delaunay(stepper.mesh()), "");
  expect_valid(stepper.mesh(), "sheared");
}

// An interface between two labels through the middle, whose ends stay and whose vertices move.
TEST(DelaunaySteps, KeepInterfacesBetweenLabels) {
  MeshData data = test::grid(12);
  for (const auto& [a, b, c] : data.triangles)
    data.labels.push_back(data.points[a].x + data.points[b].x + data.points[c].x < 1.5 ? 1 : 2);
  const Mesh initial = build_mesh(data, {.frame = 0.25, .fixed = {}});
  const Motion motion(initial, {{make_field("jitter", {{"amplitude", 0.6}}), {}}});
  Stepper stepper(initial, {.quality = "delaunay"});
  int flips = 0;
  for (int n = 1; n <= 40; ++n) {
    const auto outcome = stepper.step(motion, 1.0);
    ASSERT_TRUE(outcome) << at_step(outcome);
    ASSERT_EQ(test::not_delaunay(stepper.mesh()), "") << n;
    flips += outcome.record.repair.quality_flips;
  }
  expect_valid(stepper.mesh(), "two labels");
  EXPECT_EQ(std::ranges::count(stepper.mesh().domain().labels, 1), std::ranges::count(data.labels, 1));
  EXPECT_GT(flips, 1000);
}

// What flips rewrote, and nothing else, unless it was replaced.
TEST(DelaunaySteps, NameTheFacesTheyFlip) {
  const Scenario scenario = shipped("rotor", 300);
  const auto made = set_up(scenario);
  Stepper stepper = stepper_of(made, scenario, "delaunay");
  for (int n = 1; n <= 20; ++n) {
    const auto before = snapshot(stepper.mesh()).triangles;
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    ASSERT_TRUE(outcome);
    const auto flipped = stepper.flipped_faces();
    std::set<Face> touched(flipped.begin(), flipped.end());
    EXPECT_EQ(touched.size(), flipped.size());
    EXPECT_LE(static_cast<int>(flipped.size()), 2 * outcome.record.repair.quality_flips);
    EXPECT_EQ(flipped.empty(), outcome.record.repair.quality_flips == 0);
    for (const auto& region : outcome.record.repair.regions)
      touched.insert(region.faces.begin(), region.faces.end());
    for (const Face f : stepper.mesh().faces())
      EXPECT_TRUE(touched.contains(f) || stepper.mesh().triangles()[f] == before[f]) << n << " " << f;
  }
}

TEST(DelaunaySteps, GoOnWhereARejectedStepLeftThem) {
  Stepper stepper(build_mesh(test::grid_with_hole(8, 3, 5), {.frame = 0.25, .fixed = {}}),
                  {.quality = "delaunay"});
  const auto shaken = [&](unsigned seed) {
    Random random(seed);
    auto next = stepper.mesh().user_positions();
    for (auto& p : next) p += Point(0.03 * random.between(-1.0, 1.0), 0.03 * random.between(-1.0, 1.0));
    return next;
  };
  ASSERT_TRUE(stepper.step(shaken(1), 0.5));
  const auto before = snapshot(stepper.mesh());
  auto next = shaken(2);
  next[3 * 9 + 3] = {-0.2, 0.43};  // a corner of the hole, out through the left border
  ASSERT_FALSE(stepper.step(next, 0.5));
  EXPECT_EQ(snapshot(stepper.mesh()), before);
  EXPECT_EQ(stepper.time(), 0.5);
  for (unsigned seed = 3; seed < 13; ++seed) {
    const auto outcome = stepper.step(shaken(seed), 0.5);
    EXPECT_EQ(outcome ? test::not_delaunay(stepper.mesh()) : "", "") << seed;
  }
  EXPECT_GT(stepper.steps_done(), 3);
}

// Against slivers: as good as triangulating everything anew, while a run without quality gets worse.
TEST(DelaunaySteps, KeepTheAnglesOfAFullRemesh) {
  const int steps = count_from("KINEMESH_ROTOR_STEPS", 60);
  Scenario scenario = shipped("rotor", steps > 60 ? 2000 : 600);
  const auto made = set_up(scenario);
  Stepper flipped = stepper_of(made, scenario, "delaunay"), left = stepper_of(made, scenario, "none");
  Stepper remeshed(made.mesh, {.strategy = "remesh"});
  int worse = 0;
  double smallest_ratio = 1e9, sum_flipped = 0.0, sum_left = 0.0;
  for (int n = 1; n <= steps; ++n) {
    const auto best = remeshed.step_to(made.motion, 0.01 * n), mine = flipped.step_to(made.motion, 0.01 * n),
               without = left.step_to(made.motion, 0.01 * n);
    ASSERT_TRUE(best && mine && without) << n;
    const double ratio = mine.record.min_angle_deg / best.record.min_angle_deg;
    ASSERT_GE(ratio, 0.5) << n;
    smallest_ratio = std::min(smallest_ratio, ratio);
    sum_flipped += std::log(mine.record.min_angle_deg);
    sum_left += std::log(without.record.min_angle_deg);
    worse += without.record.min_angle_deg < 0.5 * best.record.min_angle_deg;
  }
  RecordProperty("smallest_ratio", std::to_string(smallest_ratio));
  RecordProperty("mean_angle_delaunay", std::to_string(std::exp(sum_flipped / steps)));
  RecordProperty("mean_angle_none", std::to_string(std::exp(sum_left / steps)));
  RecordProperty("steps_below_half_without", worse);
  EXPECT_GT(worse, steps / 10);
}

TEST(DelaunaySteps, AreLogged) {
  const test::TemporaryFolder folder;
  Scenario scenario = shipped("rotor", 300);
  scenario.time = {.dt = 0.01, .end = 0.1, .steps = 10, .integrator = Integrator::Rk4};
  scenario.repair.quality = "delaunay";
  scenario.output.every = 1;
  RunOptions options;
  options.directory = folder / "out";
  RunObserver silent;
  ASSERT_FALSE(run(scenario, options, silent).stopped);
  const auto steps = test::read_csv(options.directory / "steps.csv");
  EXPECT_GT(steps.sum("quality_flips"), 100.0);
  EXPECT_GT(steps.sum("quality_ms"), 0.0);
  EXPECT_THAT(test::content_of(options.directory / "scenario.toml"),
              testing::HasSubstr("quality = 'delaunay'"));
}

// --- smooth ---

// The worst angle before smoothing is that of a twin without, started from the same mesh.
TEST_P(ShippedQuality, IsNeverWorseForSmoothing) {
  const Scenario scenario = shipped(GetParam().name, GetParam().vertices);
  const auto made = set_up(scenario);
  Stepper stepper = stepper_of(made, scenario, "smooth");
  int better = 0, steps = 0;
  for (int n = 1; n <= std::min(scenario.time.steps, 60); ++n, ++steps) {
    const Mesh before = stepper.mesh();
    const double time = stepper.time(), end = scenario.time.time_after(n);
    const auto outcome = stepper.step_to(made.motion, end);
    if (!outcome) {
      EXPECT_EQ(snapshot(stepper.mesh()), snapshot(before));
      break;
    }
    std::vector<Point> moved(before.positions().begin(), before.positions().end());
    made.motion.advance(before.positions(), time, end - time, static_cast<std::uint64_t>(n - 1), moved);
    std::vector<Point> next(before.n_user_vertices());
    for (const UserVertex u : Numbers<UserVertex>(before.n_user_vertices()))
      next[u] = moved[before.vertex_of_user(u)];
    Stepper twin(before, options_of(scenario, "none"));
    const auto unsmoothed = twin.step(next, end - time);
    ASSERT_TRUE(unsmoothed) << at_step(unsmoothed);
    EXPECT_EQ(snapshot(twin.mesh()).triangles, snapshot(stepper.mesh()).triangles);
    EXPECT_GE(outcome.record.min_angle_deg, unsmoothed.record.min_angle_deg) << n;
    better += outcome.record.min_angle_deg > unsmoothed.record.min_angle_deg;
    expect_valid(stepper.mesh(), at_step(outcome));
    for (const Vertex v : before.vertices())
      EXPECT_TRUE(stepper.mesh().position(v) == twin.mesh().position(v) ||
                  (before.user_vertex(v) != none && !before.is_constrained(v)));
  }
  EXPECT_GT(steps, 20);
  EXPECT_GT(better, steps / 5);
}

// A displacement of all alike: each step is the increment, added to where smoothing left the vertex; the
// smoothed mesh has come to rest and is carried along.
TEST(SmoothSteps, GoOnFromWhereSmoothingLeftAVertex) {
  Random random(7);
  MeshData data = test::grid(8);
  for (int j = 1; j < 8; ++j)
    for (int i = 1; i < 8; ++i)
      data.points[j * 9 + i] += Point(random.between(-0.05, 0.05), random.between(-0.05, 0.05));
  const Mesh initial = build_mesh(data, {.frame = 0.25, .fixed = {}});
  const Motion motion(initial, {{make_field("displacement", {{"dx", "0.5*t*t"}, {"dy", "0.25*t"}}), {}}},
                      {.otherwise = BorderCondition::Moving, .by_marker = {}});
  Stepper stepper(initial, {.quality = "smooth"});
  for (int n = 1; n <= 20; ++n) ASSERT_TRUE(stepper.step_to(motion, 0.0));
  const auto rest = stepper.mesh().user_positions();
  double smoothed = 0.0;
  for (size_t v = 0; v < rest.size(); ++v)
    smoothed = std::max(smoothed, glm::distance(rest[v], data.points[v]));
  EXPECT_GT(smoothed, 0.01);
  for (int n = 1; n <= 10; ++n) ASSERT_TRUE(stepper.step_to(motion, 0.1 * n));
  const auto end = stepper.mesh().user_positions();
  for (size_t v = 0; v < rest.size(); ++v) {
    EXPECT_NEAR(end[v].x, rest[v].x + 0.5, 1e-12) << v;
    EXPECT_NEAR(end[v].y, rest[v].y + 0.25, 1e-12) << v;
  }
}

// --- both ---

// --- angles ---

TEST(AngleSteps, KeepTheAnglesOfTheAirfoil) {
  Scenario scenario = shipped("layers/revolution", 1000);
  scenario.repair.quality = "angles";
  scenario.repair.angle = 20.0;
  const auto made = set_up(scenario);
  Stepper stepper(made.mesh, stepper_options(scenario.repair, made.motion));
  std::size_t moved = 0;
  stepper.observe([&](const StepChanges& changes) { moved += changes.moved_by_quality.size(); });
  for (int n = 1; n <= scenario.time.steps; ++n) {
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    ASSERT_TRUE(outcome) << at_step(outcome);
    ASSERT_GE(outcome.record.min_angle_deg, 20.0 * (1.0 - 1e-12)) << n;
    ASSERT_EQ(outcome.record.min_angle_deg, measure(stepper.mesh()).min_angle_deg) << n;
  }
  expect_valid(stepper.mesh(), "airfoil");
  EXPECT_LT(moved, 0.03 * stepper.mesh().n_user_vertices() * scenario.time.steps);
}

TEST(AngleSteps, DoNothingWhereNothingIsBad) {
  Stepper stepper(build_mesh(test::grid(8), {.frame = 0.25, .fixed = {}}),
                  {.quality = "angles", .angle = 44.0});
  const auto before = snapshot(stepper.mesh());
  const auto outcome = stepper.step(stepper.mesh().user_positions(), 1.0);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome.record.repair.quality_flips + outcome.record.repair.quality_moves, 0);
  EXPECT_EQ(snapshot(stepper.mesh()), before);
}

TEST(AngleSteps, MoveNothingThatIsHeld) {
  const Mesh initial = build_mesh(test::grid_with_hole(12, 5, 7), {.frame = 0.25, .fixed = {}});
  const Motion motion(initial, {{make_field("jitter", {{"amplitude", 0.3}}), {}}});
  StepperOptions options{.quality = "angles"};
  options.freedom.held.assign(initial.n_vertices(), true);
  Stepper stepper(initial, options);
  for (int n = 0; n < 10; ++n) {
    const auto outcome = stepper.step(motion, 1.0);
    ASSERT_TRUE(outcome) << at_step(outcome);
    EXPECT_EQ(outcome.record.repair.quality_moves, 0);
  }
}

TEST(AngleSteps, RefuseWhatIsNoAngle) {
  const Mesh mesh = build_mesh(test::grid(3));
  for (const double angle : {0.0, 60.0, -1.0, std::nan("")})
    EXPECT_THROW(Stepper(mesh, {.quality = "angles", .angle = angle}), InputError) << angle;
  EXPECT_NO_THROW(Stepper(mesh, {.quality = "smooth", .angle = 60.0}));
}

TEST(QualitySteps, LeaveNoTraceOfAFailure) {
  for (const char* quality : {"delaunay", "smooth"}) {
    Stepper stepper(build_mesh(test::grid_with_hole(8, 3, 5), {.frame = 0.25, .fixed = {}}),
                    {.quality = quality});
    auto next = stepper.mesh().user_positions();
    next[0] += Point(0.01, 0.02);
    next[40] += Point(0.02, 0.01);
    ASSERT_TRUE(stepper.step(next, 0.5)) << quality;
    const auto before = snapshot(stepper.mesh());
    next = stepper.mesh().user_positions();
    next[2 * 9 + 2] = next[2 * 9 + 1];
    const auto outcome = stepper.step(next, 0.5);
    ASSERT_FALSE(outcome) << quality;
    EXPECT_EQ(outcome.defect->kind, DefectKind::CoincidentVertices);
    EXPECT_EQ(outcome.record.repair.quality_flips, 0);
    EXPECT_EQ(snapshot(stepper.mesh()), before) << quality;
    EXPECT_EQ(stepper.time(), 0.5);
    EXPECT_EQ(stepper.steps_done(), 1);
  }
}

TEST(QualitySteps, NamesAreChecked) {
  try {
    Stepper(build_mesh(test::grid(2)), {.quality = "best"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown quality \"best\", expected one of none, delaunay, smooth, angles");
  }
}

}  // namespace
}  // namespace kinemesh
