#include "motion/fields/sampled_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "kinemesh/error.h"
#include "kinemesh/registry.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;

// What is bilinear in space and linear in time is met exactly, apart from rounding.
Point bilinear(double t, double x, double y) {
  return {1.0 + 2.0 * x - y + 0.5 * x * y + t * (x - 3.0 * y), (1.0 - 2.0 * t) * (0.25 + x * y)};
}

std::string table(std::vector<double> ts, std::vector<double> xs, std::vector<double> ys, unsigned shuffle) {
  std::vector<std::string> rows;
  for (const double t : ts)
    for (const double x : xs)
      for (const double y : ys) {
        std::ostringstream row;
        row.precision(17);
        const Point v = bilinear(t, x, y);
        row << t << ',' << x << ',' << y << ',' << v.x << ", " << v.y << '\n';
        rows.push_back(row.str());
      }
  std::shuffle(rows.begin(), rows.end(), std::mt19937(shuffle));
  std::string text = "# a test\nt,x,y,u,v\n";
  for (const auto& row : rows) text += row;
  return text;
}

std::string error_of(const std::string& text) {
  try {
    (void)parse_grid(text, "v.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SampledGrid, MeetsBilinearVelocitiesExactlyInAnyOrderOfRows) {
  const SampledGrid a(parse_grid(table({0, 0.5, 2}, {-1, 0, 0.3, 4}, {0, 1, 1.5}, 1), "v.csv"));
  const SampledGrid b(parse_grid(table({0, 0.5, 2}, {-1, 0, 0.3, 4}, {0, 1, 1.5}, 2), "v.csv"));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> time(0, 2), across(-1, 4), up(0, 1.5);
  for (int i = 0; i < 2000; ++i) {
    const double t = time(random), x = across(random), y = up(random);
    const Point v = a.velocity({x, y}, t), expected = bilinear(t, x, y);
    EXPECT_NEAR(v.x, expected.x, 1e-13);
    EXPECT_NEAR(v.y, expected.y, 1e-13);
    EXPECT_EQ(v, b.velocity({x, y}, t));
  }
}

TEST(SampledGrid, GivesTheSamplesThemselvesAndHoldsThemOutside) {
  const SampledGrid grid(parse_grid(table({0, 1}, {0, 1, 3}, {0, 2}, 4), "v.csv"));
  for (const double t : {0.0, 1.0})
    for (const double x : {0.0, 1.0, 3.0})
      for (const double y : {0.0, 2.0}) EXPECT_EQ(grid.velocity({x, y}, t), bilinear(t, x, y));
  EXPECT_EQ(grid.velocity({-5.0, 1e300}, -1.0), bilinear(0.0, 0.0, 2.0));
  EXPECT_EQ(grid.velocity({9.0, -2.0}, 7.0), bilinear(1.0, 3.0, 0.0));
}

TEST(SampledGrid, SteadyRowsBlanksAndNoNames) {
  const SampledGrid grid(parse_grid("0 0  1 2\r\n1 0\t3 2 # right\n\n0 1 1 4\n1 1 3 4\n", "v.csv"));
  EXPECT_EQ(grid.velocity({0.5, 0.5}, 17.0), Point(2.0, 3.0));
  EXPECT_EQ(SampledGrid(parse_grid("x,y,u,v\n0,0,1,2\n", "v")).velocity({3.0, 4.0}, 5.0), Point(1.0, 2.0));
}

TEST(SampledGrid, RefusesWhatIsNoGridAndSaysWhere) {
  EXPECT_THAT(error_of(""), HasSubstr("v.csv: no samples"));
  EXPECT_THAT(error_of("t,x,y,u,v\n"), HasSubstr("no samples"));
  EXPECT_THAT(error_of("x,y,t,u,v\n0,0,0,0,0\n"),
              HasSubstr("v.csv:1: the names t,x,y,u,v or x,y,u,v expected"));
  EXPECT_THAT(error_of("0,0,1\n"), HasSubstr("v.csv:1: 3 numbers, t,x,y,u,v or x,y,u,v expected"));
  EXPECT_THAT(error_of("0,0,1,1\n0,1,1,1,1\n"), HasSubstr("v.csv:2: 5 numbers, 4"));
  EXPECT_THAT(error_of("0,0,0,1,1\n0,0,1,1\n"), HasSubstr("v.csv:2: 4 numbers, 5"));
  EXPECT_THAT(error_of("0,0,0,1,1,1\n"), HasSubstr("v.csv:1: unexpected '1'"));
  EXPECT_THAT(error_of("0,0,1,1\n0,1,one,1\n"), HasSubstr("v.csv:2: 'one' is not a number"));
  EXPECT_THAT(error_of("0,0,1,1\n0,1,nan,1\n"), HasSubstr("v.csv:2: 'nan'"));
  EXPECT_THAT(error_of("0,0,1,1\n0,1,1e999,1\n"), HasSubstr("v.csv:2: '1e999'"));
  EXPECT_THAT(error_of("0,0,1,1\n1,0,1,1\n\n0,0,2,2\n"),
              HasSubstr("v.csv:4: a second sample at x = 0, y = 0, the first is in line 1"));
  EXPECT_THAT(
      error_of("0,0,1,1\n1,0,1,1\n0,1,2,2\n"),
      HasSubstr("v.csv: no sample at x = 1, y = 1; all combinations of 1 times, 2 x and 2 y expected"));
  EXPECT_THAT(error_of("0,0,0,1,1\n1,1,0,1,1\n"), HasSubstr("no sample at t = 0, x = 1, y = 0"));
}

TEST(SampledGrid, IsAFieldByName) {
  const auto file = std::filesystem::path(testing::TempDir()) / "kinemesh_grid_test.csv";
  std::ofstream(file) << "0,0,1,2\n1,0,3,2\n";
  const auto field = make_field("grid", {{"file", file.string()}});
  EXPECT_EQ(std::get<0>(field)->velocity({0.5, 0.0}, 0.0), Point(2.0, 2.0));
  std::filesystem::remove(file);
  EXPECT_THROW((void)make_field("grid", {{"file", file.string()}}), InputError);
  EXPECT_THROW((void)make_field("grid", {{"file", std::string()}}), ParameterError);
}

}  // namespace
}  // namespace kinemesh
