// Numbers on the command line that are none, or too large, are refused before anything is done.
#include "kinemesh/error.h"
#include "program.h"
#include "sim/draw/png.h"

namespace kinemesh::testing {
namespace {

class Numbers : public ProgramTest {
 protected:
  void SetUp() override {
    write("a.off", grid_off(2));
    write("wide.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1e-9 0\n0 1e-9 0\n3 0 1 2\n3 0 2 3\n");
    write("high.off", "OFF\n4 2 0\n0 0 0\n1e-9 0 0\n1e-9 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    write("s.toml",
          "[mesh]\nshape = \"square\"\nvertices = 50\n[[motion]]\nfield = \"translate\"\nvelocity = [1, 0]\n"
          "[time]\ndt = 1\nsteps = 1\n");
    before_ = files();
  }

  void expect_refused(const std::vector<std::string>& command, const std::string& option,
                      const std::string& value) {
    SCOPED_TRACE(option + " '" + value + "'");
    auto words = command;
    words.push_back(option + "=" + value);
    expect_error(run(words), 2, {});
    EXPECT_EQ(files(), before_);
  }

  std::vector<std::string> before_;
};

const std::vector<std::string> no_numbers{"nan", "-nan", "inf",  "-inf", "1e999", "",
                                          " ",   "1x",   "0x10", "1,5",  "true"};

TEST_F(Numbers, ThatAreNoneAreRefused) {
  for (const std::string& value : no_numbers) {
    expect_refused({"run", "s.toml"}, "--threads", value);
    expect_refused({"bench", "s.toml", "--strategies", "global"}, "--threads", value);
    expect_refused({"report", "."}, "--max-size", value);
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--width", value);
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--step", value);
    expect_refused({"draw", "a.off", "-o", "a.svg", "--region", "r.json"}, "--number", value);
    expect_refused({"untangle", "a.off", "-o", "b.off", "--strategy", "local"}, "--seed", value);
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--zoom", "0,0,1," + value);
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--zoom", value + ",0,1,1");
  }
}

TEST_F(Numbers, OutOfRangeAreRefused) {
  for (const char* value : {"0", "-1", "1025", "99999999999999999999", "1.5", "1e2"})
    expect_refused({"run", "s.toml"}, "--threads", value);
  for (const char* value : {"-1", "1000.1", "1e9", "-1e-300"})
    expect_refused({"report", "."}, "--max-size", value);
  for (const char* value : {"63.9", "16385", "-100", "1e9", "1e308"})
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--width", value);
  for (const char* value : {"-1", "2147483648", "99999999999999999999", "1.5"})
    expect_refused({"draw", "a.off", "-o", "a.svg"}, "--step", value);
  expect_refused({"draw", "a.off", "-o", "a.svg"}, "--zoom", "0,0,0,1");
  expect_refused({"draw", "a.off", "-o", "a.svg"}, "--zoom", "0,0,1");
}

TEST_F(Numbers, AreDecimal) {
  EXPECT_EQ(run({"draw", "a.off", "-o", "a.svg", "--width", "0100"}).code, 0);
  EXPECT_NE(read_text(path("a.svg")).find("width=\"100\""), std::string::npos);
  EXPECT_EQ(run({"draw", "a.off", "-o", "a.svg", "--width", "+1e2"}).code, 0);
  const Result plan = run({"run", "s.toml", "--dry-run", "--threads", "010"});
  EXPECT_NE(plan.out.find("threads               10\n"), std::string::npos) << plan.out;
}

TEST_F(Numbers, OfBytesOfADrawingAreBounded) {
  EXPECT_THROW((void)draw::png_of(std::string(draw::most_svg_bytes + 1, ' ')), InputError);
}

// The height follows the width, up to ten times as much: no picture takes more memory than is told.
TEST_F(Numbers, OfPixelsAreBounded) {
  expect_error(run({"draw", "high.off", "-o", "a.png", "--width", "16384"}), 2,
               {"pixels", "100 million", "--width"});
  expect_error(run({"draw", "a.off", "-o", "a.png", "--width", "16384"}), 2,
               {"16384 x 16384 pixels", "100 million"});
  expect_error(run({"draw", "a.off", "-o", "a.png", "--width", "16384", "--zoom=0,0,1e-300,1"}), 2,
               {"100 million"});
  EXPECT_EQ(files(), before_);
  EXPECT_EQ(run({"draw", "wide.off", "-o", "wide.png", "--width", "16384"}).code, 0);
  EXPECT_EQ(run({"draw", "high.off", "-o", "high.png", "--width", "1000"}).code, 0);
  EXPECT_EQ(run({"draw", "high.off", "-o", "high.svg", "--width", "16384"}).code, 0);
}

}  // namespace
}  // namespace kinemesh::testing
