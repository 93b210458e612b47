// Strategies side by side, as the program compares them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "program.h"

namespace kinemesh::testing {
namespace {

const char* const jitter =
    "[mesh]\nshape = \"square\"\nvertices = 300\n[[motion]]\nfield = \"jitter\"\namplitude = 0.4\n"
    "[time]\ndt = 1.0\nsteps = 3\n";

class Bench : public ProgramTest {
 protected:
  // Rows by the names in the first line.
  std::vector<std::map<std::string, std::string>> table(const std::string& file) const {
    const auto lines = lines_of(read_text(path(file)));
    const auto names = fields_of(lines.at(0));
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const auto fields = fields_of(lines[i]);
      EXPECT_EQ(fields.size(), names.size()) << lines[i];
      auto& row = rows.emplace_back();
      for (std::size_t j = 0; j < std::min(names.size(), fields.size()); ++j) row[names[j]] = fields[j];
    }
    return rows;
  }

 private:
  static std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
  }
};

TEST_F(Bench, GivesEachStrategyTheSamePositions) {
  write("s.toml", jitter);
  const Result result = run({"bench", "s.toml", "--strategies", "global,local,remesh,auto", "-o", "out"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const auto& line : lines_of(result.out)) EXPECT_LE(line.size(), 100u) << line;
  const auto rows = table("out/bench.csv");
  ASSERT_EQ(rows.size(), 12u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("accepted"), "1");
    const bool replaces_all = std::stoi(row.at("replaced")) > std::stoi(row.at("faces"));  // padding, too
    EXPECT_TRUE(row.at("strategy") == "auto" || (row.at("strategy") == "remesh") == replaces_all);
    const bool is_first = row.at("step") == "1";
    EXPECT_TRUE(!is_first || row.at("inverted") == rows[0].at("inverted"));
  }
  EXPECT_GT(std::stoi(rows[0].at("inverted")), 5);
  std::size_t n_regions = 0;
  for (const auto& row : rows) n_regions += std::stoul(row.at("regions"));
  EXPECT_EQ(table("out/bench_regions.csv").size(), n_regions);
}

TEST_F(Bench, IsWhatARunOfEachStrategyIs) {
  write("s.toml", jitter);
  ASSERT_EQ(run({"bench", "s.toml", "--strategies", "local,global", "-o", "out"}).code, 0);
  const auto rows = table("out/bench.csv");
  for (const std::string strategy : {"global", "local"}) {
    ASSERT_EQ(run({"run", "s.toml", "-q", "-o", strategy, "--set", "repair.strategy=" + strategy}).code, 0);
    const auto steps = table(strategy + "/steps.csv");
    ASSERT_EQ(steps.size(), 3u);
    for (const auto& row : rows) {
      if (row.at("strategy") != strategy) continue;
      for (const auto& [name, value] : steps[std::stoul(row.at("step")) - 1])
        EXPECT_TRUE(name.ends_with("_ms") || row.at(name) == value) << strategy << " " << name;
    }
  }
}

TEST_F(Bench, SweepsAKeyOfTheScenario) {
  write("s.toml", jitter);
  const Result result = run(
      {"bench", "s.toml", "--strategies", "global", "--sweep", "motion.0.amplitude=0.01,0.5", "-o", "out"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = table("out/bench.csv");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].at("motion.0.amplitude"), "0.01");
  EXPECT_EQ(rows[5].at("motion.0.amplitude"), "0.5");
  EXPECT_LT(std::stoi(rows[0].at("inverted")), std::stoi(rows[3].at("inverted")));
}

