// What cannot be a mesh, or cannot be embedded, is refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "kinemesh/build.h"
#include "kinemesh/orient.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::string refusal(const MeshData& data, const BuildOptions& options = {}) {
  try {
    build_mesh(data, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Defect defect_of(const MeshData& data, const BuildOptions& options = {}) {
  try {
    build_mesh(data, options);
  } catch (const NoEmbedding& e) {
    return e.defect();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

// Two triangulated loops as parts of one mesh, whatever they do to each other.
MeshData together(const MeshData& a, const MeshData& b) {
  MeshData both = a;
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (auto t : b.triangles) {
    for (int& v : t) v += a.n_vertices();
    both.triangles.push_back(t);
  }
  return both;
}

// Neither arrays nor files of this size are made here.
TEST(Refused, MoreThanNumbersGo) {
  EXPECT_EQ(2 * Mesh::side(Face(most_items - 1), 2) + 1, std::numeric_limits<int>::max() - 10);
  EXPECT_NO_THROW(check_size(most_items, "faces"));
  try {
    check_size(std::size_t{1} << 28, "faces");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "268435456 faces, at most 268435455 expected");
  }
}

TEST(Refused, NumbersThatDoNotFit) {
  EXPECT_THAT(refusal({}), HasSubstr("no faces"));
  auto data = four_triangles();
  data.triangles[2] = {2, 3, 5};
  EXPECT_THAT(refusal(data), HasSubstr("face 2: no vertex has number 5"));
  data.triangles[2] = {2, -1, 4};
  EXPECT_THAT(refusal(data), HasSubstr("face 2: no vertex has number -1"));
  data.triangles[2] = {2, 4, 4};
  EXPECT_THAT(refusal(data), HasSubstr("face 2: two corners"));
  data = four_triangles();
  data.labels = {1, 2};
  EXPECT_THAT(refusal(data), HasSubstr("one label per face"));
  data.labels = {0, 0, 0, padding_label};
  EXPECT_THAT(refusal(data), HasSubstr("face 3: this label is reserved"));
  EXPECT_THAT(refusal(four_triangles(), {.fixed = {0, 5}}), HasSubstr("fixed vertex 5"));
}

TEST(Refused, PositionsAndFramesThatAreNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  auto data = four_triangles();
  data.points[3].y = -infinity;
  EXPECT_THAT(refusal(data), HasSubstr("vertex 3 has a position that is not finite"));
  data.points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(data), HasSubstr("vertex 3"));
  for (const double frame : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(refusal(four_triangles(), {.frame = frame}), HasSubstr("frame"));
  EXPECT_THAT(refusal(mapped(four_triangles(), {8e307, 8e307}, {0, 0}), {.frame = 1}), HasSubstr("frame"));
}

TEST(Refused, MarkersOffTheEdges) {
  auto data = four_triangles();
  for (const Edge& edge : {Edge{0, 2}, Edge{0, 9}, Edge{-1, 0}, Edge{1, 1}}) {
    data.markers = {{"good", {{0, 1}}}, {"bad", {edge}}};
    EXPECT_THAT(refusal(data),
                HasSubstr("marker bad: " + std::to_string(edge[0]) + "-" + std::to_string(edge[1])));
  }
  // An edge of the padding is none of the domain's.
  Random random(1);
  auto u = u_shape(5, random);
  u.markers = {{"bridge", {{4, 7}}}};
  EXPECT_THAT(refusal(u), HasSubstr("marker bridge: 4-7"));
}

TEST(Refused, EdgesOfThreeFacesOrTwoWays) {
  auto data = four_triangles();
  data.triangles.push_back({0, 1, 2});
  EXPECT_THAT(refusal(data), HasSubstr("face 4"));
  data = four_triangles();
  std::swap(data.triangles[1][0], data.triangles[1][1]);
  EXPECT_THAT(refusal(data), HasSubstr("wound the same way"));
  data = four_triangles();
  data.triangles.push_back(data.triangles[0]);
  EXPECT_THAT(refusal(data), HasSubstr("an edge has more than two faces"));
}

TEST(Refused, ClosedSurfaces) {
  MeshData tetrahedron;
  tetrahedron.points = {{0, 0}, {1, 0}, {0, 1}, {0.3, 0.3}};
  tetrahedron.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  EXPECT_EQ(defect_of(tetrahedron).kind, DefectKind::NotPlanar);
  EXPECT_THAT(refusal(tetrahedron), HasSubstr("closed"));
  const auto beside = together(mapped(four_triangles(), {1, 1}, {5, 5}), tetrahedron);
  EXPECT_EQ(defect_of(beside).kind, DefectKind::NotPlanar);
}

TEST(Refused, HandlesAndMoebiusStrips) {
  // A torus of 3 x 3 cells with one triangle missing, its border a proper triangle in the plane.
  MeshData torus;
  for (int i = 0; i < 9; ++i) torus.points.push_back({0.1 * i * i, 0.1 * (i % 4)});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      const auto at = [](int column, int row) { return 3 * (row % 3) + column % 3; };
      torus.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      torus.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  torus.triangles.erase(torus.triangles.begin());  // the border runs 4, 1, 0
  torus.points[0] = {0, 0};
  torus.points[4] = {1, 0};
  torus.points[1] = {0, 1};
  EXPECT_EQ(defect_of(torus).kind, DefectKind::NotPlanar);
  EXPECT_THAT(refusal(torus), HasSubstr("handles"));

  MeshData strip;
  strip.points = {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {1, 2}};
  strip.triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}};
  EXPECT_THROW(make_consistent(strip), FaceError);
  EXPECT_THAT(refusal(strip), HasSubstr("face"));
}

TEST(Refused, AFanOnTopOfAnInnerVertex) {
  auto data = four_triangles();
  data.points.insert(data.points.end(), {{1.5, 0.8}, {1.5, 1.2}});
  data.triangles.push_back({4, 5, 6});  // at vertex 4, inside the domain
  EXPECT_NE(refusal(data), "accepted");
}

TEST(Refused, BordersThatCross) {
  const auto crossing =
      together(domain_of({rectangle({0, 0}, {2, 2})}), domain_of({rectangle({1, -1}, {3, 1})}));
  const auto defect = defect_of(crossing);
  EXPECT_EQ(defect.kind, DefectKind::CrossingEdges);
  ASSERT_EQ(defect.edges.size(), 2u);
  EXPECT_TRUE(defect.where == Point(1, 0) || defect.where == Point(2, 1));
  EXPECT_THAT(refusal(crossing), HasSubstr("crosses"));
  // A bow-tie of one loop.
  MeshData twisted;
  twisted.points = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  twisted.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(defect_of(twisted).kind, DefectKind::CrossingEdges);
  EXPECT_EQ(defect_of(twisted).where, Point(1, 1));
}

TEST(Refused, BordersThatTouch) {
  const auto corner = together(domain_of({rectangle({0, 0}, {2, 2})}), domain_of({{{2, 1}, {3, 0}, {3, 2}}}));
  const auto on_edge = defect_of(corner);
  EXPECT_EQ(on_edge.kind, DefectKind::VertexOnEdge);
  EXPECT_THAT(on_edge.vertices, ElementsAre(4));
  EXPECT_THAT(on_edge.edges.at(0), UnorderedElementsAre(1, 2));
  EXPECT_EQ(on_edge.where, Point(2, 1));

  const auto same_place =
      together(domain_of({rectangle({0, 0}, {2, 2})}), domain_of({rectangle({2, 2}, {3, 3})}));
  const auto coincident = defect_of(same_place);
  EXPECT_EQ(coincident.kind, DefectKind::CoincidentVertices);
  EXPECT_THAT(coincident.vertices, UnorderedElementsAre(2, 4));
}

TEST(Refused, PartsThatCoverEachOther) {
  const auto inside =
      together(domain_of({rectangle({0, 0}, {9, 9})}), domain_of({rectangle({1, 1}, {2, 2})}));
  EXPECT_EQ(defect_of(inside).kind, DefectKind::InsideOut);
  const auto twice = together(four_triangles(), four_triangles());
  EXPECT_EQ(defect_of(twice).kind, DefectKind::CoincidentVertices);
}

TEST(Refused, BordersInsideOut) {
  auto data = four_triangles();
  for (auto& p : data.points) p.x = -p.x;
  EXPECT_EQ(defect_of(data).kind, DefectKind::InsideOut);
  EXPECT_EQ(defect_of(data, {.frame = 1}).kind, DefectKind::InsideOut);
}

TEST(Refused, BordersWithoutArea) {
  for (const double frame : {0.0, 1.0}) {
    MeshData flat;
    flat.points = {{0, 0}, {1, 0}, {2, 0}};
    flat.triangles = {{0, 1, 2}};
    const auto defect = defect_of(flat, {.frame = frame});
    EXPECT_EQ(defect.kind, DefectKind::VertexOnEdge);
    EXPECT_THAT(defect.vertices, ElementsAre(1));
    flat.points[2] = {0, 0};
    EXPECT_EQ(defect_of(flat, {.frame = frame}).kind, DefectKind::CoincidentVertices);
  }
}

}  // namespace
}  // namespace kinemesh::test
