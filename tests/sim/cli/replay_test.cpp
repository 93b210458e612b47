// Steps that fail are written and done again, alone, to the same words.
#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

struct Stopped {
  const char* name;
  const char* scenario;
  const char* says;
};

void PrintTo(const Stopped& stopped, std::ostream* out) {
  *out << stopped.name;
}

const char* const annulus = "[mesh]\nshape = \"annulus\"\nvertices = 400\n";
const char* const inner =
    "[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\non = \"marker:inner\"\n"
    "[border]\nouter = \"fixed\"\n";

class Replay : public ProgramTest, public ::testing::WithParamInterface<Stopped> {};

TEST_P(Replay, SaysWhatTheRunSaid) {
  write("s.toml", GetParam().scenario);
  const Result failed = run({"run", "s.toml", "-o", "out", "--dump-on-failure"});
  ASSERT_EQ(failed.code, 1) << failed.err;
  const auto said = failed.err_lines().back();
  EXPECT_NE(said.find(GetParam().says), std::string::npos) << said;
  EXPECT_NE(failed.err.find("note: the step is in out/failed_step.bin"), std::string::npos) << failed.err;
  fs::rename(path("out/failed_step.bin"), path("case.bin"));
  fs::remove_all(path("out"));
  fs::remove(path("s.toml"));

  const Result again = run({"replay", "case.bin"});
  EXPECT_EQ(again.code, 1);
  EXPECT_EQ(again.out, "");
  EXPECT_EQ(again.err, said + "\n");
}

const Stopped cases[] = {
    {"BordersMeet",
     "[mesh]\nshape = \"annulus\"\nvertices = 400\n"
     "[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\non = \"marker:inner\"\n"
     "[border]\nouter = \"fixed\"\n[repair]\nallow_escaped = true\n[time]\ndt = 0.2\nsteps = 10\n",
     "edge"},
    {"Escaped",
     "[mesh]\nshape = \"annulus\"\nvertices = 400\n"
     "[[motion]]\nfield = \"translate\"\nvelocity = [1.0, 0.0]\non = \"marker:inner\"\n"
     "[[motion]]\nfield = \"jitter\"\namplitude = 0.3\n"
     "[border]\nouter = \"fixed\"\n[repair]\nstrategy = \"local\"\nquality = \"delaunay\"\n"
     "[time]\ndt = 0.03\nend = 0.6\n",
     "wrong side"},
    {"NotFinite",
     "[mesh]\nshape = \"square\"\nvertices = 100\n"
     "[[motion]]\nfield = \"expression\"\nu = \"0.01*sqrt(0.25-t)\"\nv = \"0\"\n"
     "[time]\ndt = 0.1\nsteps = 5\n",
     "field \"expression\" gives"},
    {"TwoAtOnePoint",
     "[mesh]\nshape = \"square\"\nvertices = 100\nframe = 0\n"
     "[[motion]]\nfield = \"displacement\"\n"
     "dx = \"t < 1.5 ? 0 : 0.5 - x\"\ndy = \"t < 1.5 ? 0 : 0.5 - y\"\n"
     "[time]\ndt = 1.0\nsteps = 3\n",
     "same point"},
};

INSTANTIATE_TEST_SUITE_P(Each, Replay, ::testing::ValuesIn(cases),
                         [](const auto& stopped) { return std::string(stopped.param.name); });

class ReplayFile : public ProgramTest {
 protected:
  void SetUp() override {
    write("s.toml", std::string(annulus) + inner + "[time]\ndt = 0.01\nsteps = 100\n");
    ASSERT_EQ(run({"run", "s.toml", "-o", "out", "-q", "--dump-on-failure"}).code, 1);
  }
};

TEST_F(ReplayFile, HoldsTheMeshesBeforeAndAfter) {
  ASSERT_EQ(run({"replay", "out/failed_step.bin", "--before", "before.su2", "--after", "after.su2"}).code, 1);
  EXPECT_EQ(run({"check", "before.su2"}).code, 0);
  EXPECT_EQ(read_text(path("before.su2")), read_text(path("out/final.su2")));
  EXPECT_EQ(run({"check", "after.su2"}).code, 1);
}

TEST_F(ReplayFile, IsWrittenOnlyIfAskedFor) {
  ASSERT_EQ(run({"run", "s.toml", "-o", "other", "-q"}).code, 1);
  EXPECT_FALSE(fs::exists(path("other/failed_step.bin")));
}

TEST_F(ReplayFile, IsRefusedIfItIsNone) {
  std::string content = read_text(path("out/failed_step.bin"));
  content[content.size() / 3] ^= 4;
  write("damaged.bin", content);
  expect_error(run({"replay", "damaged.bin"}), 2, {"damaged.bin: is damaged"});
  expect_error(run({"replay", "out/checkpoint.bin"}), 2, {"checkpoint.bin: is no failed step"});
  expect_error(run({"replay", "none.bin"}), 2, {"none.bin"});
  expect_error(run({"replay"}), 2, {"CASE"});
}

}  // namespace
}  // namespace kinemesh::testing
