#include "motion/fields/recorded.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>

#include "kinemesh/motion.h"
#include "kinemesh/vtu.h"
#include "motion/restriction.h"
#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

// Of this test alone, as tests run side by side; removed at the end.
class RecordedPositionsTest : public testing::Test {
 public:
  void SetUp() override { std::filesystem::create_directories(folder()); }
  void TearDown() override { std::filesystem::remove_all(folder()); }

  static std::filesystem::path folder() {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return std::filesystem::path(testing::TempDir()) / ("recorded_" + test + std::to_string(getpid()));
  }
};

std::filesystem::path file_with(const std::string& name, const std::string& content) {
  const auto path = RecordedPositionsTest::folder() / name;
  std::ofstream(path) << content;
  return path;
}

const std::string two_times =
    "time,vertex,x,y\n"  // line 1
    "1,0,0,0\n"
    "1,1,1,0\n"
    "# half a time later\n"
    "1.5,0,0.5,-1\n"  // 5
    "1.5,1,3,4\n";

TEST_F(RecordedPositionsTest, AreLinearBetweenTheTimesOfATable) {
  const RecordedPositions record(file_with("two_times.csv", two_times));
  EXPECT_EQ(record.times(), (std::vector{1.0, 1.5}));
  EXPECT_EQ(record.displacement({0.0, 0.0}, 1.0), Point(0.0, 0.0));
  EXPECT_EQ(record.displacement({1.0, 0.0}, 1.0), Point(0.0, 0.0));
  EXPECT_EQ(record.displacement({0.0, 0.0}, 1.25), Point(0.25, -0.5));
  EXPECT_EQ(record.displacement({1.0, -0.0}, 1.125), Point(0.5, 1.0));
  EXPECT_EQ(record.displacement({1.0, 0.0}, 1.5), Point(2.0, 4.0));
  EXPECT_TRUE(std::isnan(record.displacement({0.5, 0.0}, 1.0).x));  // no vertex
  EXPECT_TRUE(std::isnan(record.displacement({1.0, 0.0}, 0.9).x));
  EXPECT_TRUE(std::isnan(record.displacement({1.0, 0.0}, 1.6).x));
}

TEST_F(RecordedPositionsTest, MayBeOfSomeVerticesUnderTheirNumbers) {
  const RecordedPositions record(
      file_with("some.csv", "time,vertex,x,y\n0,3,0,0\n0,7,1,0\n1,3,0,1\n1,7,1,2\n"));
  EXPECT_EQ(record.displacement({1.0, 0.0}, 1.0), Point(0.0, 2.0));
  EXPECT_NO_THROW(record.require_all(std::vector{Point(1.0, 0.0), Point(0.0, 0.0)}));
}