TEST_F(Bench, DrawsWhatItMeasures) {
  write("s.toml", jitter);
  const Result result = run({"bench", "s.toml", "--strategies", "global,local,remesh", "--bound", "--sweep",
                             "motion.0.amplitude=0.1,0.5", "-o", "out"});
  ASSERT_EQ(result.code, 0) << result.err;
  const bool has_gnuplot = std::system("gnuplot --version > /dev/null 2>&1") == 0;
  for (const std::string name : {"sweep", "sizes", "explored", "bound"}) {
    EXPECT_THAT(read_text(path("out/plots/" + name + ".gp")), ::testing::HasSubstr("$curve0 << end\n"))
        << name;
    EXPECT_EQ(std::filesystem::exists(path("out/plots/" + name + ".svg")), has_gnuplot) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(path("out/plots/steps.gp")));
  const auto samples = table("out/bench_bound.csv");
  ASSERT_GT(samples.size(), 20u);
  for (const auto& row : samples) {
    EXPECT_EQ(std::stoi(row.at("faces")), std::stoi(row.at("upright")) + std::stoi(row.at("inverted")));
    EXPECT_GE(std::stoi(row.at("depth")), 2);  // something lies over the inverted faces
    EXPECT_GT(std::stod(row.at("bound")), 0.0);
  }
  ASSERT_EQ(run({"bench", "s.toml", "--strategies", "global", "--force", "-o", "out"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("out/plots/steps.gp")));
  EXPECT_FALSE(std::filesystem::exists(path("out/plots/bound.gp")));
  EXPECT_FALSE(std::filesystem::exists(path("out/bench_bound.csv")));
}

TEST_F(Bench, StopsWhereThereIsNoValidMesh) {
  write("s.toml",
        "[mesh]\nshape = \"annulus\"\nvertices = 300\n[[motion]]\nfield = \"translate\"\nvelocity = [1.0, "
        "0.0]\n"
        "on = \"marker:inner\"\n[border]\nouter = \"fixed\"\n[time]\ndt = 0.7\nsteps = 2\n");
  const Result result = run({"bench", "s.toml", "--strategies", "global,remesh", "-o", "out"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
  for (const char* part : {"s.toml: global: step 1 ", "; remesh: step 1 "})
    EXPECT_THAT(result.err, ::testing::HasSubstr(part));
  const auto rows = table("out/bench.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) EXPECT_EQ(row.at("accepted"), "0");
}

TEST_F(Bench, NamesTheScenarioWhereBodiesDisagree) {
  write("s.toml",
        "[mesh]\nshape = 'square'\nvertices = 100\n[[body]]\non = 'marker:left'\n[[body]]\non = "
        "'marker:bottom'\n"
        "motion = [{field = 'rigid', x = 't'}]\n[time]\ndt = 0.1\nsteps = 2\n");
  const Result result = run({"bench", "s.toml", "--strategies", "global", "-o", "out"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, ::testing::HasSubstr("s.toml: bodies marker:left and marker:bottom share"));
}

TEST_F(Bench, RefusesWhatItCannotDo) {
  write("s.toml", jitter);
  expect_error(run({"bench", "s.toml", "--strategies", "global,best"}), 2, {"best", "global"});
  expect_error(run({"bench", "s.toml", "--strategies", "global,global"}), 2, {"global", "twice"});
  expect_error(run({"bench", "s.toml", "--strategies", "global", "--sweep", "amplitude"}), 2,
               {"--sweep", "key=value"});
  expect_error(run({"bench", "s.toml", "--strategies", "global", "--sweep", "motion.0.amplitude=1,,2"}), 2,
               {"--sweep"});
  expect_error(run({"bench", "s.toml", "--strategies", "global", "--sweep", "motion.0.size=1"}), 2, {"size"});
  EXPECT_EQ(files(), std::vector<std::string>{"s.toml"});
  ASSERT_EQ(run({"bench", "s.toml", "--strategies", "global"}).code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"s-bench", "s.toml"}));
  expect_error(run({"bench", "s.toml", "--strategies", "global"}), 2, {"s-bench", "--force"});
  ASSERT_EQ(run({"report", "s-bench"}).code, 0);
  EXPECT_EQ(run({"bench", "s.toml", "--strategies", "global", "--force"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("s-bench/report.html")));
}

}  // namespace
}  // namespace kinemesh::testing
