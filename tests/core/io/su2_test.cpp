#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Su2, line, what);
}

const std::string elements = "NDIME= 2\nNELEM= 1\n5 0 1 2 0\n";  // lines 1 to 3
const std::string points = "NPOIN= 3\n0 0 0\n1 0 1\n0 1 2\n";    // lines 4 to 7
const std::string mesh = elements + points;

TEST(Su2, Variants) {
  const auto one = std::vector<Triangle>{{0, 1, 2}};
  EXPECT_EQ(parse(mesh, Format::Su2).mesh.triangles, one);
  EXPECT_EQ(parse(points + elements, Format::Su2).mesh.triangles, one);
  EXPECT_EQ(parse("% title\nNDIME = 2 % plane\n\nNELEM=1\n%\n 5\t0 1 2\nNPOIN= 3 3\n0 0\n1 0 1 1\n0 1\n",
                  Format::Su2)
                .mesh.triangles,
            one);
  EXPECT_EQ(parse("NZONE= 1\nIZONE= 1\n" + mesh + "NMARK= 0\n", Format::Su2).mesh.triangles, one);
}

TEST(Su2, Markers) {
  const ReadResult result = parse(mesh +
                                      "NMARK= 3\nMARKER_TAG= wall one\nMARKER_ELEMS= 2\n3 0 1\n3 1 2 0\n"
                                      "% in between\nMARKER_TAG=empty  % comment\nMARKER_ELEMS= 0\n"
                                      "MARKER_TAG= a=b\nMARKER_ELEMS=1\n3 2 0\n",
                                  Format::Su2);
  const auto& markers = result.mesh.markers;
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].name, "wall one");
  EXPECT_THAT(markers[0].edges, ElementsAre(Edge{0, 1}, Edge{1, 2}));
  EXPECT_EQ(markers[1].name, "empty");
  EXPECT_THAT(markers[1].edges, IsEmpty());
  EXPECT_EQ(markers[2].name, "a=b");
  EXPECT_THAT(markers[2].edges, ElementsAre(Edge{2, 0}));
}

TEST(Su2, MarkersOfOneNameAreOne) {
  const auto twice =
      "NMARK= 2\nMARKER_TAG= w\nMARKER_ELEMS= 1\n3 0 1\nMARKER_TAG= w\nMARKER_ELEMS= 1\n3 1 2\n";
  const auto markers = parse(mesh + twice, Format::Su2).mesh.markers;
  ASSERT_EQ(markers.size(), 1u);
  EXPECT_THAT(markers[0].edges, ElementsAre(Edge{0, 1}, Edge{1, 2}));
}

TEST(Su2, WhatSolversAddIsLeftOutWithANote) {
  const ReadResult result =
      parse(mesh +
                "NMARK= 1\nMARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_RECV= 2\n1 0 0\n1 1 0\n"
                "NPERIODIC= 1\nPERIODIC_INDEX= 0\nPERIODIC_CENTER= 0 0 0\n"
                "FFD_NBOX= 1\nFFD_TAG= box\nFFD_CORNER_POINTS= 2\n0 0\n1 1\nFFD_SURFACE_POINTS= 0\n",
            Format::Su2);
  EXPECT_THAT(result.mesh.markers, IsEmpty());
  EXPECT_THAT(result.notes, ElementsAre("markers SEND_RECEIVE were left out", "periodicity was left out",
                                        "deformation boxes (FFD) were left out"));
}

TEST(Su2, QuadrilateralsAreRefusedOrSplit) {
  const std::string quad = "NDIME= 2\nNELEM= 1\n9 0 1 2 3 0\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\n";
  refused(quad, 3, "face 0 is a quadrilateral, expected triangles; --split-quads divides it");
  EXPECT_EQ(parse(quad, Format::Su2, true).mesh.n_faces(), 2);
}

TEST(Su2, WritesTheExpectedText) {
  MeshData data;
  data.points = {{0, 0}, {1, 0.5}, {0, 1}};
  data.triangles = {{0, 1, 2}};
  data.markers = {{"wall", {{0, 1}}}};
  EXPECT_EQ(format_mesh(data, Format::Su2),
            "NDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3\n0 0 0\n1 0.5 1\n0 1 2\nNMARK= 1\nMARKER_TAG= wall\n"
            "MARKER_ELEMS= 1\n3 0 1\n");
}

