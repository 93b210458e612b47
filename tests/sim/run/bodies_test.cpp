// Whole runs with bodies: what a run promises holds for them, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <glm/geometric.hpp>
#include <map>

#include "kinemesh/build.h"
#include "kinemesh/compare.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/setup.h"
#include "kinemesh/validate.h"
#include "motion/border.h"
#include "sim/run/failed_step.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using test::results_in;
using testing::HasSubstr;

// A cylinder that goes up and down in a channel and turns, with walls that slide.
const std::string cylinder =
    "[mesh]\nshape = 'channel'\nvertices = 700\n"
    "[[body]]\non = 'marker:cylinder'\n"
    "motion = [{field = 'rigid', x = '0.2*sin(2*t)', y = '0.15*sin(5*t)'},\n"
    "          {field = 'rotation', center = [1.0, 0.5], rate = 3.0}]\n"
    "[border]\ntop = 'slide'\nbottom = 'slide'\n"
    "[time]\ndt = 0.03\nsteps = 12\n"
    "[output]\nevery = 5\ncheckpoint = 2\n";

class BodyRuns : public testing::Test {
 protected:
  Scenario load(const std::vector<std::string>& overrides = {}) const {
    return parse_scenario(cylinder, folder_ / "cylinder.toml", overrides);
  }

  RunSummary go(const Scenario& scenario, const std::string& name, RunOptions options = {}) const {
    RunObserver silent;
    options.directory = folder_ / name;
    return kinemesh::run(scenario, options, silent);
  }

  test::TemporaryFolder folder_;
};

class StopAfter : public RunObserver {
 public:
  explicit StopAfter(int steps) : steps_(steps) {}
  void stepped(const StepRecord&, const Mesh&) override {
    if (--steps_ == 0) std::raise(SIGINT);
  }

 private:
  int steps_;
};

TEST_F(BodyRuns, EndValidWithTheirBordersWhereTheyAreTold) {
  const RunSummary summary = go(load(), "out");
  ASSERT_FALSE(summary.stopped) << *summary.stopped;
  EXPECT_GT(summary.ms.interior, 0.0);
  const auto steps = test::read_csv(folder_ / "out/steps.csv");
  for (std::size_t i = 0; i < steps.rows.size(); ++i) EXPECT_GT(steps.number(i, "min_angle_deg"), 15.0);
  EXPECT_GT(steps.sum("interior_ms"), 0.0);
}

TEST_F(BodyRuns, AreTheSameForAnyNumberOfThreads) {
  RunOptions one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_FALSE(go(load(), "one", one).stopped);
  EXPECT_FALSE(go(load(), "two", two).stopped);
  EXPECT_EQ(results_in(folder_ / "one"), results_in(folder_ / "two"));
}

// The solver's start vector is part of the checkpoint; also where steps are halved.
TEST_F(BodyRuns, GoOnToTheSameBits) {
  const std::vector<std::vector<std::string>> variants{
      {},
      {"time.dt=0.3", "time.steps=3", "body.0.motion.1.rate=10",
       "time.adaptive={max_region_share=1e-6,min_dt=1e-4}"}};
  for (const auto& overrides : variants) {
    const std::string whole = "whole" + std::to_string(overrides.size());
    const std::string cut = "cut" + std::to_string(overrides.size());
    const RunSummary undisturbed = go(load(overrides), whole);
    ASSERT_FALSE(undisturbed.stopped) << *undisturbed.stopped;
    EXPECT_TRUE(overrides.empty() || undisturbed.rejected > 2) << undisturbed.rejected;
    RunOptions options;
    options.directory = folder_ / cut;
    options.resume = true;
    for (const int steps : {3, 4}) {
      StopAfter observer(steps);
      ASSERT_TRUE(kinemesh::run(load(overrides), options, observer).stopped);
    }
    ASSERT_FALSE(go(load(overrides), cut, options).stopped);
    EXPECT_EQ(results_in(folder_ / cut), results_in(folder_ / whole));
  }
}

