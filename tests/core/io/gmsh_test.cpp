#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Gmsh, line, what);
}

const std::string format_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";            // lines 1 to 3
const std::string nodes_2 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";  // lines 4 to 9
const std::string element_2 = "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";    // lines 10 to 13
const std::string format_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes_4 =
    "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";             // lines 4 to 13
const std::string element_4 = "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";  // lines 14 to 18

std::string elements_2(const std::string& lines) {
  return format_2 + nodes_2 + "$Elements\n" + lines + "$EndElements\n";
}

TEST(Gmsh, BothVersions) {
  const auto one = std::vector<Triangle>{{0, 1, 2}};
  EXPECT_EQ(parse(format_2 + nodes_2 + element_2, Format::Gmsh).mesh.triangles, one);
  EXPECT_EQ(parse(format_4 + nodes_4 + element_4, Format::Gmsh).mesh.triangles, one);
  EXPECT_EQ(parse("$Comments\nanything $Nodes\n$EndComments\n" + format_2 + nodes_2 + element_2 +
                      "$ElementData\n1 2\n\"a\"\n$EndElementData\n$Periodic\n0\n$EndPeriodic\n",
                  Format::Gmsh)
                .mesh.triangles,
            one);
}

TEST(Gmsh, NodeNumbersAreArbitrary) {
  const std::string nodes = "$Nodes\n4\n9000000000000000000 0 0 0\n2 1 0 0\n300 0 1 0\n7 5 5 0\n$EndNodes\n";
  const auto mesh =
      parse(format_2 + nodes + "$Elements\n1\n1 2 2 0 1 300 9000000000000000000 2\n$EndElements\n",
            Format::Gmsh)
          .mesh;
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 0, 1}));
  EXPECT_EQ(mesh.points[3], Point(5, 5));
  const auto shifted = parse(format_2 + "$Nodes\n3\n11 0 0 0\n12 1 0 0\n13 0 1 0\n$EndNodes\n" +
                                 "$Elements\n1\n1 2 2 0 1 11 12 13\n$EndElements\n",
                             Format::Gmsh);
  EXPECT_THAT(shifted.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Gmsh, PhysicalGroupsBecomeMarkersAndLabels) {
  const std::string names =
      "$PhysicalNames\n4\n1 5 \"the wall\"\n2 8 \"steel\"\n0 1 \"corner\"\n1 6 "
      "\"unused\"\n$EndPhysicalNames\n";
  const auto mesh = parse(format_2 + names + nodes_2 +
                              "$Elements\n6\n1 15 2 1 1 1\n2 1 2 5 1 1 2\n3 1 2 9 1 2 3\n4 1 2 0 1 3 1\n"
                              "5 1 2 -5 1 3 1\n6 2 2 8 1 1 2 3\n$EndElements\n",
                          Format::Gmsh)
                        .mesh;
  ASSERT_EQ(mesh.markers.size(), 3u);
  EXPECT_EQ(mesh.markers[0].name, "the wall");
  EXPECT_THAT(mesh.markers[0].edges, ElementsAre(Edge{0, 1}, Edge{2, 0}));
  EXPECT_EQ(mesh.markers[1].name, "unused");
  EXPECT_THAT(mesh.markers[1].edges, IsEmpty());
  EXPECT_EQ(mesh.markers[2].name, "9");
  EXPECT_THAT(mesh.markers[2].edges, ElementsAre(Edge{1, 2}));
  EXPECT_THAT(mesh.labels, ElementsAre(8));
  EXPECT_THAT(mesh.label_names, ElementsAre(std::pair<const int, std::string>(8, "steel")));
}

