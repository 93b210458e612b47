// patches.bin holds every step of a run: replayed, it gives the meshes that the run wrote.
#include "sim/run/patches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cstring>
#include <limits>
#include <map>

#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "sim/run/binary.h"
#include "tests/sim/helpers.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;

Scenario scenario(const std::string& motion, const std::string& rest) {
  return parse_scenario("[mesh]\nshape = 'square'\nvertices = 150\n" + motion +
                            "[time]\ndt = 0.05\nsteps = 8\n[output]\nevery = 1\npatches = true\n" + rest,
                        "s.toml");
}

const std::string rotor = "[[motion]]\nfield = 'rotor'\ncenter = [0.5, 0.5]\nradius = 0.33\nrate = 6\n";
const std::string jitter = "[[motion]]\nfield = 'jitter'\namplitude = 0.4\n";

// Applies steps one after the other, checking that each `before` is what is there.
struct Replay {
  explicit Replay(const PatchesStart& start) : points(start.points) {
    for (std::size_t f = 0; f < start.triangles.size(); ++f) faces[f] = {start.triangles[f], start.labels[f]};
  }

  void apply(const PatchesStep& step) {
    if (step.moved.empty() && !step.positions.empty()) points = step.positions;
    for (std::size_t i = 0; i < step.moved.size(); ++i) points[step.moved[i]] = step.positions[i];
    for (const FacePatch& patch : step.patches) {
      for (std::size_t i = 0; i < patch.faces.size(); ++i) {
        const auto there = faces.find(patch.faces[i]);
        ASSERT_NE(there, faces.end());
        EXPECT_EQ(there->second.first, patch.before[i]);
        there->second = {patch.after[i], patch.label_after[i]};
        ++n_replaced;
      }
    }
  }

  std::vector<Point> points;
  std::map<int, std::pair<Triangle, int>> faces;
  int n_replaced = 0;
};

class Patches : public testing::Test {
 protected:
  RunSummary run_here(const Scenario& of) {
    RunObserver observer;
    RunOptions options;
    options.directory = folder_ / "out";
    options.force = true;
    return run(of, options, observer);
  }
  std::filesystem::path file() const { return folder_ / "out/patches.bin"; }

  std::string error() {
    try {
      PatchesReader reader(file());
      while (reader.next()) continue;
      return "none";
    } catch (const InputError& what) {
      return what.what();
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(Patches, ReplayGivesTheMeshesWritten) {
  for (const auto& motion : {rotor, jitter}) {
    for (const std::string quality : {"none", "delaunay", "smooth"}) {
      (void)run_here(scenario(motion, "[repair]\nquality = '" + quality + "'\n"));
      PatchesReader reader(file());
      Replay replay(reader.start());
      for (int n = 1; n <= 8; ++n) {
        const auto step = reader.next();
        ASSERT_TRUE(step);
        EXPECT_EQ(step->step, n);
        replay.apply(*step);
        const auto mesh = read_mesh(folder_ / ("out/mesh_00000" + std::to_string(n) + ".vtu")).mesh;
        EXPECT_EQ(mesh.points, replay.points);
        ASSERT_EQ(mesh.triangles.size(), replay.faces.size());
        for (int f = 0; f < mesh.n_faces(); ++f) ASSERT_EQ(mesh.triangles[f], replay.faces.at(f).first);
      }
      EXPECT_FALSE(reader.next());
      EXPECT_GT(replay.n_replaced, 50) << quality;
    }
  }
}

TEST_F(Patches, ListsOnlyWhatMoved) {
  (void)run_here(scenario(rotor, ""));
  PatchesReader reader(file());
  const auto step = reader.next();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->moved.size(), step->positions.size());
  EXPECT_GT(step->moved.size(), 30u);  // a third of the area turns
  EXPECT_LT(step->moved.size(), 90u);
}

TEST_F(Patches, StopsBeforeATornStep) {
  (void)run_here(scenario(jitter, ""));
  const std::string whole = test::content_of(file());
  std::size_t last = 0;
  int n_steps = -1;
  for (std::size_t size = whole.size(); size > 12; size = size * 9 / 10) {
    folder_.write("out/patches.bin", whole.substr(0, size));
    int n = 0;
    try {
      PatchesReader reader(file());
      while (reader.next()) ++n;
    } catch (const InputError& what) {
      EXPECT_THAT(what.what(), HasSubstr("ends before the mesh at the start"));
      continue;
    }
    if (last != 0) {
      EXPECT_LE(n, n_steps);
    }
    n_steps = n;
    last = size;
  }
  EXPECT_GE(n_steps, 0);
  EXPECT_LT(n_steps, 8);
}

TEST_F(Patches, RefusesWhatItIsNot) {
  EXPECT_THAT(error(), HasSubstr("patches.bin: cannot be read"));
  (void)run_here(scenario(jitter, ""));
  const std::string whole = test::content_of(file());
  folder_.write("out/patches.bin", "step,time\n1,2\n");
  EXPECT_THAT(error(), HasSubstr("is no patches.bin"));
  std::string other = whole;
  other[8] = 2;
  folder_.write("out/patches.bin", other);
  EXPECT_THAT(error(), HasSubstr("version"));
  for (std::size_t place : {20u, 28u, 4000u, 9000u}) {  // counts, faces, steps: found out or harmless
    other = whole;
    other[place] = static_cast<char>(other[place] ^ 0x7f);
    folder_.write("out/patches.bin", other);
    if (error() != "none") {
      EXPECT_THAT(error(), HasSubstr("patches.bin: "));
    }
  }
  other = whole;
  other[20] = 1;  // one point instead of 150
  folder_.write("out/patches.bin", other);
  EXPECT_THAT(error(), HasSubstr("damaged"));
}

// A list says how many things it has; each takes more memory than the byte that could prove it.
TEST_F(Patches, TakeNoMemoryForThingsThatAreNotThere) {
  const auto block = [](const std::string& bytes) {
    return binary::bytes_of(std::uint64_t{bytes.size()}) + bytes + '\n';
  };
  const std::string start = binary::bytes_of(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}) +
                            binary::bytes_of(std::vector<Triangle>{{0, 1, 2}}) +
                            binary::bytes_of(std::vector<int>{0});
  constexpr std::uint64_t many = 1 << 24;
  const std::string step = binary::bytes_of(1) + binary::bytes_of(0.5) + binary::bytes_of(std::uint64_t{0}) +
                           binary::bytes_of(std::uint64_t{0}) + binary::bytes_of(many);
  folder_.write("patches.bin", "KMPATCH\n" + binary::bytes_of(std::uint32_t{1}) + block(start) +
                                   block(step + std::string(many, '\xff')));
  struct rusage before {
  }, after{};
  getrusage(RUSAGE_SELF, &before);
  PatchesReader reader(folder_ / "patches.bin");
  EXPECT_THROW(reader.next(), InputError);
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 256 * 1024);  // KiB; 144 bytes for each would be 2 GiB
}

TEST_F(Patches, AreRefusedWithAVertexAtNoPlace) {
  (void)run_here(scenario(jitter, ""));
  std::string content = test::content_of(file());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(content.data() + 28, &nan, sizeof nan);
  folder_.write("out/patches.bin", content);
  EXPECT_THAT(error(), HasSubstr("a vertex at no finite place"));
}

TEST_F(Patches, AreNotWrittenUnlessWanted) {
  (void)run_here(parse_scenario(
      "[mesh]\nshape = 'square'\nvertices = 50\n" + jitter + "[time]\ndt = 1\nsteps = 1\n", "s"));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace kinemesh
