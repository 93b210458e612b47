#include "kinemesh/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Line numbers of the errors below count from here.
const std::string smallest =
    "[mesh]\n"            // 1
    "shape = 'square'\n"  // 2
    "[[motion]]\n"        // 3
    "field = 'swirl'\n"   // 4
    "[time]\n"            // 5
    "dt = 0.1\n"          // 6
    "steps = 10\n";       // 7

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parse_scenario(text, "a.toml", overrides);
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Scenario, HasDefaultsForAllThatIsNotSaid) {
  const Scenario s = parse_scenario(smallest, "swirl/small.toml");
  EXPECT_EQ(s.name(), "small");
  EXPECT_EQ(s.mesh.shape, "square");
  EXPECT_EQ(s.mesh.vertices, 10000);
  EXPECT_EQ(s.mesh.seed, 1u);
  EXPECT_EQ(s.mesh.frame, 0.25);
  ASSERT_EQ(s.motions.size(), 1u);
  EXPECT_EQ(s.motions[0].on, std::vector<std::string>{"all"});
  EXPECT_FALSE(s.motions[0].blend);
  EXPECT_EQ(std::get<double>(s.motions[0].parameters.at("period")), 8.0);
  EXPECT_EQ(s.border.conditions.otherwise, BorderCondition::Fixed);
  EXPECT_EQ(s.time.steps, 10);
  EXPECT_EQ(s.time.end, 0.1 * 10);
  EXPECT_EQ(s.time.integrator, Integrator::Rk4);
  EXPECT_EQ(s.repair.strategy, "global");
  EXPECT_EQ(s.repair.quality, "none");
  EXPECT_FALSE(s.repair.allow_escaped);
  EXPECT_EQ(s.output.every, 10);
}

TEST(Scenario, ReadsWhatIsSaid) {
  const Scenario s = parse_scenario(R"(
[mesh]
file = "meshes/../wing.su2"
split_quads = true
frame = 0
[[motion]]
field = "rotation"
center = [0.248, 0]
rate = -6
on = "marker:airfoil"
blend = [0.6, 3]
[[motion]]
field = "jitter"
amplitude = 0.1
seed = 7
[border]
default = "slide"
farfield = "fixed"
airfoil = "moving"
[time]
end = 1
dt = 0.3
integrator = "heun"
[repair]
strategy = "remesh"
allow_escaped = true
[output]
every = 0
checkpoint = 0
)",
                                    "/somewhere/a.toml");
  EXPECT_EQ(s.mesh.file, "/somewhere/wing.su2");
  EXPECT_TRUE(s.mesh.split_quads);
  EXPECT_EQ(s.mesh.frame, 0.0);
  ASSERT_EQ(s.motions.size(), 2u);
  EXPECT_EQ(s.motions[0].on, std::vector<std::string>{"marker:airfoil"});
  EXPECT_EQ(s.motions[0].blend, (std::array{0.6, 3.0}));
  EXPECT_EQ(std::get<std::int64_t>(s.motions[0].parameters.at("rate")), -6);
  EXPECT_EQ(std::get<std::int64_t>(s.motions[1].parameters.at("seed")), 7);
  EXPECT_EQ(s.border.conditions.otherwise, BorderCondition::Slide);
  EXPECT_EQ(s.border.conditions.by_marker.at("farfield"), BorderCondition::Fixed);
  EXPECT_EQ(s.time.steps, 4);
  EXPECT_EQ(s.time.integrator, Integrator::Heun);
  EXPECT_EQ(s.repair.strategy, "remesh");
  EXPECT_TRUE(s.repair.allow_escaped);
  EXPECT_EQ(s.output.every, 0);
}

struct Mistake {
  const char* what;
  const char* from;
  const char* to;
  const char* message;
};

class ScenarioMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ScenarioMistake, IsNamedWithItsLine) {
  EXPECT_THAT(error_of(replaced(smallest, GetParam().from, GetParam().to)), StartsWith(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, ScenarioMistake,
    testing::Values(
        Mistake{"Syntax", "dt = 0.1", "dt = ", "a.toml:6: "},
        Mistake{"DoubledKey", "steps = 10", "dt = 0.2", "a.toml:7: "},
        Mistake{"UnknownSection", "[time]", "[tim]\n[time]",
                "a.toml:5: unknown key 'tim', did you mean 'time'?"},
        Mistake{"UnknownKey", "shape", "frme = 1\nshape",
                "a.toml:2: unknown key 'frme' in [mesh], did you mean 'frame'?"},
        Mistake{"FarKey", "steps = 10", "steps = 10\ncolour = 1",
                "a.toml:8: unknown key 'colour' in [time], expected one of: end, dt, steps, integrator, "
                "adaptive"},
        Mistake{"NoMesh", "[mesh]\nshape = 'square'\n", "", "a.toml:1: [mesh] expected"},
        Mistake{"EmptyMesh", "shape = 'square'\n", "", "a.toml:1: [mesh]: file or shape expected"},
        Mistake{"ShapeAndFile", "shape", "file = 'a.su2'\nshape", "a.toml:3: shape: belongs to a shape"},
        Mistake{"VerticesOfAFile", "shape = 'square'", "file = 'a.su2'\nvertices = 3",
                "a.toml:3: vertices: "},
        Mistake{"QuadsOfAShape", "shape", "split_quads = true\nshape",
                "a.toml:2: split_quads: belongs to a file"},
        Mistake{"EmptyFile", "shape = 'square'", "file = ''",
                "a.toml:2: file: the name of a mesh file expected"},
        Mistake{"NoText", "'square'", "3", "a.toml:2: shape: 3, a text in quotes expected"},
        Mistake{"UnknownShape", "'square'", "'sqare'",
                "a.toml:2: shape: unknown: 'sqare', did you mean 'square'?"},
        Mistake{"FewVertices", "shape", "vertices = 2\nshape", "a.toml:2: vertices: 2, an integer from 3 to"},
        Mistake{"VerticesNumber", "shape", "vertices = 1e3\nshape",
                "a.toml:2: vertices: 1000.0, an integer from"},
        Mistake{"NegativeSeed", "shape", "seed = -1\nshape",
                "a.toml:2: seed: -1, an integer from 0 on expected"},
        Mistake{"WrongK", "shape", "k = 2\nshape", "a.toml:2: k: belongs to the shape umbilic"},
        Mistake{"NegativeFrame", "shape", "frame = -1\nshape",
                "a.toml:2: frame: -1, a number not below 0 expected"},
        Mistake{"InfiniteFrame", "shape", "frame = inf\nshape",
                "a.toml:2: frame: inf, a finite number expected"},
        Mistake{"NoMotion", "[[motion]]\nfield = 'swirl'\n", "",
                "a.toml:1: at least one [[body]] or [[motion]] expected"},
        Mistake{"SingleMotion", "[[motion]]", "[motion]",
                "a.toml:3: motion: a table, a list of tables expected"},
        Mistake{"NoField", "field = 'swirl'", "", "a.toml:3: [[motion]]: field expected"},
        Mistake{"UnknownField", "'swirl'", "'swril'",
                "a.toml:4: field: unknown: 'swril', did you mean 'swirl'?"},
        Mistake{"UnknownParameter", "[time]", "rate = 3\n[time]",
                "a.toml:5: field \"swirl\": unknown parameter rate"},
        Mistake{"MissingParameter", "'swirl'", "'rotation'\nrate = 1",
                "a.toml:3: field \"rotation\": parameter center"},
        Mistake{"ParameterType", "[time]", "period = 'x'\n[time]",
                "a.toml:5: field \"swirl\": period = \"x\""},
        Mistake{"ParameterTable", "[time]", "period = {a = 1}\n[time]",
                "a.toml:5: period: a table, a finite number"},
        Mistake{"ParameterNan", "[time]", "period = nan\n[time]", "a.toml:5: period: nan, a finite number"},
        Mistake{"Formula", "'swirl'", "'expression'\nv = '0'\nu = 'x +'", "a.toml:6: "},
        Mistake{"On", "[time]", "on = 'nowhere'\n[time]", "a.toml:5: on = \"nowhere\": expected all"},
        Mistake{"Blend", "[time]", "on = 'label:0'\nblend = [2, 1]\n[time]", "a.toml:6: blend needs"},
        Mistake{"PointsOfThree", "[time]", "points = [[1, 2, 3]]\n[time]",
                "a.toml:5: points: a list, a finite"},
        Mistake{"BlendOfThree", "[time]", "blend = [0, 1, 2]\n[time]",
                "a.toml:5: blend: two distances expected"},
        Mistake{"Border", "[time]", "[border]\nleft = 'loose'\n[time]",
                "a.toml:6: border condition \"loose\""},
        Mistake{"BorderType", "[time]", "[border]\nleft = 1\n[time]",
                "a.toml:6: left: 1, a text in quotes expected"},
        Mistake{"NoTime", "[time]\ndt = 0.1\nsteps = 10\n", "", "a.toml:1: [time] expected"},
        Mistake{"OneTime", "steps = 10\n", "", "a.toml:5: [time]: two of end, dt and steps expected"},
        Mistake{"ThreeTimes", "dt", "end = 1\ndt", "a.toml:5: [time]: two of end, dt and steps expected"},
        Mistake{"NoStep", "10", "0", "a.toml:7: steps: 0, an integer from 1 to"},
        Mistake{"ZeroDt", "0.1", "0", "a.toml:6: dt: 0, a number above 0 expected"},
        Mistake{"InfiniteDt", "0.1", "inf", "a.toml:6: dt: inf, a finite number expected"},
        Mistake{"Adaptive", "steps = 10", "steps = 10\nadaptive = true", "a.toml:8: adaptive: true, a table"},
        Mistake{"AdaptiveKey", "steps = 10", "steps = 10\nadaptive = {min = 1}",
                "a.toml:8: unknown key 'min' in [time] adaptive"},
        Mistake{"AdaptiveShare", "steps = 10", "steps = 10\nadaptive = {max_region_share = 0}",
                "a.toml:8: max_region_share: 0, a number above 0 expected"},
        Mistake{"LongMinDt", "steps = 10", "steps = 10\nadaptive = {min_dt = 0.11}",
                "a.toml:8: min_dt: a number not above dt expected"},
        Mistake{"ShortMaxDt", "steps = 10", "steps = 10\nadaptive = {max_dt = 0.09}",
                "a.toml:8: max_dt: a number not below dt expected"},
        Mistake{"ShortMinDt", "steps = 10", "steps = 10\nadaptive = {min_dt = 1e-10}",
                "a.toml:8: min_dt: too short, it takes more than 2147483647 steps"},
        Mistake{"EndlessEnd", "0.1", "1e308", "a.toml:7: steps: steps times dt overflows"},
        Mistake{"TooShortDt", "steps = 10", "end = 1e300", "a.toml:6: dt: too short"},
        Mistake{"Integrator", "[time]", "[time]\nintegrator = 'rk5'", "a.toml:6: "},
        Mistake{"Strategy", "[time]", "[repair]\nstrategy = 'globl'\n[time]",
                "a.toml:6: strategy: unknown: 'globl', did you mean 'global'?"},
        Mistake{"Quality", "[time]", "[repair]\nquality = 'best'\n[time]",
                "a.toml:6: quality: unknown: 'best', expected one of: none, delaunay, smooth, angles"},
        Mistake{"AngleOfAnother", "[time]", "[repair]\nquality = 'delaunay'\nangle = 20\n[time]",
                "a.toml:7: angle: has a meaning with quality = 'angles' only"},
        Mistake{"AngleOfNone", "[time]", "[repair]\nangle = 20\n[time]",
                "a.toml:6: angle: has a meaning with quality = 'angles' only"},
        Mistake{"NoAngle", "[time]", "[repair]\nquality = 'angles'\nangle = 0\n[time]", "a.toml:7: angle: "},
        Mistake{"LargeAngle", "[time]", "[repair]\nquality = 'angles'\nangle = 60\n[time]",
                "a.toml:7: angle: degrees below 60 expected"},
        Mistake{"Escaped", "[time]", "[repair]\nallow_escaped = 1\n[time]",
                "a.toml:6: allow_escaped: 1, true or false expected"},
        Mistake{"Every", "[time]", "[output]\nevery = -1\n[time]",
                "a.toml:6: every: -1, an integer from 0 to"},
        Mistake{"Checkpoint", "[time]", "[output]\ncheckpoint = 'x'\n[time]",
                "a.toml:6: checkpoint: 'x', an integer"}),
    [](const auto& mistake) { return std::string(mistake.param.what); });

TEST(Scenario, HasAnAngleWithTheQualityThatWantsOne) {
  const auto scenario = [](const std::string& repair) {
    return parse_scenario(replaced(smallest, "[time]", "[repair]\n" + repair + "\n[time]"), "a.toml");
  };
  const Scenario given = scenario("quality = 'angles'\nangle = 20");
  EXPECT_EQ(given.repair.angle, 20.0);
  EXPECT_THAT(to_toml(given), testing::HasSubstr("quality = 'angles'\nangle = 20"));
  EXPECT_EQ(scenario("quality = 'angles'").repair.angle, 25.0);
  EXPECT_THAT(to_toml(scenario("quality = 'angles'")), testing::HasSubstr("angle = 25"));
  EXPECT_THAT(to_toml(scenario("quality = 'smooth'")), testing::Not(testing::HasSubstr("angle")));
}

TEST(Scenario, NamesAFileThatIsNotThere) {
  try {
    (void)load_scenario("/no/such/scenario.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/scenario.toml"));
  }
}

TEST(Scenario, IsReadFromItsFileAndItsMeshFoundBesideIt) {
  const test::TemporaryFolder folder;
  folder.write("a.toml", replaced(smallest, "shape = 'square'", "file = 'mesh.off'"));
  const Scenario s = load_scenario(folder / "a.toml");
  EXPECT_EQ(s.mesh.file, folder / "mesh.off");
}

TEST(Scenario, OfAMeshThatIsThereSaysWhatMovesAndNoMore) {
  const std::string body = "[[body]]\non = 'marker:hole'\n";
  const Scenario scenario = parse_motions(body + "[border]\ndefault = 'slide'\n", "mine");
  ASSERT_EQ(scenario.bodies.size(), 1u);
  EXPECT_EQ(scenario.interior.options.follow, Follow::Harmonic);
  EXPECT_EQ(scenario.repair.quality, "angles");
  EXPECT_EQ(scenario.border.conditions.otherwise, BorderCondition::Slide);
  EXPECT_TRUE(scenario.mesh.file.empty() && scenario.mesh.shape.empty());
  for (const std::string table : {"mesh", "time", "output"}) {
    try {
      parse_motions(body + "[" + table + "]\n", "mine");
      ADD_FAILURE() << table;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("mine:3: " + table + ": "));
    }
  }
}

