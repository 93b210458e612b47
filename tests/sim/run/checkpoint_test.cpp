// Checkpoints: everything comes back bit for bit, and nothing else is taken for one.
#include "sim/run/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/io/atomic_file.h"
#include "kinemesh/registry.h"
#include "tests/core/mesh/disordered.h"
#include "tests/sim/helpers.h"
#include "tests/sim/run/section_file.h"

namespace kinemesh {
namespace {

using test::snapshot;
using testing::HasSubstr;

// Two labels, a hole, markers, a name that is not a word, an isolated vertex and a fixed one.
Mesh initial_mesh() {
  MeshData data = test::grid_with_hole(8, 3, 5);
  for (const auto& [a, b, c] : data.triangles)
    data.labels.push_back(data.points[a].x + data.points[b].x + data.points[c].x < 1.1 ? 1 : -7);
  data.label_names = {{1, "left, \"here\""}, {-7, ""}};
  data.points.push_back({0.4, 0.45});
  return build_mesh(data, {.frame = 0.5, .fixed = {0, 20}});
}

Motion shaking(const Mesh& mesh) {
  return Motion(mesh, {{make_field("jitter", {{"amplitude", 0.7}}), {}}});
}

Checkpoint checkpoint_of(const Mesh& initial, const Stepper& stepper) {
  Checkpoint checkpoint;
  checkpoint.scenario = "a = 1\nb = 2\n";
  checkpoint.base = base_of(initial);
  checkpoint.initial = state_of(initial, checkpoint.base.order);
  checkpoint.mesh = state_of(stepper.mesh(), checkpoint.base.order);
  checkpoint.time = stepper.time();
  checkpoint.step = stepper.steps_done();
  checkpoint.adaptive = {.position = 0.75, .length = 0.25, .in_a_row = 3, .rejected = 1LL << 35};
  checkpoint.totals.inverted = 1LL << 40;
  checkpoint.totals.share_mean = 0.1;
  checkpoint.totals.ms.write = 7.0;
  checkpoint.series = {.replaced = std::vector<std::uint8_t>(initial.n_faces(), 1),
                       .region = std::vector<int>(initial.n_faces(), 3),
                       .entries = {{0.1, "mesh_000000.vtu"}},
                       .last_written = 5};
  checkpoint.logs = {1ULL << 33, 12};
  return checkpoint;
}

Checkpoint grid_checkpoint(int n) {
  const Mesh initial = build_mesh(test::grid(n), {.frame = 0.25, .fixed = {}});
  return checkpoint_of(initial, Stepper(initial));
}

Checkpoint small_checkpoint() {
  return grid_checkpoint(2);
}

std::string error_of(const std::string& content) {
  try {
    parse_checkpoint(content);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

class EachStrategyAndQuality : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(EachStrategyAndQuality, MeshesComeBackAndGoOnBitForBit) {
  const auto& [strategy, quality] = GetParam();
  const StepperOptions options{.strategy = strategy, .quality = quality};
  const Mesh initial = initial_mesh();
  const Motion motion = shaking(initial);
  Stepper stepper(initial, options);
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(stepper.step(motion, 0.1));
  ASSERT_NE(snapshot(stepper.mesh()), snapshot(initial));

  const auto checkpoint = parse_checkpoint(format_checkpoint(checkpoint_of(initial, stepper)));
  const Mesh start = restore(checkpoint.base, checkpoint.initial);
  ASSERT_EQ(snapshot(start), snapshot(initial));
  Mesh mesh = restore(checkpoint.base, checkpoint.mesh);
  ASSERT_EQ(snapshot(mesh), snapshot(stepper.mesh()));

  const Motion again = shaking(start);
  Stepper resumed(std::move(mesh), options, checkpoint.time, checkpoint.step);
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(stepper.step(motion, 0.1));
    ASSERT_TRUE(resumed.step(again, 0.1));
    ASSERT_EQ(snapshot(resumed.mesh()), snapshot(stepper.mesh())) << n;
    ASSERT_EQ(resumed.time(), stepper.time());
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachStrategyAndQuality,
                         testing::Combine(testing::Values("global", "local", "remesh", "kinetic"),
                                          testing::Values("none", "delaunay", "smooth", "angles")),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param)) + "_" + std::get<1>(param.param);
                         });

TEST(Checkpoint, KeepsEverythingElse) {
  const auto checkpoint = parse_checkpoint(format_checkpoint(small_checkpoint()));
  EXPECT_EQ(checkpoint.scenario, "a = 1\nb = 2\n");
  EXPECT_EQ(checkpoint.adaptive.position, 0.75);
  EXPECT_EQ(checkpoint.adaptive.length, 0.25);
  EXPECT_EQ(checkpoint.adaptive.in_a_row, 3);
  EXPECT_EQ(checkpoint.adaptive.rejected, 1LL << 35);
  EXPECT_EQ(checkpoint.totals.inverted, 1LL << 40);
  EXPECT_EQ(checkpoint.totals.share_mean, 0.1);
  EXPECT_EQ(checkpoint.totals.ms.write, 7.0);
  EXPECT_EQ(checkpoint.series.replaced.back(), 1);
  EXPECT_EQ(checkpoint.series.region.back(), 3);
  ASSERT_EQ(checkpoint.series.entries.size(), 1u);
  EXPECT_EQ(checkpoint.series.entries[0].time, 0.1);
  EXPECT_EQ(checkpoint.series.entries[0].file, "mesh_000000.vtu");
  EXPECT_EQ(checkpoint.series.last_written, 5);
  EXPECT_EQ(checkpoint.logs.steps, 1ULL << 33);
  EXPECT_EQ(checkpoint.logs.regions, 12u);
}

// Series and increments by face and vertex, which the file has in the user's order.
TEST(Checkpoint, BringsBackTheMeshsOrder) {
  Checkpoint checkpoint = small_checkpoint();
  for (std::size_t f = 0; f < checkpoint.series.region.size(); ++f) {
    checkpoint.series.region[f] = static_cast<int>(f);
    checkpoint.series.replaced[f] = f % 3 == 0;
  }
  for (std::size_t v = 0; v < checkpoint.mesh.positions.size(); ++v)
    checkpoint.following.increments.push_back({1.0 * static_cast<double>(v), 0.5});
  const Checkpoint back = parse_checkpoint(format_checkpoint(checkpoint));
  EXPECT_EQ(back.series.region, checkpoint.series.region);
  EXPECT_EQ(back.series.replaced, checkpoint.series.replaced);
  EXPECT_EQ(back.following.increments, checkpoint.following.increments);
}

// The same mesh, stored in another order, and what goes with it: one section tells.
TEST(Checkpoint, OneSectionDependsOnTheMeshsOrder) {
  const MeshData data = test::grid(6);
  const BuildOptions options{.frame = 0.0, .fixed = {3}};
  const auto file_of = [](const Mesh& mesh) {
    Checkpoint checkpoint = checkpoint_of(mesh, Stepper(mesh));
    for (const Face f : mesh.faces()) checkpoint.series.region[f] = mesh.user_face(f) % 5;
    for (const Vertex v : mesh.vertices()) checkpoint.following.increments.push_back(mesh.position(v));
    return test::taken_apart(format_checkpoint(checkpoint));
  };
  const auto one = file_of(build_mesh(data, options)), other = file_of(test::disordered(data, options, 5));
  ASSERT_EQ(one.sections.size(), other.sections.size());
  for (std::size_t i = 0; i < one.sections.size(); ++i)
    EXPECT_EQ(one.sections[i].contents == other.sections[i].contents, one.sections[i].name != "order")
        << one.sections[i].name;
}

TEST(Checkpoint, HasTheDocumentedSections) {
  std::vector<std::string> names;
  for (const auto& section : test::taken_apart(format_checkpoint(small_checkpoint())).sections) {
    names.push_back(section.name);
    EXPECT_EQ(section.version, 1u);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"program", "scenario", "mesh", "order", "initial", "state",
                                             "time", "interior", "totals", "series", "logs"}));
}