TEST_F(BodyRuns, AreBenchedOnTheSamePositions) {
  const std::vector<std::string> strategies{"global", "remesh", "kinetic"};
  const Scenario scenario = load({"repair.quality=none"});
  std::map<int, std::vector<Point>> positions;
  int rounds = 0;
  const auto stopped = compare_strategies(scenario, set_up(scenario), strategies, [&](const Round& round) {
    ++rounds;
    EXPECT_TRUE(round.record.accepted);
    EXPECT_GT(round.record.interior_ms, 0.0);
    const auto [first, is_new] = positions.emplace(round.record.step, round.mesh.user_positions());
    if (!is_new) {
      EXPECT_EQ(first->second, round.mesh.user_positions()) << round.strategy;
    }
  });
  EXPECT_FALSE(stopped);
  EXPECT_EQ(rounds, 36);
}

// Steps of a body that comes to rest after some of them: from then on no bit changes. `look` sees each
// outcome.
template <class Look>
void expect_rest(const std::string& text, int resting_from, const Look& look) {
  const Scenario scenario = parse_scenario(text, "rest.toml");
  auto made = set_up(scenario);
  Stepper stepper(made.mesh, stepper_options(scenario.repair, made.motion));
  std::vector<Point> at_rest;
  for (int n = 1; n <= scenario.time.steps; ++n) {
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    ASSERT_TRUE(outcome) << outcome.defect->message();
    look(outcome);
    if (n == resting_from) at_rest = stepper.mesh().user_positions();
    if (n > resting_from) {
      EXPECT_EQ(stepper.mesh().user_positions(), at_rest) << n;
    }
  }
  EXPECT_NE(at_rest, made.mesh.user_positions());
}

// On a mesh that meets the angle nothing flips and nothing moves but by the body; at rest nothing at all.
TEST_F(BodyRuns, ComeToRestBitForBit) {
  expect_rest(
      "[mesh]\nshape = 'channel'\nvertices = 500\n"
      "[[body]]\non = 'marker:cylinder'\nmotion = [{field = 'rigid', x = '0.01*min(t, 2)'}]\n"
      "[repair]\nangle = 10.0\n[time]\ndt = 1.0\nsteps = 5\n",
      2, [](const StepOutcome& outcome) {
        EXPECT_EQ(outcome.record.repair.quality_flips, 0);
        EXPECT_EQ(outcome.record.repair.quality_moves, 0);
      });
}

TEST_F(BodyRuns, ComeToRestBesideASlidingCircleToo) {
  expect_rest(
      "[mesh]\nshape = 'annulus'\nvertices = 300\nframe = 0.4\n"
      "[[body]]\non = 'marker:inner'\nmotion = [{field = 'rigid', x = '0.3*min(t, 0.3)'}]\n"
      "[border]\nouter = 'slide'\n[repair]\nquality = 'none'\n[time]\ndt = 0.1\nsteps = 6\n",
      3, [](const StepOutcome&) {});
}