TEST(Gmsh, PhysicalGroupsOfEntitiesInVersion4) {
  const std::string names = "$PhysicalNames\n2\n1 5 \"wall\"\n2 8 \"steel\"\n$EndPhysicalNames\n";
  const std::string entities =
      "$Entities\n1 2 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 2 5 6 2 1 -1\n2 0 0 0 1 0 0 1 -5 0\n3 0 0 0 1 1 0 2 8 9 "
      "2 1 -2\n"
      "$EndEntities\n";
  const std::string elements =
      "$Elements\n4 4 1 9\n0 1 15 1\n1 1\n1 1 1 1\n2 1 2\n1 2 1 1\n3 2 3\n2 3 2 1\n9 1 2 3\n$EndElements\n";
  const ReadResult result = parse(format_4 + names + entities + nodes_4 + elements, Format::Gmsh);
  const auto& mesh = result.mesh;
  EXPECT_THAT(mesh.labels, ElementsAre(8));
  EXPECT_THAT(result.notes, ElementsAre("faces in several physical surfaces keep the first as their label"));
  ASSERT_EQ(mesh.markers.size(), 2u);
  EXPECT_EQ(mesh.markers[0].name, "wall");
  EXPECT_THAT(mesh.markers[0].edges, ElementsAre(Edge{0, 1}, Edge{1, 2}));
  EXPECT_EQ(mesh.markers[1].name, "6");
  EXPECT_THAT(mesh.markers[1].edges, ElementsAre(Edge{0, 1}));
}

TEST(Gmsh, ParametricNodesInVersion4) {
  const std::string nodes =
      "$Nodes\n2 3 1 3\n1 1 1 1\n1\n0 0 0 0.5\n2 1 1 2\n2\n3\n1 0 0 0.1 0.2\n0 1 0 0.3 0.4\n$EndNodes\n";
  EXPECT_THAT(parse(format_4 + nodes + element_4, Format::Gmsh).mesh.points,
              ElementsAre(Point(0, 0), Point(1, 0), Point(0, 1)));
}

TEST(Gmsh, WritesTheExpectedText) {
  MeshData mesh;
  mesh.points = {{0, 0}, {1, 0.5}, {0, 1}};
  mesh.triangles = {{0, 1, 2}};
  mesh.labels = {4};
  mesh.label_names[4] = "steel";
  mesh.markers = {{"wall", {{0, 1}}}};
  EXPECT_EQ(
      format_mesh(mesh, Format::Gmsh),
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"wall\"\n2 4 "
      "\"steel\"\n$EndPhysicalNames\n"
      "$Nodes\n3\n1 0 0 0\n2 1 0.5 0\n3 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 1 1 1 2\n2 2 2 4 1 1 2 3\n"
      "$EndElements\n");
}

TEST(Gmsh, RefusesFormatsItCannotRead) {
  refused("hello\n", 1, "'hello' where a section such as $Nodes was expected");
  refused("$Nodes\n3\n", 1, "expected $MeshFormat first");
  refused("$MeshFormat\n4.0 0 8\n", 2, "version '4.0' of the format, expected 2.2 or 4.1");
  refused("$MeshFormat\n1 0 8\n", 2, "version '1' of the format");
  refused("$MeshFormat\n2.2 1 8\n", 2, "a binary file, expected ASCII");
  refused("$MeshFormat\n2.2 0 8\n$Nodes\n", 3, "'$Nodes' where $EndMeshFormat was expected");
  refused(format_4 + "$PartitionedEntities\n", 4, "the mesh is partitioned");
  refused(format_2 + "$ParametricNodes\n", 4, "section $ParametricNodes, expected $Nodes");
  refused(format_2 + "$Whatever\n1\n", 6, "the file ends, expected $EndWhatever");
  refused(format_2, 4, "the file ends, expected $Nodes");
  refused(format_2 + nodes_2, 10, "the file ends, expected $Elements");
  refused(format_2 + element_2, 4, "$Elements before $Nodes");
  refused(format_2 + nodes_2 + nodes_2, 10, "a second section $Nodes");
  refused(format_2 + nodes_2 + element_2 + element_2, 14, "a second section $Elements");
  refused(format_2 + nodes_2 + element_2 + "$PhysicalNames\n", 14, "$PhysicalNames after $Elements");
}

