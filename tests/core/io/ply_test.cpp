#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;

void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Ply, line, what);
}

const std::string start = "ply\nformat ascii 1.0\n";
const std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string header = start + vertex + face + "end_header\n";
const std::string points = "0 0 0\n1 0 0\n0 1 0\n";

TEST(Ply, Simple) {
  EXPECT_THAT(parse(header + points + "3 0 1 2\n", Format::Ply).mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(Ply, PropertiesInAnyOrderAndExtraOnes) {
  const std::string text =
      start +
      "comment made by hand\nobj_info nothing\n"
      "element vertex 3\nproperty uchar red\nproperty double y\nproperty list uchar float weights\n"
      "property double x\n"
      "element empty 1000000\n"
      "element material 2\nproperty int id\nproperty list uint8 int32 items\n"
      "element face 1\nproperty float quality\nproperty list uint8 uint32 vertex_index\n"
      "property uchar flag\nend_header\n"
      "255 0 2 0.5 0.5 0\n0 0 0 1\n9 1 1 3 0\n"
      "7 0\n8 2 1 1\n"
      "0.25 3 0 1 2 1\n";
  EXPECT_THAT(parse(text.substr(0, text.find("element empty")) + text.substr(text.find("element material")),
                    Format::Ply)
                  .mesh.points,
              ElementsAre(Point(0, 0), Point(1, 0), Point(0, 1)));
  expect_refused(text, Format::Ply, 10,
                 "1000000 as number of elements is more than the rest of the file can hold");
}

TEST(Ply, FacesBeforeVertices) {
  EXPECT_EQ(parse(start + face + vertex + "end_header\n3 0 1 2\n" + points, Format::Ply).mesh.n_faces(), 1);
}

TEST(Ply, RefusesHeadersItCannotRead) {
  refused("plx\n", 1, "'plx' begins the file, expected ply");
  refused("ply\nformat binary_little_endian 1.0\n", 2,
          "the format is 'binary_little_endian', expected ascii");
  refused("ply\nformat ascii 2.0\n", 2, "the version is '2.0', expected 1.0");
  refused("ply\n" + vertex + face + "end_header\n" + points + "3 0 1 2\n", 8,
          "expected a line 'format ascii 1.0'");
  refused(start + "elemnt vertex 3\n", 3, "unknown keyword 'elemnt'");
  refused(start + "property int x\n", 3, "a property before the first element");
  refused(start + "element vertex\n", 4, "the file ends, expected number of elements");
  refused(start + "element vertex 3\nproperty quad x\n", 4, "unknown type 'quad'");
  refused(start + "element vertex 3\nproperty list float int x\n", 4, "unknown type 'float'");
  refused(start + "element vertex 3\nproperty list uchar int x\n", 4, "property 'x' is a list");
  refused(start + "element vertex 3\nproperty int x\nproperty int x\n", 5, "a second property 'x'");
  refused(start + "element face 1\nproperty int vertex_indices\n", 4,
          "property 'vertex_indices' is not a list");
  refused(start + vertex + vertex, 7, "a second element 'vertex'");
  refused(start + vertex + "end_header\n" + points, 7, "expected an element face");
  refused(start + face + "end_header\n", 5, "expected an element vertex");
  refused(start + "element vertex 1\nproperty int x\n" + face + "end_header\n", 7,
          "element vertex lacks x or y");
  refused(start + vertex + "element face 1\nproperty int a\nend_header\n" + points, 9,
          "element face lacks vertex_indices");
  refused(start + vertex + face, 9, "the file ends, expected end_header");
}

TEST(Ply, RefusesDataItCannotRepresent) {
  refused(header + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", 11, "'nan' is not finite, expected z");
  refused(header + "0 0 0\n1 0 2\n0 1 0\n3 0 1 2\n", 11, "vertex 1 has z = 2");
  refused(header + points + "3 0 1 3\n", 13, "face 0: vertex 3 does not exist");
  refused(header + points + "3 0 1 1\n", 13, "face 0: vertex 1 is there twice");
  refused(header + points + "4 0 1 2 1\n", 13, "--split-quads");
  refused(header + points + "2 0 1\n", 13, "face 0 has 2 corners");
  refused(header + points + "200 0 1\n", 13, "200 as number of a face's corners");
  refused(header + points + "3 0 1\n", 14, "the file ends, expected vertex number");
  refused(header + points + "3 0 1 2\n3 0 1 2\n", 14, "unexpected '3' after the last element");
  refused(header + points, 13, "the file ends");
}

}  // namespace
}  // namespace kinemesh
