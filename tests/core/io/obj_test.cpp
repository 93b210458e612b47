#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;

void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Obj, line, what);
}

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, AllFormsOfCorners) {
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3",
                           "f -3 -2 -1", "f -3/1 2//-1 +3", "f 1 2 3 # comment"}) {
    EXPECT_THAT(parse(vertices + face, Format::Obj).mesh.triangles, ElementsAre(Triangle{0, 1, 2})) << face;
  }
}

TEST(Obj, NegativeNumbersCountBackFromWhereTheyStand) {
  const auto mesh = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nf -2 -3 -1\n", Format::Obj).mesh;
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
}

TEST(Obj, FacesMayComeFirst) {
  EXPECT_THAT(parse("f 1 2 3\n" + vertices, Format::Obj).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, StatementsWithoutGeometryAreSkipped) {
  const auto mesh = parse("# cube\nmtllib a.mtl\no thing\ng part one\n" + vertices +
                              "vt 0 0\nvn 0 0 1\nvp 1\nusemtl red\ns off\nl 1 2\np 1\nf 1 2 3\n",
                          Format::Obj);
  EXPECT_EQ(mesh.mesh.n_faces(), 1);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Obj, WeightsAndColoursAreSkipped) {
  const auto mesh = parse("v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3\n", Format::Obj).mesh;
  EXPECT_EQ(mesh.points[1], Point(1, 0));
}

TEST(Obj, Refusals) {
  refused(vertices + "f 1 2 4\n", 4, "vertex 4 does not exist, expected 1 to 3");
  refused(vertices + "f 1 2 4\nf 1 2 3\nf 1 2 5\n", 6, "vertex 5 does not exist, expected 1 to 3");
  refused(vertices + "f 0 1 2\n", 4, "vertex 0 does not exist, 3 came before");
  refused(vertices + "f -4 1 2\n", 4, "vertex -4 does not exist, 3 came before");
  refused(vertices + "f 1 2\n", 4, "face 0 has 2 corners, expected 3");
  refused(vertices + "f\n", 4, "face 0 has 0 corners, expected 3");
  refused(vertices + "v 1 1 0\nf 1 2 4 3\n", 5, "--split-quads");
  refused(vertices + "f 1 1 2\n", 4, "face 0: vertex 0 is there twice");
  refused(vertices + "f /1 2 3\n", 4, "'' is not a whole number, expected vertex number");
  refused(vertices + "f 1 2 3.0\n", 4, "'3.0' is not a whole number");
  refused(vertices + "f 1 2 99999999999999999999\n", 4, "out of range");
  refused("v 0 0\nf 1 2 3\n", 1, "the line ends, expected z of a vertex");
  refused("v 0 nan 0\n", 1, "'nan' is not finite");
  refused("v 0 0 1\n", 1, "vertex 0 has z = 1, expected 0");
  refused(vertices + "curv 0 1 2\n", 4, "unknown statement 'curv'");
  refused(vertices + "f 1 2 3\nf 2 3 1\n", 5, "face 1: has the same vertices as face 0");
  refused(vertices, 0, "no triangles");
  refused("\n\n# nothing\n", 0, "no triangles");
}

}  // namespace
}  // namespace kinemesh