TEST(Gmsh, RefusesWrongNames) {
  refused(format_2 + "$PhysicalNames\n1\n1 1 wall\n$EndPhysicalNames\n", 6, "in double quotes");
  refused(format_2 + "$PhysicalNames\n1\n1 1 \"a\"b\"\n$EndPhysicalNames\n", 6, "quotes within the name");
  refused(format_2 + "$PhysicalNames\n1\n1 1 \"\"\n$EndPhysicalNames\n", 6, "marker: the name is empty");
  refused(format_2 + "$PhysicalNames\n1\n2 1 \"a\x01\"\n$EndPhysicalNames\n", 6, "has control characters");
  refused(format_2 + "$PhysicalNames\n2\n1 1 \"a\"\n$EndPhysicalNames\n", 7, "is not a whole number");
}

TEST(Gmsh, RefusesWrongNodes) {
  refused(format_2 + "$Nodes\n3\n1 0 0 0\n1 1 0 0\n3 0 1 0\n$EndNodes\n", 8, "node 1 is there twice");
  refused(format_2 + "$Nodes\n1\n0 0 0 0\n", 6, "node number 0, expected numbers from 1");
  refused(format_2 + "$Nodes\n1\n1 0 0 0.5\n", 6, "vertex 0 has z = 0.5");
  refused(format_2 + "$Nodes\n1\n1 0 inf 0\n", 6, "'inf' is not finite");
  refused(format_2 + "$Nodes\n1\n1 0 0\n$EndNodes\n", 6, "the line ends, expected z of a node");
  refused(format_2 + "$Nodes\n2\n1 0 0 0\n$EndNodes\n", 7, "'$EndNodes' is not a whole number");
  refused(format_2 + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", 7, "'2' where $EndNodes was expected");
  refused(format_2 + "$Nodes\n1000\n1 0 0 0\n", 5, "1000 as number of nodes");
  refused(format_4 + "$Nodes\n1 4 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n", 12,
          "3 nodes in the blocks, expected 4");
  refused(format_4 + "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n", 12,
          "the file ends, expected x of a node");
}

TEST(Gmsh, RefusesWrongElements) {
  refused(elements_2("1\n1 2 2 0 1 1 2 4\n"), 12, "node 4 does not exist");
  refused(elements_2("1\n1 2 2 0 1 1 2 0\n"), 12, "node 0 does not exist");
  refused(elements_2("1\n1 2 2 0 1 1 2\n"), 12, "the line ends, expected the number of a node");
  refused(elements_2("1\n1 2 2 0 1 1 2 3 1\n"), 12, "unexpected '1' after an element");
  refused(elements_2("1\n1 2 2 0 1 1 2 2\n"), 12, "face 0: vertex 1 is there twice");
  refused(elements_2("1\n1 9 2 0 1 1 2 3 1 2 3\n"), 12,
          "element type 9 is a second-order triangle, expected triangles (2)");
  refused(elements_2("1\n1 4 2 0 1 1 2 3 1\n"), 12, "element type 4 is a tetrahedron");
  refused(elements_2("1\n1 3 2 0 1 1 2 3 1\n"), 12, "--split-quads");
  refused(elements_2("1\n1 2 4 0 1 1 3 1 2 3\n"), 12, "the mesh is partitioned");
  refused(elements_2("1\n1 2 2 -2147483648 1 1 2 3\n"), 12, "label -2147483648 is reserved");
  refused(elements_2("2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 3 2 1\n"), 13, "face 1: has the same vertices as face 0");
  refused(elements_2("2\n1 2 2 0 1 1 2 3\n2 1 2 7 1 2 2\n"), 13, "marker 7, edge 0: vertex 1 is there twice");
  refused(elements_2("0\n"), 0, "no triangles");
  refused(elements_2("1000\n1 2 2 0 1 1 2 3\n"), 11, "1000 as number of elements");
  refused(format_4 + nodes_4 + "$Elements\n1 2 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n", 17,
          "1 elements in the blocks, expected 2");
}

TEST(Gmsh, RefusesWrongEntities) {
  refused(format_4 + "$Entities\n0 1 0 0\n1 0 0 0 1 0 0 99 1 0\n$EndEntities\n", 6,
          "99 as number of physical groups");
  refused(format_4 + "$Entities\n0 1 0 0\n1 0 0 0 1 0 0 1 -2147483648 0\n$EndEntities\n", 6,
          "is no physical group");
}

}  // namespace
}  // namespace kinemesh