TEST_F(BodyRuns, MistakesHaveTheirLine) {
  const auto error_of = [&](const std::string& text) -> std::string {
    try {
      (void)set_up(parse_scenario(text, "a.toml"));
      return "none";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const std::string mesh = "[mesh]\nshape = 'channel'\nvertices = 300\n",
                    time = "[time]\ndt = 0.1\nsteps = 1\n";
  EXPECT_THAT(error_of(mesh + "[[body]]\nmotion = []\n" + time),
              HasSubstr("a.toml:4: [[body]]: on expected"));
  EXPECT_THAT(error_of(mesh + "[[body]]\non = 'marker:wing'\n" + time),
              HasSubstr("a.toml:5: no marker 'wing'"));
  EXPECT_THAT(
      error_of(mesh + "[[body]]\non = 'marker:cylinder'\nmotion = [{field = 'jitter', amplitude = 0.1}]\n" +
               time),
      HasSubstr("a.toml:6: body marker:cylinder: field \"jitter\" is noise"));
  EXPECT_THAT(error_of(mesh + "[[body]]\non = 'marker:cylinder'\n[border]\ncylinder = 'fixed'\n" + time),
              HasSubstr("a.toml:7: the marker 'cylinder' is of a body"));
  EXPECT_THAT(error_of(mesh + "[[body]]\non = 'marker:cylinder'\n[interior]\nfollow = 'rigid'\n" + time),
              HasSubstr("a.toml:7: follow: unknown: 'rigid'"));
  EXPECT_THAT(error_of(mesh + "[[body]]\non = 'marker:cylinder'\n[interior]\nstiffness = {a = 1.0}\n" + time),
              HasSubstr("a label, that is an integer, expected"));
  EXPECT_THAT(
      error_of(mesh +
               "[[body]]\non = 'marker:cylinder'\n[[motion]]\nfield = 'translate'\nvelocity = [0, 1]\n"
               "on = 'marker:top'\nblend = [0.1, 0.2]\n" +
               time),
      HasSubstr("blend makes a layer"));
  EXPECT_THAT(
      error_of(mesh + "[[body]]\non = 'marker:cylinder'\nmotion = [{field = 'rigid', x = 'x*t'}]\n" + time),
      HasSubstr("a.toml:6: x = \"x*t\": only a formula in t is expected, but there is x at character 1"));
  EXPECT_THAT(
      error_of(mesh + "[[body]]\non = 'marker:cylinder'\nmotion = [\n{field = 'rigid', angle = 't+y'}]\n" +
               time),
      HasSubstr("a.toml:7: angle = \"t+y\": only a formula in t"));
  const struct {
    const char *scenario, *says;
  } more[] = {
      {"[interior]\nstiffness = {0 = 1.0, 3 = 2.0}",
       "a.toml:7: interior.stiffness.3: no label 3 in the mesh, expected one of: 0"},
      {"[interior]\nstiffness = {0 = 1e308}",
       "a.toml:7: interior.stiffness.0: 1e+308, a number from 1e-06 to"},
      {"[interior]\nstiffness = {0 = 1e-320}", "a.toml:7: interior.stiffness.0: "},
      {"[interior]\nstiffness = [1]", "a.toml:7: stiffness: a list, a table expected: [interior.stiffness]"},
      {"motion = 3", "a.toml:6: motion: 3, a list of tables expected: motion = [{ ... }]"},
      {"motion = [{field = 'rigid', file = 'none.csv'}]", "a.toml:6: file: "},
      {"motion = [{field = 'recorded', file = 'none.csv'}]", "a.toml:6: file: "},
      {"[[body]]\non = []", "a.toml:7: on: an empty list"},
      {"[[body]]\non = ''", "a.toml:7: a body: on = \"\", expected marker:NAME or label:N"},
      {"[[body]]\non = 'all'", "a.toml:7: a body: on = \"all\", expected marker:NAME or label:N"},
      {"[[body]]\non = ['marker:top', 'marker:cylinder']",
       "a.toml:7: marker:cylinder is of two bodies, the other is marker:cylinder"},
  };
  for (const auto& [scenario, says] : more)
    EXPECT_THAT(error_of(mesh + "[[body]]\non = 'marker:cylinder'\n" + scenario + "\n" + time),
                HasSubstr(says));
  EXPECT_EQ(error_of(mesh + "[[body]]\non = 'marker:cylinder'\n" + time), "none");
}

TEST_F(BodyRuns, SayWhichMotionsMoveNothing) {
  const std::string motion = "[[motion]]\nfield = 'jitter'\namplitude = 0.1\non = 'marker:";
  const std::string text =
      "[mesh]\nshape = 'square'\nvertices = 100\n[[body]]\non = ['marker:left', 'marker:right']\n" + motion +
      "left'\n" + motion + "top'\n[time]\ndt = 0.1\nsteps = 1\n";
  const auto notes = set_up(parse_scenario(text, "a.toml")).notes;
  EXPECT_THAT(notes, testing::ElementsAre(
                         HasSubstr("on a fixed border"),
                         HasSubstr("a.toml:9: on: jitter moves nothing, as bodies own all of marker:left")));
}

TEST_F(BodyRuns, ThatMeetAWallNameIt) {
  const std::string text =
      "[mesh]\nshape = 'square'\nvertices = 100\n[[body]]\non = 'marker:right'\n"
      "motion = [{field = 'rigid', x = '-t'}]\n[border]\ntop = 'slide'\nbottom = 'slide'\n"
      "[time]\ndt = 0.5\nsteps = 2\n";
  const RunSummary summary = go(parse_scenario(text, folder_ / "s.toml"), "out");
  ASSERT_TRUE(summary.stopped);
  EXPECT_THAT(*summary.stopped,
              HasSubstr("is of the border of marker \"bottom\" and the border of marker \"left\""));
}

// Cells of a table may be in quotes, as spreadsheets write them.
TEST_F(BodyRuns, TakeTablesWithQuotes) {
  folder_.write("plain.csv", "t,x,y,angle\n0,0,0,0\n1,0.1,0.05,0.5\n");
  folder_.write("quoted.csv",
                "\xEF\xBB\xBF\"t\",\"x\", \"y\",\"angle\"\r\n\"0\",\"0\",0,0\r\n1,\"0.1\",0.05,\"0.5\"\r\n");
  folder_.write("broken.csv", "t,x,y,angle\n0,0,0,0\n1,\"0,1\",0.05,0.5\n");
  const auto with = [&](const char* file) {
    return load({std::string("body.0.motion=[{field='rigid',center=[1,0.5],file='") + file + "'}]"});
  };
  for (const char* file : {"plain", "quoted"})
    ASSERT_FALSE(go(with((std::string(file) + ".csv").c_str()), file).stopped);
  EXPECT_EQ(read_mesh(folder_ / "plain/final.su2").mesh.points,
            read_mesh(folder_ / "quoted/final.su2").mesh.points);
  EXPECT_THROW((void)with("broken.csv"), InputError);
}

// Resuming would stop at the same step: what has to change is said, and no command that goes on.
TEST_F(BodyRuns, ThatStopAtWhatStaysSoSayThatItHasToChange) {
  const struct {
    const char *motion, *bodies, *says;
  } cases[] = {{"y = 't > 0.25 ? 0.1 : 0'", "", "off the line on which marker"},
               {"x = 't'", "[[body]]\non = 'marker:left'\n[[body]]\non = 'marker:bottom'\n", "share vertex"},
               {"x = 'sqrt(0.25 - t)'", "", "its path gives no finite place for it at time 0.3"}};
  for (const auto& [motion, bodies, says] : cases) {
    const bool is_shared = *bodies;
    const std::string text =
        std::string("[mesh]\nshape = 'square'\nvertices = 200\n[[body]]\non = 'marker:right'\n") +
        "motion = [{field = 'rigid', " + motion + "}]\n" + bodies +
        (is_shared ? "" : "[border]\ntop = 'slide'\nbottom = 'slide'\n") + "[time]\ndt = 0.1\nend = 1\n";
    const RunSummary summary = go(parse_scenario(text, folder_ / "s.toml"), std::string(says, 8));
    ASSERT_TRUE(summary.stopped) << text;
    EXPECT_FALSE(summary.can_resume) << *summary.stopped;
    EXPECT_THAT(*summary.stopped, testing::AllOf(HasSubstr(says), HasSubstr("change the scenario")));
  }
}

// A disc that travels in a tank whose wall is a circle and slides.
const std::string tank =
    "[mesh]\nshape = 'annulus'\nvertices = 500\n"
    "[[body]]\non = 'marker:inner'\n"
    "motion = [{field = 'rigid', x = '0.47*sin(2*t)'},\n"
    "          {field = 'rotation', center = [0.0, 0.0], rate = 1.0}]\n"
    "[border]\nouter = 'slide'\n"
    "[time]\ndt = 0.1\nsteps = 30\n"
    "[output]\nevery = 10\ncheckpoint = 4\n";

void expect_on_line_in_order(const SlideLine& line, const Mesh& mesh) {
  const auto vertices = line.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point x = mesh.position(vertices[i]), next = mesh.position(vertices[(i + 1) % vertices.size()]);
    const double here = line.parameter_near(x);
    EXPECT_LE(glm::distance(x, line.at(here)), 1e-14);
    EXPECT_GT(line.way(here, line.parameter_near(next)), 0.0);
  }
}

struct Tank {
  double worst = 180.0;     // degrees: the smallest angle of all steps
  std::vector<Point> wall;  // in the end
};

Tank tank_after_its_run(bool wall_is_held) {
  const Scenario scenario = parse_scenario(tank, "tank.toml");
  kinemesh::SetUp made = set_up(scenario);
  StepperOptions options = stepper_options(scenario.repair, made.motion);
  EXPECT_FALSE(options.freedom.curve_of.empty());
  if (wall_is_held) options.freedom.curve_of.clear();
  Stepper stepper(made.mesh, options);
  Tank result;
  for (int n = 1; n <= 30; ++n) {
    const auto outcome = stepper.step_to(made.motion, scenario.time.time_after(n));
    if (!outcome) throw std::runtime_error(outcome.defect->message());
    result.worst = std::min(result.worst, outcome.record.min_angle_deg);
    expect_on_line_in_order(made.motion.freedom().lines().front(), stepper.mesh());
  }
  EXPECT_FALSE(validate(stepper.mesh()));
  for (const Vertex v : made.motion.freedom().lines().front().vertices())
    result.wall.push_back(stepper.mesh().position(v));
  return result;
}

TEST_F(BodyRuns, AnglesMoveVerticesAlongCurvedWalls) {
  const Tank free = tank_after_its_run(false), held = tank_after_its_run(true);
  EXPECT_GT(free.worst, 24.0);
  double farthest = 0.0;
  for (std::size_t i = 0; i < free.wall.size(); ++i)
    farthest = std::max(farthest, glm::distance(free.wall[i], held.wall[i]));
  EXPECT_GT(farthest, 1e-3);
}

TEST_F(BodyRuns, WithCurvedWallsGoOnToTheSameBits) {
  const Scenario scenario = parse_scenario(tank, folder_ / "tank.toml");
  ASSERT_FALSE(go(scenario, "whole").stopped);
  RunOptions options;
  options.directory = folder_ / "cut";
  options.resume = true;
  for (const int steps : {7, 9}) {
    StopAfter observer(steps);
    ASSERT_TRUE(kinemesh::run(scenario, options, observer).stopped);
  }
  ASSERT_FALSE(go(scenario, "cut", options).stopped);
  EXPECT_EQ(results_in(folder_ / "cut"), results_in(folder_ / "whole"));
}

// With what quality may move: bodies stay, the walls' vertices slide.
TEST_F(BodyRuns, StepsKeptInAFileAreRepeatedWithTheirQuality) {
  for (const Scenario& scenario : {load(), parse_scenario(tank, "tank.toml")}) {
    kinemesh::SetUp made = set_up(scenario);
    StepperOptions options = stepper_options(scenario.repair, made.motion);
    options.angle = 30.0;  // keeps quality busy
    Stepper stepper(made.mesh, options);
    int moves = 0;
    for (int n = 1; n <= 12; ++n) {
      const double end = scenario.time.time_after(n);
      FailedStep kept = failed_step(stepper, made.motion, end);
      kept.options = options;
      const std::string file = format_failed_step(kept);
      EXPECT_EQ(format_failed_step(parse_failed_step(file)), file);
      const StepOutcome again = replay(parse_failed_step(file)), once = stepper.step_to(made.motion, end);
      ASSERT_TRUE(once && again);
      EXPECT_EQ(again.record.repair.quality_flips, once.record.repair.quality_flips);
      EXPECT_EQ(again.record.repair.quality_moves, once.record.repair.quality_moves);
      EXPECT_EQ(again.record.min_angle_deg, once.record.min_angle_deg);
      EXPECT_EQ(again.record.min_area, once.record.min_area);
      moves += once.record.repair.quality_moves;
    }
    EXPECT_GT(moves, 0);
    EXPECT_FALSE(options.freedom.held.empty());
    EXPECT_FALSE(options.freedom.tangents.empty() && options.freedom.curve_of.empty());
  }
}

TEST_F(BodyRuns, LoadBackFromTheResolvedScenario) {
  const Scenario scenario = load({"interior.follow=elastic", "interior.stiffness.0=2.5"});
  const std::string text = to_toml(scenario);
  EXPECT_EQ(to_toml(parse_scenario(text, folder_ / "again.toml")), text);
  EXPECT_THAT(text, HasSubstr("follow = 'elastic'\nstiffness = {0 = 2.5}"));
  EXPECT_THAT(text, HasSubstr("quality = 'angles'\nangle = 25.0"));
}

TEST_F(BodyRuns, LoadBackWithAnInteriorThatStays) {
  const std::string text = to_toml(load({"interior.follow=none"}));
  EXPECT_THAT(text, HasSubstr("[interior]\nfollow = 'none'\n"));
  const Scenario again = parse_scenario(text, folder_ / "again.toml");
  EXPECT_EQ(again.interior.options.follow, Follow::None);
  EXPECT_EQ(to_toml(again), text);
}

// A step longer than the frame is deep: nothing inverts, a mesh exists, and it is found.
TEST_F(BodyRuns, AStepLongerThanTheFrameTakesItAlong) {
  const Scenario scenario = parse_scenario(
      "[mesh]\nshape = 'square'\nvertices = 300\n[[motion]]\nfield = 'shear'\nrate = 50.0\n"
      "[border]\ndefault = 'moving'\n[time]\ndt = 0.1\nsteps = 3\n",
      "shear.toml");
  auto made = set_up(scenario);
  Stepper stepper(made.mesh, stepper_options(scenario.repair, made.motion));
  for (int n = 1; n <= 3; ++n) ASSERT_TRUE(stepper.step_to(made.motion, scenario.time.time_after(n)));
  EXPECT_FALSE(validate(stepper.mesh()));
}

TEST_F(BodyRuns, AVertexThatHasCrossedABorderSaysWhich) {
  const Scenario scenario = parse_scenario(
      "[mesh]\nshape = 'annulus'\nvertices = 400\n[[motion]]\nfield = 'translate'\nvelocity = [1.0, 0.0]\n"
      "on = 'marker:inner'\n[time]\ndt = 0.2\nsteps = 10\n",
      "ring.toml");
  const RunSummary summary = go(scenario, "out");
  ASSERT_TRUE(summary.stopped);
  EXPECT_THAT(*summary.stopped, HasSubstr("it has crossed the border of marker \"inner\" near edge"));
  EXPECT_THAT(*summary.stopped, HasSubstr("[interior] follow"));
}

TEST(StepBorder, MovesTheBorderAndTheInteriorFollows) {
  Stepper stepper(build_mesh(test::grid_with_hole(8, 3, 5), {.frame = 0.25, .fixed = {}}),
                  {.quality = "angles"});
  std::vector<UserVertex> hole;
  const MeshData data = stepper.mesh().domain();
  for (const Marker& marker : data.markers)
    if (marker.name == "hole")
      for (const Edge& edge : marker.edges) hole.push_back(UserVertex(edge[0]));
  for (int n = 1; n <= 10; ++n) {
    std::vector<Point> places;
    for (const UserVertex v : hole) places.push_back(data.points[v] + Point(0.02 * n, 0.0));
    const auto outcome = stepper.step_border(hole, places, 0.1);
    ASSERT_TRUE(outcome) << outcome.defect->message();
    const auto now = stepper.mesh().user_positions();
    for (std::size_t i = 0; i < hole.size(); ++i) EXPECT_EQ(now[hole[i]], places[i]);
    EXPECT_EQ(now[0], data.points[0]);
    EXPECT_FALSE(validate(stepper.mesh()));
  }
  EXPECT_GT(stepper.mesh().user_positions()[2 * 9 + 2].x, data.points[2 * 9 + 2].x);
  const std::vector<UserVertex> twice{hole[0], hole[0]};
  EXPECT_THROW((void)stepper.step_border(twice, std::vector<Point>(2), 0.1), InputError);
  EXPECT_THROW((void)stepper.step_border(hole, std::vector<Point>(2), 0.1), InputError);
}

// Two neighbours inside, brought close: a face that angles and smooth would widen by moving them.
TEST(StepBorder, QualityLeavesNamedVerticesOfTheInteriorAlone) {
  for (const char* quality : {"angles", "smooth"}) {
    Stepper stepper(build_mesh(test::grid(8), {.frame = 0.25, .fixed = {}}), {.quality = quality});
    const std::vector<UserVertex> named{UserVertex(40), UserVertex(41)};
    const std::vector<Point> places{stepper.mesh().user_positions()[40] + Point(0.055, 0.0),
                                    stepper.mesh().user_positions()[41] - Point(0.055, 0.0)};
    const auto outcome = stepper.step_border(named, places, 0.1);
    ASSERT_TRUE(outcome) << outcome.defect->message();
    EXPECT_EQ(stepper.mesh().user_positions()[40], places[0]) << quality;
    EXPECT_EQ(stepper.mesh().user_positions()[41], places[1]) << quality;
    EXPECT_GT(outcome.record.repair.quality_moves, 0) << quality;
    ASSERT_TRUE(stepper.step(stepper.mesh().user_positions(), 0.1));  // names none
    if (quality == std::string("smooth")) {
      EXPECT_NE(stepper.mesh().user_positions()[41], places[1]);
    }
  }
}

}  // namespace
}  // namespace kinemesh