// Written out, read back and written out again: the same text, so the same run.
TEST(Scenario, SurvivesBeingWrittenOut) {
  const std::string all =
      "[mesh]\nshape = 'umbilic'\nk = 3\nvertices = 77\nseed = 9\nframe = 0.1\n"
      "[[motion]]\nfield = 'rotation'\ncenter = [0.1, 1e-17]\nrate = 0.30000000000000004\n"
      "on = 'disc:[0,0,1]'\nblend = [0.1, 0.7]\n"
      "[[motion]]\nfield = 'expression'\nu = 'sin(x)*\"2\"'\nv = '0'\n"
      "[[motion]]\nfield = 'vortices'\npoints = [[1, 0.1], [2, -0.0]]\nstrengths = [1, 1e-17]\ncore = 1\n"
      "[border]\ndefault = 'slide'\n'a marker.with \"odd\" name' = 'moving'\n"
      "[time]\nend = 1\ndt = 0.3\nintegrator = 'euler'\n[repair]\nallow_escaped = true\n[output]\nevery = "
      "3\n";
  for (const std::string& text :
       {smallest, replaced(all, "*\"2\"", ""), replaced(smallest, "dt = 0.1", "end = 0.7")}) {
    const Scenario one = parse_scenario(text, "/x/a.toml");
    const std::string written = to_toml(one);
    const Scenario two = parse_scenario(written, "/elsewhere/scenario.toml");
    EXPECT_EQ(to_toml(two), written);
    EXPECT_EQ(two.time.dt, one.time.dt);
    EXPECT_EQ(two.motions[0].blend, one.motions[0].blend);
    EXPECT_EQ(two.border.conditions.by_marker, one.border.conditions.by_marker);
  }
}

