#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;

MeshData off(const std::string& text) {
  return parse(text, Format::Off).mesh;
}
void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Off, line, what);
}

const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";

TEST(Off, Variants) {
  const auto one = std::vector<Triangle>{{0, 1, 2}};
  EXPECT_EQ(off("OFF\n3 1 0\n" + vertices + "3 0 1 2\n").triangles, one);
  EXPECT_EQ(off("OFF 3 1 0\n" + vertices + "3 0 1 2").triangles, one);
  EXPECT_EQ(off("OFF\n3 1\n" + vertices + "3 0 1 2\n").triangles, one);
  EXPECT_EQ(
      off("# a comment\nOFF # another\n\n3 1 0 # counts\n" + vertices + "3 0 1 2 # last\n# end\n").triangles,
      one);
  EXPECT_EQ(off("OFF\n3 1 0\n" + vertices + "3 0 1 2 255 128 0\n").triangles, one);
  EXPECT_EQ(off("COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 9 9 9 9\n3 0 1 2\n").triangles, one);
  EXPECT_EQ(off("OFF\n3 1 0\n0 +0 -0.0\n+1 0 1e-400\n0\t1 0\n3 +0 1 2\n").triangles, one);
}

TEST(Off, WritesTheExpectedText) {
  MeshData mesh;
  mesh.points = {{0, 0}, {1.5, -0.0}, {0.1, 1e300}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(format_mesh(mesh, Format::Off), "OFF\n3 1 0\n0 0 0\n1.5 -0 0\n0.1 1e+300 0\n3 0 1 2\n");
}

TEST(Off, QuadrilateralsAreRefusedOrSplit) {
  const std::string quad = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  refused(quad, 7, "face 0 is a quadrilateral, expected triangles; --split-quads divides it");
  const ReadResult result = parse(quad, Format::Off, true);
  EXPECT_THAT(result.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(result.notes, ElementsAre("quadrilaterals split in two: 1"));
}

TEST(Off, QuadrilateralsWithAReflexCornerAreSplitThere) {
  const std::string points = "0 0 0\n4 0 0\n1 1 0\n0 4 0\n";
  const auto at_1 = std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(parse("OFF\n4 1 0\n" + points + "4 0 1 2 3\n", Format::Off, true).mesh.triangles, at_1);
  const auto rotated = std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}};
  EXPECT_EQ(parse("OFF\n4 1 0\n" + points + "4 1 2 3 0\n", Format::Off, true).mesh.triangles, rotated);
  const auto clockwise = parse("OFF\n4 1 0\n" + points + "4 3 2 1 0\n", Format::Off, true).mesh.triangles;
  EXPECT_EQ(clockwise, (std::vector<Triangle>{{3, 0, 2}, {2, 0, 1}}));
}

TEST(Off, RefusesWhatItCannotRepresent) {
  refused("PLY\n", 1, "'PLY' begins the file, expected OFF or COFF");
  refused("OFF BINARY\n", 1, "'BINARY' is not a whole number, expected number of vertices");
  refused("OFF\n-3 1 0\n", 2, "-3 is negative");
  refused("OFF\n3 1 0 7\n" + vertices, 2, "unexpected '7' after the counts");
  refused("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", 4, "'nan' is not finite, expected z of a vertex");
  refused("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", 4, "'inf' is not finite");
  refused("OFF\n3 1 0\n0 0 0\n1e400 0 0\n0 1 0\n3 0 1 2\n", 4, "'1e400' is larger than any double");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0.5\n0 1 0\n3 0 1 2\n", 4, "vertex 1 has z = 0.5, expected 0");
  refused("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", 4, "the line ends, expected z of a vertex");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", 4, "unexpected '0' after the coordinates");
  refused("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", 4, "'x' is not a number");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 3\n", 6, "face 0: vertex 3 does not exist");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 -1\n", 6, "face 0: vertex -1 does not exist");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 1.5\n", 6, "'1.5' is not a whole number");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 1\n", 6, "face 0: vertex 1 is there twice");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 99999999999\n", 6, "'99999999999' is out of range");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1\n", 6, "the line ends, expected vertex number");
  refused("OFF\n3 1 0\n" + vertices + "2 0 1\n", 6, "face 0 has 2 corners, expected 3");
  refused("OFF\n3 1 0\n" + vertices + "5 0 1 2 0 1\n", 6, "face 0 has 5 corners, expected 3");
  refused("OFF\n3 2 0\n" + vertices + "3 0 1 2\n# comment\n3 1 2 0\n", 8,
          "face 1: has the same vertices as face 0");
  refused("OFF\n3 1 0\n" + vertices + "3 0 1 2\nmore\n", 7, "unexpected 'more' after the last face");
}

TEST(Off, RefusesTruncatedFilesAndWrongCounts) {
  refused("OFF\n", 2, "the file ends, expected number of vertices");
  refused("OFF\n3 1 0\n" + vertices, 6, "the file ends, expected number of a face's corners");
  refused("OFF\n3 1 0\n0 0 0\n1 0 0\n", 5, "the file ends, expected x of a vertex");
  refused("OFF\n1000 1 0\n" + vertices + "3 0 1 2\n", 2,
          "1000 as number of vertices is more than the rest of the file can hold");
  refused("OFF\n3 1000 0\n" + vertices + "3 0 1 2\n", 2, "1000 as number of faces");
  refused("OFF\n2000000000 1 0\n", 2, "2000000000 is more than 268435455");
  refused("OFF\n3 0 0\n" + vertices, 0, "no triangles, expected at least one");
}

TEST(Off, ThirdFaceAtAnEdgeNamesItsLine) {
  refused("OFF\n5 3 0\n" + vertices + "1 1 0\n2 2 0\n3 0 1 2\n3 2 1 3\n3 1 2 4\n", 10,
          "face 2: is one of 3 at the edge between vertices 1 and 2");
}

}  // namespace
}  // namespace kinemesh