TEST(Checkpoint, IsRefusedWithAnyByteChanged) {
  const std::string whole = format_checkpoint(small_checkpoint());
  ASSERT_EQ(error_of(whole), "none");
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const char* const why = i < 8 ? "is no checkpoint of kinemesh" : i < 12 ? "has layout" : "is damaged";
      EXPECT_THAT(error_of(damaged), HasSubstr(why)) << i;
    }
  }
}

TEST(Checkpoint, IsRefusedWithAnyOtherLength) {
  const std::string whole = format_checkpoint(small_checkpoint());
  for (size_t length = 0; length < whole.size(); ++length)
    EXPECT_THAT(error_of(whole.substr(0, length)), HasSubstr(length < 8 ? "is no checkpoint" : "is damaged"));
  EXPECT_THAT(error_of(whole + '\0'), HasSubstr("is damaged"));
}

// With checksums that are right, by a program of another version.
TEST(Checkpoint, IsRefusedWithOtherSections) {
  const auto file = test::taken_apart(format_checkpoint(small_checkpoint()));
  EXPECT_EQ(error_of(test::joined(file)), "none");
  for (std::size_t i = 0; i < file.sections.size(); ++i) {
    const std::string& name = file.sections[i].name;
    auto other = file;
    other[name].version = 2;
    EXPECT_EQ(error_of(test::joined(other)), "section '" + name + "' has version 2, this program reads 1");
    other.sections.erase(other.sections.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(error_of(test::joined(other)), "has no section '" + name + "'");
    other = file;
    other[name].contents += 'x';
    EXPECT_EQ(error_of(test::joined(other)), "section '" + name + "': more bytes than expected");
  }
  auto other = file;
  other["lattice"].contents = "xyz";
  EXPECT_EQ(error_of(test::joined(other)), "section 'lattice' is unknown to this program");
  other = file;
  other.layout = 5;
  EXPECT_EQ(
      error_of(test::joined(other)),
      "has layout 5, this program reads 6: an older version has written it; that version can go on from it");
}

TEST(Checkpoint, TheLastTwoAreKept) {
  const test::TemporaryFolder folder;
  Checkpoint checkpoint = small_checkpoint();
  EXPECT_FALSE(last_checkpoint(folder.path(), checkpoint.scenario));
  for (int step = 1; step <= 3; ++step) {
    checkpoint.step = step;
    write_checkpoint(folder.path(), checkpoint);
    EXPECT_EQ(last_checkpoint(folder.path(), checkpoint.scenario)->checkpoint.step, step);
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"checkpoint.bin", "checkpoint_prev.bin"}));
  EXPECT_EQ(parse_checkpoint(read_file(folder / "checkpoint_prev.bin")).step, 2);
  // As when the program is killed between the two renamings.
  std::filesystem::remove(folder / "checkpoint.bin");
  EXPECT_EQ(last_checkpoint(folder.path(), checkpoint.scenario)->checkpoint.step, 2);
}

