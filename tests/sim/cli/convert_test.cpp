// `kinemesh convert`: what survives, what is said to be lost, and files that are whole or not there.
#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

const char* const box_su2 =
    "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\n"
    "NPOIN= 4\n0.1 1e-300 0\n1 0 1\n1.0000000000000002 1 2\n-0.3333333333333333 1 3\n"
    "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 3\nMARKER_TAG= inlet\nMARKER_ELEMS= 1\n3 "
    "3 0\n";

const char* const labelled_msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
    "$Elements\n2\n1 2 2 7 1 1 2 3\n2 2 2 9 1 1 3 4\n$EndElements\n";

class Convert : public ProgramTest {
 protected:
  void convert(const std::string& in, const std::string& out) const {
    const Result result = run({"convert", in, out});
    EXPECT_EQ(result.code, 0) << in << " to " << out << ": " << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(fs::exists(path(out)));
  }
  std::string text(const std::string& name) const { return read_text(path(name)); }
};

TEST_F(Convert, EveryFormatRoundTrips) {
  write("in.off", grid_off(4, {{6, 0.1, 1.0 / 3.0}, {7, 2.5, 3.25}}));
  convert("in.off", "first.off");
  for (const char* extension : {".off", ".obj", ".ply", ".su2", ".msh", ".vtu"}) {
    const std::string there = std::string("there") + extension;
    convert("first.off", there);
    convert(there, "back.off");
    EXPECT_EQ(text("back.off"), text("first.off")) << extension;
  }
}

TEST_F(Convert, MarkersGoThroughTheFormatsThatHaveThem) {
  write("in.su2", box_su2);
  convert("in.su2", "first.su2");
  for (const char* extension : {".msh", ".vtu"}) {
    const std::string there = std::string("there") + extension;
    convert("first.su2", there);
    convert(there, "back.su2");
    EXPECT_EQ(text("back.su2"), text("first.su2")) << extension;
  }
  EXPECT_NE(text("first.su2").find("MARKER_TAG= inlet"), std::string::npos);
}

TEST_F(Convert, LostMarkersAreNoted) {
  write("in.su2", box_su2);
  const Result result = run({"convert", "in.su2", "out.off"});
  EXPECT_EQ(result.code, 0);
  ASSERT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_EQ(result.err, "kinemesh: note: out.off: this format keeps no markers\n");
}

TEST_F(Convert, LostLabelsAreNoted) {
  write("in.msh", labelled_msh);
  const Result result = run({"convert", "in.msh", "out.off"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "kinemesh: note: out.off: this format keeps no labels\n");
  EXPECT_EQ(run({"convert", "in.msh", "out.vtu"}).err, "");
  convert("in.msh", "first.msh");
  convert("out.vtu", "back.msh");
  EXPECT_EQ(text("back.msh"), text("first.msh"));
}

TEST_F(Convert, DrawingOfATangledMeshMarksIt) {
  write("good.off", grid_off(3));
  write("bad.off", grid_off(3, {{5, 2.5, 1.25}}));
  convert("good.off", "good.svg");
  convert("bad.off", "bad.svg");
  EXPECT_NE(text("good.svg").find("<svg"), std::string::npos);
  EXPECT_NE(text("bad.svg").find(" 2 inverted</text>"), std::string::npos);
  EXPECT_EQ(text("good.svg").find("inverted"), std::string::npos);
  expect_error(run({"check", "good.svg"}), 2, {"good.svg: "});
}

TEST_F(Convert, OutputThatCannotBeWrittenLeavesNothing) {
  write("in.off", grid_off(2));
  fs::create_directory(path("folder.off"));
  expect_error(run({"convert", "in.off", "out.stl"}), 2, {"out.stl: ", ".stl", ".off"});
  expect_error(run({"convert", "in.off", "out"}), 2, {"out: ", ".off"});
  expect_error(run({"convert", "in.off", "absent/out.off"}), 2, {"absent/out.off: "});
  expect_error(run({"convert", "in.off", "in.off/out.off"}), 2, {"in.off/out.off: "});
  expect_error(run({"convert", "in.off", "folder.off"}), 2, {"folder.off: "});
  EXPECT_EQ(files(), (std::vector<std::string>{"folder.off", "in.off"}));
  EXPECT_TRUE(fs::is_empty(path("folder.off")));
}

TEST_F(Convert, BadInputLeavesTheOldOutput) {
  write("bad.off", "OFF\n3 1 0\n0 0 0\n");
  write("out.off", "precious\n");
  expect_error(run({"convert", "bad.off", "out.off"}), 2, {"bad.off:"});
  EXPECT_EQ(text("out.off"), "precious\n");
}

TEST_F(Convert, NotInPlace) {
  write("mesh.off", grid_off(2));
  expect_error(run({"convert", "mesh.off", "mesh.off"}), 2, {"mesh.off", "IN and OUT name the same file"});
  EXPECT_EQ(text("mesh.off"), grid_off(2));
  EXPECT_EQ(files(), std::vector<std::string>{"mesh.off"});
}

}  // namespace
}  // namespace kinemesh::testing
