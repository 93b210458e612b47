// Text of files and users in what the program says: shown, on one line, and no command for the terminal.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/printable.h"
#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

const std::string nasty =
    "\x1b]0;pwned\x07\x1b[31mRED\r\xc2\x9b"
    "2J\xff\xe2\x80\xae\xe2\x80\xa8\x7f";
const std::string shown = "\\x1b]0;pwned\\x07\\x1b[31mRED\\r\\u009b2J\\xff\\u202e\\u2028\\x7f";

const char* const motion =
    "[[motion]]\nfield = \"translate\"\nvelocity = [0.01, 0]\n[time]\ndt = 0.1\nsteps = 1\n";
const char* const square = "[mesh]\nshape = \"square\"\nvertices = 50\n";

class Printed : public ProgramTest {
 protected:
  // One line of an error that shows what is nasty.
  void expect_shown(const Result& result, int code = 2) const {
    expect_error(result, code, {});
    expect_harmless(result.err);
    EXPECT_NE(result.err.find(shown), std::string::npos) << printable(result.err);
  }

  // Nothing but lines of printable text.
  static void expect_harmless(const std::string& text) {
    for (const std::string& line : lines_of(text)) EXPECT_EQ(line, printable(line));
  }
};

TEST_F(Printed, ArgumentsInErrors) {
  write("a.off", grid_off(1));
  write("s.toml", std::string(square) + motion);
  expect_shown(run({nasty}));
  expect_shown(run({"run", "s.toml", nasty}));
  expect_shown(run({"run", "s.toml", "--" + nasty}));
  expect_shown(run({"run", nasty + ".toml"}));
  expect_shown(run({"run", "s.toml", "--set", nasty + "=1"}));
  expect_shown(run({"run", "s.toml", "--set", "mesh.shape=\"" + nasty + "\""}));
  expect_shown(run({"run", "s.toml", "--set", nasty}));
  expect_shown(run({"run", "s.toml", "--threads", nasty}));
  expect_shown(run({"check", nasty + ".off"}));
  expect_shown(run({"check", "a.off", nasty}));
  expect_shown(run({"convert", "a.off", "b." + nasty}));
  expect_shown(run({"convert", "a.off", nasty + "/b.off"}));
  expect_shown(run({"untangle", "a.off", "-o", "b.off", "--strategy", nasty}));
  expect_shown(run({"untangle", "a.off", "-o", "b.off", "--seed", nasty}));
  expect_shown(run({"bench", "s.toml", "--strategies", nasty}));
  expect_shown(run({"bench", "s.toml", "--strategies", "global", "--sweep", nasty}));
  expect_shown(run({"report", nasty}));
  expect_shown(run({"draw", "a.off", "-o", nasty}));
  expect_shown(run({"draw", "a.off", "-o", "a.svg", "--width", nasty}));
  expect_shown(run({"replay", nasty}));
}

TEST_F(Printed, LineBreaksInArgumentsAreShown) {
  const Result result = run({"run", "a\nb\n.toml"});
  expect_error(result, 2, {"a\\nb\\n.toml"});
}

TEST_F(Printed, KeysAndValuesOfScenarios) {
  const std::string value = "\"\\u001b[31m\\n\\u202e\"";
  write("key.toml", std::string(square) + value + " = 1\n" + motion);
  write("shape.toml", "[mesh]\nshape = " + value + "\n" + motion);
  write("file.toml", "[mesh]\nfile = " + value + "\n" + motion);
  write("field.toml", std::string(square) + motion + "[[motion]]\nfield = " + value + "\n");
  for (const char* name : {"key.toml", "shape.toml", "file.toml", "field.toml"}) {
    const Result result = run({"run", name});
    expect_error(result, 2, {"\\x1b[31m\\n\\u202e"});
    expect_harmless(result.err);
  }
}

// The readers refuse names with control characters themselves; other bytes are names.
TEST_F(Printed, NamesOfMarkers) {
  const auto su2 = [](const std::string& name) {
    return "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 1\nMARKER_TAG= " + name +
           "\nMARKER_ELEMS= 1\n3 0 1\n";
  };
  const auto msh = [](const std::string& name) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 \"" + name +
           "\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 1 1 "
           "1 2\n"
           "2 2 2 0 1 1 2 3\n$EndElements\n";
  };
  for (const std::string name : {"\x1b[31mwall", "wa\x07ll",
                                 "\xc2\x9b"
                                 "31m",
                                 "\xe2\x80\xaewall", "w\xff"}) {
    for (const auto& [file, text] : {std::pair("a.su2", su2(name)), std::pair("a.msh", msh(name))}) {
      write(file, text);
      const Result table = run({"check", file});
      expect_harmless(table.out + table.err);
      EXPECT_LE(table.err_lines().size(), 1u) << table.err;
      EXPECT_NE((table.out + table.err).find(printable(name)), std::string::npos) << table.out << table.err;
      const Result json = run({"check", file, "--json"});
      EXPECT_TRUE(json.code == 2 || nlohmann::json::accept(json.out)) << json.out;
    }
  }
}

TEST_F(Printed, NamesOfFilesInTables) {
  const std::string folder = "out\x1b[31m\n\xff", folder_shown = "out\\x1b[31m\\n\\xff";
  write(folder + ".off", grid_off(2));
  write("s.toml", std::string(square) + motion);
  const std::vector<std::vector<std::string>> commands{
      {"check", folder + ".off"},
      {"check", folder + ".off", "--toward", folder + ".off"},
      {"untangle", folder + ".off", "-o", folder + "2.off"},
      {"draw", folder + ".off", "-o", folder + ".svg"},
      {"run", "s.toml", "-o", folder, "--dry-run"},
      {"run", "s.toml", "-o", folder},
      {"report", folder},
      {"bench", "s.toml", "--strategies", "global", "-o", folder + "3", "--sweep", "time.dt=0.1,0.2"}};
  for (const auto& command : commands) {
    const Result result = run(command);
    EXPECT_EQ(result.code, 0) << result.err;
    expect_harmless(result.out + result.err);
    EXPECT_NE(result.out.find(folder_shown), std::string::npos) << result.out;
  }
}

// What the program suggests can be given to a shell, whatever the folder is called.
TEST_F(Printed, CommandsToGoOnAreQuoted) {
  write("s.toml", std::string(square) + motion);
  for (const std::string folder : {"a b", "it's", "$(touch PWNED)", "x\x1b\n'y\\"}) {
    const Result result = run({"run", "s.toml", "-o", folder});
    ASSERT_EQ(result.code, 0) << result.err;
    const std::string row = result.out.substr(result.out.find("to look at it"));
    write("go.sh", "cd \"$(dirname \"$0\")\" && " + row.substr(22));
    EXPECT_EQ(std::system(("bash " + path("go.sh").string() + " > /dev/null").c_str()), 0) << row;
    EXPECT_TRUE(fs::exists(path(folder) / "report.html"));
  }
  EXPECT_FALSE(fs::exists(path("PWNED")));
}

}  // namespace
}  // namespace kinemesh::testing
