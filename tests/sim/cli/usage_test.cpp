// What the program says about itself, and how it answers mistakes on the command line.
#include "kinemesh/mesh_io.h"
#include "kinemesh/registry.h"
#include "kinemesh/shapes.h"
#include "kinemesh/strategy.h"
#include "program.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh::testing {
namespace {

class Usage : public ProgramTest {};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Usage, VersionIsTheProjects) {
  const Result result = run({"--version"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "kinemesh " KINEMESH_VERSION "\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(Usage, HelpNamesEveryCommand) {
  const Result result = run({"--help"});
  EXPECT_EQ(result.code, 0);
  for (const char* command :
       {"run", "replay", "bench", "report", "draw", "check", "untangle", "convert", "list"})
    EXPECT_TRUE(has(result.out, std::string("\n  ") + command + " ")) << command;
  EXPECT_TRUE(has(result.out, "3 memory has run out")) << result.out;
  EXPECT_TRUE(has(result.out, "4 internal error")) << result.out;
}

TEST_F(Usage, EveryCommandHasHelp) {
  for (const char* command :
       {"run", "replay", "bench", "report", "draw", "check", "untangle", "convert", "list"}) {
    const Result result = run({command, "--help"});
    EXPECT_EQ(result.code, 0) << command;
    EXPECT_TRUE(has(result.out, "Usage: kinemesh " + std::string(command))) << result.out;
    for (const std::string& line : lines_of(result.out)) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST_F(Usage, ListNamesFieldsParametersStrategiesQualitiesShapesAndFormats) {
  const Result result = run({"list"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  for (const FieldInfo& field : fields()) {
    EXPECT_TRUE(has(result.out, "\n  " + field.name)) << field.name;
    for (const ParameterInfo& parameter : field.parameters) EXPECT_TRUE(has(result.out, parameter.name));
  }
  for (const char* part : {"[[body]]", "[interior]", "`follow`", "a formula of t"})
    EXPECT_TRUE(has(result.out, part)) << part;
  EXPECT_TRUE(has(result.out, "your own, velocities or displacements\n  plugin")) << result.out;
  for (const StrategyInfo& strategy : strategies()) EXPECT_TRUE(has(result.out, "\n  " + strategy.name));
  for (const QualityInfo& quality : qualities()) EXPECT_TRUE(has(result.out, "\n  " + quality.name));
  for (const ShapeInfo& shape : shapes()) EXPECT_TRUE(has(result.out, "\n  " + shape.name)) << shape.name;
  for (const char* extension : {".off", ".obj", ".ply", ".su2", ".msh", ".vtu", ".svg"})
    EXPECT_TRUE(has(result.out, extension)) << extension;
  for (const std::string& line : lines_of(result.out)) EXPECT_LE(line.size(), 100u) << line;
}

TEST_F(Usage, MistakesAreBadInput) {
  write("a.off", grid_off(1));
  expect_error(run({}), 2, {"command", "--help"});
  expect_error(run({"frobnicate"}), 2, {"frobnicate"});
  expect_error(run({"check"}), 2, {"check: ", "MESH"});
  expect_error(run({"check", "a.off", "--frobnicate"}), 2, {"check: ", "--frobnicate"});
  expect_error(run({"check", "a.off", "b.off"}), 2, {"b.off"});
  expect_error(run({"convert", "a.off"}), 2, {"convert: ", "OUT"});
  expect_error(run({"untangle", "a.off"}), 2, {"untangle: ", "--output"});
  expect_error(run({"run"}), 2, {"run: ", "SCENARIO"});
  expect_error(run({"run", "a.toml", "-q", "-v"}), 2, {"run: "});
  expect_error(run({"run", "a.toml", "--threads", "0"}), 2, {"--threads"});
  expect_error(run({"run", "a.toml", "--threads", "many"}), 2, {"--threads"});
  expect_error(run({"run", "a.toml", "--resume", "--force"}), 2, {"--resume"});
  EXPECT_EQ(files(), std::vector<std::string>{"a.off"});
}

TEST_F(Usage, UnreadableFilesAreNamed) {
  write("empty.off", "");
  write("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  write("word.off", "OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n");
  write("mesh.stl", "solid\n");
  write("mesh", "OFF\n");
  expect_error(run({"check", "absent.off"}), 2, {"absent.off: "});
  expect_error(run({"check", "."}), 2, {"."});
  expect_error(run({"check", "empty.off"}), 2, {"empty.off:"});
  expect_error(run({"check", "short.off"}), 2, {"short.off:"});
  expect_error(run({"check", "word.off"}), 2, {"word.off:4: ", "zero"});
  expect_error(run({"check", "mesh.stl"}), 2, {"mesh.stl: ", ".stl", ".off"});
  expect_error(run({"check", "mesh"}), 2, {"mesh: ", ".off"});
  expect_error(run({"run", "absent.toml"}), 2, {"absent.toml"});
}

TEST_F(Usage, QuadrilateralsNeedTheirOption) {
  write("quad.off", "OFF\n4 1 0\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n4 0 1 2 3\n");
  expect_error(run({"check", "quad.off"}), 2, {"quad.off:7: ", "--split-quads"});
  const Result result = run({"check", "quad.off", "--split-quads"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "faces                          2\n")) << result.out;
  EXPECT_EQ(run({"convert", "quad.off", "split.off", "--split-quads"}).code, 0);
  EXPECT_EQ(run({"check", "split.off"}).code, 0);
}

TEST_F(Usage, OutputThatDoesNotArriveIsNotSuccess) {
  const auto expect_failure = [&](const std::string& redirection) {
    const std::string command = KINEMESH_PROGRAM " list " + redirection + " 2> " + path("err").string();
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 3) << redirection;
    EXPECT_EQ(read_text(path("err")), "kinemesh: cannot write to standard output\n") << redirection;
  };
  expect_failure(">&-");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  expect_failure("> /dev/full");
}

}  // namespace
}  // namespace kinemesh::testing