template <class F>
std::string error_of(const F& f) {
  try {
    f();
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string error_in_table(const std::string& content) {
  return error_of([&] { RecordedPositions(file_with("wrong.csv", content)); });
}

TEST_F(RecordedPositionsTest, NameTheLineOfATableThatIsWrong) {
  const std::string first = "time,vertex,x,y\n0,0,0,0\n0,1,1,0\n";
  EXPECT_THAT(error_in_table(""), HasSubstr("wrong.csv:1: "));
  EXPECT_THAT(error_in_table("0,0,0,0\n"), EndsWith("wrong.csv:1: the header time,vertex,x,y expected"));
  EXPECT_THAT(error_in_table("time,vertex,x,y\n"), HasSubstr("at least one time expected"));
  EXPECT_THAT(error_in_table(first + "0,1,1,0\n"),
              EndsWith("wrong.csv:4: vertex 1, ascending numbers from 0 on expected"));
  EXPECT_THAT(error_in_table(first + "1,0,1,0\n1,3,1,0\n"),
              EndsWith("wrong.csv:5: vertex 3, expected 1 as at the first time"));
  EXPECT_THAT(error_in_table(first + "0.5,2,1,0\n"),
              EndsWith("wrong.csv:4: time 0.5, expected 0 as of vertex 0"));
  EXPECT_THAT(error_in_table(first + "0,0,1,0\n"),
              EndsWith("wrong.csv:4: time 0 after 0, ascending times expected"));
  EXPECT_THAT(error_in_table(first + "1,0,1,0\n2,0,1,0\n"),
              EndsWith("wrong.csv:5: 1 vertices at time 1, expected 2 as at the first time"));
  EXPECT_THAT(error_in_table(first + "1,0,1,0\n"),
              EndsWith("1 vertices at time 1, expected 2 as at the first time"));
  EXPECT_THAT(error_in_table(first + "1,0,1,0\n1,1,1,0\n1,2,1,0\n"),
              EndsWith("wrong.csv:6: vertex 2, but the first time has 2 vertices"));
  EXPECT_THAT(error_in_table("time,vertex,x,y\n0,0,1,0\n0,1,1,0\n"),
              EndsWith("wrong.csv: vertices 0 and 1 begin at the same place"));
  EXPECT_THAT(error_in_table(first + "1,0,1\n"), HasSubstr("wrong.csv:4: "));
  EXPECT_THAT(error_in_table(first + "1,0,1,0,7\n"), HasSubstr("wrong.csv:4: "));
  EXPECT_THAT(error_in_table(first + "1,0,nan,0\n"), HasSubstr("wrong.csv:4: "));
}

TEST_F(RecordedPositionsTest, NameAFileThatCannotBeRead) {
  EXPECT_THAT(error_of([] { RecordedPositions("/no/such/file.csv"); }), HasSubstr("/no/such/file.csv"));
  EXPECT_THAT(error_of([] { RecordedPositions("/no/such/file.pvd"); }), HasSubstr("/no/such/file.pvd"));
  EXPECT_THAT(
      error_of([] { RecordedPositions("positions.txt"); }),
      HasSubstr("positions.txt: a record of positions is a table (.csv) or a series of meshes (.pvd)"));
}

// Meshes of a grid, grown by 1 each time.
std::filesystem::path series(const std::vector<double>& times, int n_last = 2) {
  const auto folder = RecordedPositionsTest::folder();
  std::vector<PvdEntry> entries;
  for (const double time : times) {
    const double scale = 1.0 + static_cast<double>(entries.size());
    const MeshData mesh =
        test::mapped(test::grid(time == times.back() ? n_last : 2), [&](Point p) { return scale * p; });
    entries.push_back({time, "grown_" + std::to_string(entries.size()) + ".vtu"});
    write_vtu(folder / entries.back().file, mesh);
  }
  write_pvd(folder / "grown.pvd", entries);
  return folder / "grown.pvd";
}

TEST_F(RecordedPositionsTest, AreLinearBetweenTheMeshesOfASeries) {
  const RecordedPositions record(series({0.0, 0.5, 2.5}));
  EXPECT_EQ(record.times(), (std::vector{0.0, 0.5, 2.5}));
  EXPECT_EQ(record.displacement({1.0, 1.0}, 0.25), Point(0.5, 0.5));
  EXPECT_EQ(record.displacement({1.0, 1.0}, 0.5), Point(1.0, 1.0));
  EXPECT_EQ(record.displacement({1.0, 1.0}, 1.0), Point(1.25, 1.25));
  EXPECT_EQ(record.displacement({1.0, 0.0}, 2.5), Point(2.0, 0.0));
}

TEST_F(RecordedPositionsTest, NameTheLineOrMeshOfASeriesThatIsWrong) {
  EXPECT_THAT(error_of([] {
                RecordedPositions(series({0.0, 0.5}, 3));
              }),
              HasSubstr("grown_1.vtu: 16 vertices, expected 9 as at the first time of "));
  EXPECT_THAT(error_of([] {
                RecordedPositions(series({0.0, 0.5, 0.5}));
              }),
              HasSubstr("grown.pvd:6: timestep '0.5', later than that of the DataSet before expected"));
  const auto error_in_series = [](const std::string& content) {
    return error_of([&] { RecordedPositions(file_with("wrong.pvd", content)); });
  };
  EXPECT_THAT(error_in_series("<VTKFile>\n<Collection"), HasSubstr("wrong.pvd:2: not well-formed XML"));
  EXPECT_THAT(error_in_series("<html/>"), HasSubstr("wrong.pvd: no Collection"));
  EXPECT_THAT(error_in_series("<VTKFile>\n<Collection/></VTKFile>"), HasSubstr("wrong.pvd:2: at least one"));
  EXPECT_THAT(error_in_series("<VTKFile><Collection>\n<DataSet file='a.vtu'/></Collection></VTKFile>"),
              HasSubstr("wrong.pvd:2: "));
  EXPECT_THAT(error_in_series("<VTKFile><Collection>\n<DataSet timestep='0'/></Collection></VTKFile>"),
              HasSubstr("wrong.pvd:2: a DataSet without file"));
  EXPECT_THAT(
      error_in_series("<VTKFile><Collection><DataSet timestep='0' file='none.vtu'/></Collection></VTKFile>"),
      HasSubstr("none.vtu"));
}

TEST_F(RecordedPositionsTest, ReadAFileThatIsNamedOftenOnce) {
  constexpr int n = 50'000;
  const auto folder = RecordedPositionsTest::folder();
  write_vtu(folder / "a.vtu", test::grid(40));
  std::vector<PvdEntry> entries;
  for (int i = 0; i < n; ++i)
    entries.push_back({1.0 * i, i % 3 == 0 ? "a.vtu" : i % 3 == 1 ? "./a.vtu" : "././a.vtu"});
  write_pvd(folder / "often.pvd", entries);
  const auto before = std::chrono::steady_clock::now();
  const RecordedPositions record(folder / "often.pvd");
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
  EXPECT_EQ(record.times().size(), std::size_t{n});
  EXPECT_EQ(record.displacement({1.0, 1.0}, 123.5), Point(0.0, 0.0));
}

Motion recorded_motion(const Mesh& mesh, const std::filesystem::path& file, const char* on = "all") {
  return Motion(mesh, {{std::make_shared<RecordedPositions>(file), parse_restriction(on)}},
                {BorderCondition::Moving, {}});
}

TEST_F(RecordedPositionsTest, MoveTheVerticesThatAMotionNames) {
  const Mesh mesh = build_mesh(test::grid(2), {.frame = 5.0, .fixed = {}});
  const auto x0 = mesh.positions();
  std::vector<Point> x1(x0.begin(), x0.end());
  recorded_motion(mesh, series({0.0, 0.5, 2.5})).advance(x0, 0.0, 0.5, 0, x1);
  for (const Vertex v : mesh.vertices()) EXPECT_EQ(x1[v], mesh.user_vertex(v) == none ? x0[v] : 2.0 * x0[v]);
  recorded_motion(mesh, series({0.0, 0.5, 2.5}), "disc:[1,1,0.1]").advance(x0, 0.0, 0.5, 0, x1);
  for (const Vertex v : mesh.vertices()) EXPECT_EQ(x1[v], x0[v] == Point(1.0, 1.0) ? Point(2.0, 2.0) : x0[v]);
}

TEST_F(RecordedPositionsTest, NameWhatDoesNotFitARun) {
  const RecordedPositions record(series({0.5, 0.8}));
  EXPECT_NO_THROW(record.require_times(0.5, 0.8));
  EXPECT_THAT(error_of([&] { record.require_times(0.4, 0.6); }),
              HasSubstr("grown.pvd: positions from time 0.5 to 0.8, but needed from 0.4 to 0.6"));
  EXPECT_THAT(error_of([&] { record.require_times(0.5, 0.9); }), HasSubstr("but needed from 0.5 to 0.9"));
  auto points = test::grid(2).points;
  EXPECT_NO_THROW(record.require_initial(points));
  points[4].x += 0.125;
  EXPECT_THAT(error_of([&] { record.require_initial(points); }),
              HasSubstr("grown.pvd: vertex 4 begins at (0.5, 0.5), expected (0.625, 0.5) as in the mesh"));
  EXPECT_THAT(error_of([&] { record.require_initial(test::grid(3).points); }),
              HasSubstr("grown.pvd: 9 vertices, expected 16 as in the mesh"));
}

TEST_F(RecordedPositionsTest, AreBlamedForAStepOutsideTheRecord) {
  const Mesh mesh = build_mesh(test::grid(2), {.frame = 5.0, .fixed = {}});
  const auto x0 = mesh.positions();
  std::vector<Point> x1(x0.begin(), x0.end());
  const Motion motion = recorded_motion(mesh, series({0.0, 0.5}));
  motion.advance(x0, 0.4, 0.2, 0, x1);
  const Vertex v = mesh.vertex_of_user(UserVertex(8));
  EXPECT_TRUE(std::isnan(x1[v].x));
  EXPECT_EQ(motion.describe_non_finite(v, x0, {0.4, 0.6, 0.2, 0}),
            "field \"recorded\" gives (nan, nan) at (1, 1), time 0.4");
}

}  // namespace
}  // namespace kinemesh