std::string last_error(const test::TemporaryFolder& folder, const std::string& scenario) {
  try {
    last_checkpoint(folder.path(), scenario);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Checkpoint, StepsAndTimesThatNoRunHasAreRefused) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::function<void(Checkpoint&)>& change) {
    Checkpoint checkpoint = small_checkpoint();
    change(checkpoint);
    write_checkpoint(folder.path(), checkpoint);
    EXPECT_THAT(last_error(folder, checkpoint.scenario), HasSubstr(": a step or a time that no run has"));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](Checkpoint& c) { c.step = -1; });
  refused([&](Checkpoint& c) { c.time = nan; });
  refused([&](Checkpoint& c) { c.adaptive.position = nan; });
  refused([](Checkpoint& c) { c.adaptive.length = 0.0; });
}

TEST(Checkpoint, ErrorsNameTheFileAndOfferTheOneBefore) {
  const test::TemporaryFolder folder;
  Checkpoint checkpoint = small_checkpoint();
  const std::string ours = checkpoint.scenario, name = (folder / "checkpoint.bin").string();
  checkpoint.step = 1;
  write_checkpoint(folder.path(), checkpoint);
  EXPECT_EQ(last_error(folder, "a = 1\nb = 3\n"),
            name +
                ": is of another scenario: b = 2 there, b = 3 here; no whole checkpoint_prev.bin beside it, "
                "--force starts anew");
  checkpoint.step = 2;
  write_checkpoint(folder.path(), checkpoint);
  folder.write("checkpoint.bin", "KMCHKPT\nrubbish");
  EXPECT_EQ(last_error(folder, ours),
            name +
                ": is damaged: 15 bytes long, at least 24 expected; checkpoint_prev.bin is whole, of step 1: "
                "rename it to checkpoint.bin to go on from there");
  folder.write("checkpoint.bin", "");
  EXPECT_THAT(last_error(folder, ours),
              HasSubstr("is no checkpoint of kinemesh; checkpoint_prev.bin is whole"));
  folder.write("checkpoint_prev.bin", "");
  EXPECT_THAT(last_error(folder, ours),
              HasSubstr("is no checkpoint of kinemesh; no whole checkpoint_prev.bin"));
  auto file = test::taken_apart(format_checkpoint(checkpoint));
  file["series"].contents = test::taken_apart(format_checkpoint(grid_checkpoint(3)))["series"].contents;
  folder.write("checkpoint.bin", test::joined(file));
  EXPECT_THAT(last_error(folder, ours), HasSubstr("checkpoint.bin: the series of a mesh of another size"));
}

}  // namespace
}  // namespace kinemesh
