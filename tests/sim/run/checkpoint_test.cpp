// Checkpoints: everything comes back bit for bit, and nothing else is taken for one.
#include "sim/run/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <functional>
#include <limits>

#include "core/io/atomic_file.h"
#include "kinemesh/registry.h"
#include "sim/run/binary.h"
#include "tests/sim/helpers.h"

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
  checkpoint.origin = origin_of(initial);
  checkpoint.mesh = state_of(stepper.mesh());
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

Checkpoint small_checkpoint() {
  const Mesh initial = build_mesh(test::grid(2), {.frame = 0.25, .fixed = {}});
  return checkpoint_of(initial, Stepper(initial));
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
  Mesh mesh = rebuild(checkpoint.origin);
  ASSERT_EQ(snapshot(mesh), snapshot(initial));
  EXPECT_EQ(mesh.domain().label_names, initial.domain().label_names);
  EXPECT_TRUE(mesh.is_fixed(mesh.vertex_of_user(20)));
  restore(mesh, checkpoint.mesh);
  ASSERT_EQ(snapshot(mesh), snapshot(stepper.mesh()));
  EXPECT_EQ(mesh.n_user_faces(), stepper.mesh().n_user_faces());

  const Motion again = shaking(rebuild(checkpoint.origin));
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

TEST(Checkpoint, LayoutIsTheDocumentedOne) {
  binary::Writer writer;
  writer(std::string("ab"), 258, 1.0, std::vector<Edge>{{1, -1}}, true);
  const std::string payload(
      "\x02\0\0\0\0\0\0\0ab"
      "\x02\x01\0\0"
      "\0\0\0\0\0\0\xf0\x3f"
      "\x01\0\0\0\0\0\0\0\x01\0\0\0\xff\xff\xff\xff\x01",
      39);
  EXPECT_EQ(writer.bytes(), payload);
  const binary::Kind kind{"KMEXAMPL", 3, "example"};
  const std::string file = binary::seal(kind, payload);
  EXPECT_EQ(file.substr(0, 20), "KMEXAMPL" + std::string("\x03\0\0\0\x27\0\0\0\0\0\0\0", 12));
  EXPECT_EQ(file.substr(20, 39), payload);
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(file.data()), 59);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(static_cast<unsigned char>(file[59 + i]), sum >> 8 * i & 0xff);
  EXPECT_EQ(binary::unseal(kind, file), payload);
}

TEST(Checkpoint, IsRefusedWithAnyByteChanged) {
  const std::string whole = format_checkpoint(small_checkpoint());
  ASSERT_EQ(error_of(whole), "none");
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      EXPECT_THAT(error_of(damaged), HasSubstr(i < 8 ? "is no checkpoint of kinemesh" : "is damaged")) << i;
    }
  }
}

TEST(Checkpoint, IsRefusedWithAnyOtherLength) {
  const std::string whole = format_checkpoint(small_checkpoint());
  for (size_t length = 0; length < whole.size(); ++length)
    EXPECT_THAT(error_of(whole.substr(0, length)), HasSubstr(length < 8 ? "is no checkpoint" : "is damaged"));
  EXPECT_THAT(error_of(whole + '\0'), HasSubstr("is damaged"));
}

// Sealed rightly, by a program of another version or with too little inside.
TEST(Checkpoint, IsRefusedInAnotherLayout) {
  const binary::Kind ours{"KMCHKPT\n", 5, "checkpoint"}, later{"KMCHKPT\n", 9, "checkpoint"};
  const std::string whole = format_checkpoint(small_checkpoint());
  const std::string payload(binary::unseal(ours, whole));
  EXPECT_EQ(error_of(binary::seal(ours, payload)), "none");
  EXPECT_THAT(error_of(binary::seal(later, payload)), HasSubstr("version 9 of the layout, 5 expected"));
  EXPECT_THAT(error_of(binary::seal(ours, payload + "x")), HasSubstr("more bytes"));
  for (size_t length = 0; length < payload.size(); length += 7)
    EXPECT_NE(error_of(binary::seal(ours, payload.substr(0, length))), "none");
}

std::string restore_error(const MeshOrigin& origin, const MeshState& state) {
  try {
    Mesh mesh = rebuild(origin);
    restore(mesh, state);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Checkpoint, StatesThatFitNoMeshAreRefused) {
  const Mesh initial = initial_mesh();
  const MeshOrigin origin = origin_of(initial);
  const MeshState state = state_of(initial);
  EXPECT_EQ(restore_error(origin, state), "none");
  auto other = origin;
  std::swap(other.user_vertices[3], other.user_vertices[4]);
  EXPECT_THAT(restore_error(other, state), HasSubstr("numbers the mesh in another way"));
  auto bad = state;
  bad.labels.pop_back();
  EXPECT_THAT(restore_error(origin, bad), HasSubstr("another size"));
  bad = state;
  bad.triangles[5][1] = 1000;
  EXPECT_THAT(restore_error(origin, bad), HasSubstr("does not have"));
  bad = state;
  bad.constraint_sides[2] = 1 << 20;
  EXPECT_THAT(restore_error(origin, bad), HasSubstr("does not have"));
  bad = state;
  std::swap(bad.across[5], bad.across[6]);
  EXPECT_NE(restore_error(origin, bad), "none");
  bad = state;
  std::swap(bad.triangles[5], bad.triangles[6]);
  EXPECT_NE(restore_error(origin, bad), "none");
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
  checkpoint.series.region.pop_back();
  write_checkpoint(folder.path(), checkpoint);
  EXPECT_THAT(last_error(folder, ours), HasSubstr("checkpoint.bin: the series of a mesh of another size"));
}

}  // namespace
}  // namespace kinemesh