TEST(Su2, RefusesWhatItCannotRepresent) {
  refused("NDIME= 3\n", 1, "NDIME= 3, expected 2");
  refused("NZONE= 2\n", 1, "NZONE= 2, expected one zone");
  refused("NELEM= 1\n5 0 1 2\n" + points, 7, "expected NDIME=");
  refused("NDIME= 2\n" + points, 6, "expected NELEM=");
  refused(elements, 4, "expected NPOIN=");
  refused("NDIME= two\n", 1, "'two' is not a whole number, expected a number after NDIME=");
  refused("NDIME=\n", 1, "'' is not a whole number");
  refused(mesh + "hello\n", 8, "'hello' where KEYWORD= was expected");
  refused(mesh + "COLOUR= red\n", 8, "unknown keyword 'COLOUR'");
  refused(mesh + points, 8, "a second NPOIN=, expected one zone");
  refused("NDIME= 2\nNELEM= 1\n10 0 1 2 3\n" + points, 3,
          "element type 10 is a tetrahedron, expected triangles (5)");
  refused("NDIME= 2\nNELEM= 1\n3 0 1 0\n" + points, 3, "element type 3 is a line, expected triangles (5)");
  refused("NDIME= 2\nNELEM= 1\n5 0 1\n" + points, 3, "the line ends, expected vertex number");
  refused("NDIME= 2\nNELEM= 1\n5 0 1 2 0 0 0\n" + points, 3, "unexpected '0' after an element");
  refused("NDIME= 2\nNELEM= 1\n5 0 1 3 0\n" + points, 3, "face 0: vertex 3 does not exist");
  refused("NDIME= 2\nNELEM= 1\n5 0 1 1 0\n" + points, 3, "face 0: vertex 1 is there twice");
  refused("NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 2 0 1 1\n" + points, 4,
          "face 1: has the same vertices as face 0");
  refused(elements + "NPOIN= 3\n0 0 0\n1 nan 1\n0 1 2\n", 6, "'nan' is not finite, expected y of a point");
  refused(elements + "NPOIN= 3\n0 0 0\n1\n0 1 2\n", 6, "the line ends, expected y of a point");
  refused(elements + "NPOIN= 3\n0 0 0\n1 0 0.5\n0 1 2\n", 6, "'0.5' is not a whole number");
}

TEST(Su2, RefusesWrongMarkers) {
  refused(mesh + "MARKER_TAG= w\nMARKER_ELEMS= 1\n3 0 3\n", 10, "marker w, edge 0: vertex 3 does not exist");
  refused(mesh + "MARKER_TAG= w\nMARKER_ELEMS= 1\n3 2 2\n", 10, "marker w, edge 0: vertex 2 is there twice");
  refused(mesh + "MARKER_TAG= w\nMARKER_ELEMS= 1\n5 0 1 2\n", 10,
          "element type 5 is a triangle, expected lines (3)");
  refused(mesh + "MARKER_TAG= w\nNMARK= 1\n", 9, "'NMARK= 1' where MARKER_ELEMS= was expected");
  refused(mesh + "MARKER_TAG= w\n", 9, "the file ends, expected MARKER_ELEMS=");
  refused(mesh + "MARKER_TAG=\nMARKER_ELEMS= 0\n", 8, "marker: the name is empty");
  refused(mesh + "MARKER_TAG= a\x01z\nMARKER_ELEMS= 0\n", 8, "has control characters");
  refused(mesh + "NMARK= 2\nMARKER_TAG= w\nMARKER_ELEMS= 0\n", 11,
          "the file ends after 1 of the NMARK= 2 markers");
}

TEST(Su2, RefusesTruncatedFilesAndWrongCounts) {
  refused("NDIME= 2\nNELEM= 2\n5 0 1 2 0\n" + points, 4,
          "'NPOIN=' is not a whole number, expected type of an element");
  refused("NDIME= 2\nNELEM= 0\n5 0 1 2 0\n" + points, 3, "'5 0 1 2 0' where KEYWORD= was expected");
  refused("NDIME= 2\nNELEM= 1000\n5 0 1 2 0\n" + points, 2,
          "1000 as number after NELEM= is more than the rest of the file");
  refused("NDIME= 2\nNELEM= -1\n" + points, 2, "-1 is negative");
  refused(elements + "NPOIN= 3\n0 0 0\n1 0 1\n", 7, "the file ends, expected x of a point");
  refused(elements + "NPOIN= 99999999999999999999\n", 4, "out of range");
  refused(mesh + "MARKER_TAG= w\nMARKER_ELEMS= 2\n3 0 1\n", 11,
          "the file ends, expected type of a marker's element");
  refused("NDIME= 2\nNELEM= 0\n" + points, 0, "no triangles");
}

}  // namespace
}  // namespace kinemesh