// All that is Unicode may be in a name.
TEST(Scenario, SurvivesBeingWrittenOutWhateverItsNames) {
  std::vector<std::string> names{"",       "=",   " = ", "a.b",     "[x]",  "#",
                                 "\"\"\"", "'''", "\\t", "\\u0041", "\r\n", "'\\"};
  for (char c = 0; c >= 0 && c < 127; ++c) names.emplace_back(1, c);
  names.emplace_back("\x7f");
  for (const char* other : {"\xc2\x85", "\xe2\x80\xa8", "\xef\xbb\xbf", "\xf0\x9f\x98\x80", "\xc3\xa4"})
    names.emplace_back(other);
  const std::vector<std::string> parts = names;
  std::mt19937 random(7);
  for (int n = 0; n < 500; ++n) {
    std::string name;
    for (int i = 0; i < 5; ++i) name += parts[random() % parts.size()];
    names.push_back(name);
  }
  for (const std::string& name : names) {
    Scenario one = parse_scenario(smallest + "[[body]]\non = 'marker:a'\n", "/x/a.toml");
    if (name != "default") one.border.conditions.by_marker[name] = BorderCondition::Slide;
    one.bodies[0].on = {"marker:" + name, name};
    one.motions[0].on = {"marker:m" + name};
    one.mesh.shape.clear();
    one.mesh.file = "/y/m" + name;
    const std::string written = to_toml(one);
    const Scenario two = parse_scenario(written, "/elsewhere/scenario.toml");
    EXPECT_EQ(two.border.conditions.by_marker, one.border.conditions.by_marker) << written;
    EXPECT_EQ(two.bodies[0].on, one.bodies[0].on) << written;
    EXPECT_EQ(two.motions[0].on, one.motions[0].on) << written;
    EXPECT_EQ(two.mesh.file, one.mesh.file.lexically_normal()) << written;
  }
}

TEST(Scenario, WritesAdaptiveStepsOut) {
  const Scenario one = parse_scenario(smallest + "adaptive = {max_region_share = 0.3}\n", "a.toml");
  ASSERT_TRUE(one.time.adaptive);
  EXPECT_EQ(one.time.adaptive->min_dt, 0.1 / 1024);
  EXPECT_EQ(one.time.adaptive->max_dt, 0.1);
  const Scenario two = parse_scenario(to_toml(one), "a.toml");
  ASSERT_TRUE(two.time.adaptive);
  EXPECT_EQ(two.time.adaptive->max_region_share, 0.3);
  EXPECT_EQ(two.time.adaptive->min_dt, one.time.adaptive->min_dt);
  EXPECT_EQ(two.time.adaptive->max_dt, 0.1);
  const auto any = parse_scenario(smallest + "adaptive = {max_dt = 1}\n", "a.toml").time.adaptive;
  EXPECT_FALSE(any->max_region_share);
  EXPECT_EQ(any->max_dt, 1.0);
}

TEST(Scenario, IsWrittenWithAbsolutePathsAndDefaults) {
  const std::string text =
      to_toml(parse_scenario(replaced(smallest, "shape = 'square'", "file = '../m.su2'"), "/x/y/a.toml"));
  EXPECT_THAT(text, HasSubstr("file = '/x/m.su2'\nsplit_quads = false\n"));
  EXPECT_THAT(text, HasSubstr("period = 8.0"));
  EXPECT_THAT(text, HasSubstr("integrator = 'rk4'"));
  EXPECT_THAT(text, HasSubstr("frame = 0.25"));
  EXPECT_THAT(text, HasSubstr("dt = 0.1\n"));
}

}  // namespace
}  // namespace kinemesh
