// Where no valid mesh exists: the culprits are named and nothing has changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

// All strategies fail, with everything as it was; global's defect.
Defect expect_failure(const Mesh& before, bool allow_escaped = false) {
  Defect defect;
  for (const char* strategy : {"remesh", "local", "global"}) {
    Mesh mesh = before;
    const auto outcome = repair(mesh, allow_escaped, strategy);
    EXPECT_FALSE(outcome) << strategy;
    EXPECT_TRUE(snapshot_of(mesh) == snapshot_of(before)) << strategy;
    if (outcome.defect) defect = *outcome.defect;
  }
  return defect;
}

Edge sorted(Edge edge) {
  if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
  return edge;
}

Edge sorted(const UserEdge& edge) {
  return sorted(Edge{edge[0], edge[1]});
}

std::vector<Edge> sorted_edges(const Defect& defect) {
  std::vector<Edge> edges;
  for (const auto& edge : defect.edges) edges.push_back(sorted(edge));
  std::sort(edges.begin(), edges.end());
  return edges;
}

// [0,6]^2 with the hole [2,4]^2, vertices 0 to 3 outside and 4 to 7 (clockwise from lower left) at the hole.
MeshData square_with_hole() {
  return domain_of({rectangle({0, 0}, {6, 6}), reversed(rectangle({2, 2}, {4, 4}))});
}

int vertex_at(const MeshData& data, const Point& p) {
  return static_cast<int>(std::find(data.points.begin(), data.points.end(), p) - data.points.begin());
}

TEST(Failure, NamesBothCoincidentVertices) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    Mesh mesh = build_mesh(random_square(40, random));
    const int a = 4 + random.below(36), b = 4 + random.below(36);
    if (a == b) continue;
    place(mesh, a, position_of(mesh, b));
    const auto defect = expect_failure(mesh);
    EXPECT_EQ(defect.kind, DefectKind::CoincidentVertices);
    EXPECT_THAT(defect.vertices, UnorderedElementsAre(a, b));
    EXPECT_EQ(defect.where, position_of(mesh, b));
  }
}

TEST(Failure, TakesZeroAndMinusZeroForOnePlace) {
  MeshData data = mapped(four_triangles(), {1, 1}, {-1, -1});
  data.points.push_back({0.25, 0});
  data.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}, {3, 0, 4}};
  Mesh mesh = build_mesh(data);
  place(mesh, 4, {0.0, -0.0});
  place(mesh, 5, {-0.0, 0.0});
  EXPECT_THAT(expect_failure(mesh).vertices, UnorderedElementsAre(4, 5));
}

TEST(Failure, NamesAnInteriorVertexThatLandsOnACorner) {
  Mesh mesh = build_mesh(four_triangles());
  place(mesh, 4, {2, 2});
  EXPECT_THAT(expect_failure(mesh).vertices, UnorderedElementsAre(2, 4));
}

TEST(Failure, NamesTheCrossingBordersAndThePoint) {
  const MeshData data = square_with_hole();
  for (const double frame : {0.0, 0.5}) {
    Mesh mesh = build_mesh(data, {.frame = frame});
    const int corner = vertex_at(data, {4, 4}), right = vertex_at(data, {4, 2}), up = vertex_at(data, {2, 4});
    // The hole's corner goes through the outer border, from its other side: without a frame the hull is left.
    place(mesh, corner, {7, 3.5});
    const auto defect = expect_failure(mesh, true);
    if (frame == 0.0) continue;  // crossing or leaving, both are true
    EXPECT_EQ(defect.kind, DefectKind::CrossingEdges);
    const std::vector<Edge> with_right{{1, 2}, sorted({corner, right})},
        with_up{{1, 2}, sorted({corner, up})};
    EXPECT_THAT(sorted_edges(defect), testing::AnyOf(with_right, with_up));
    EXPECT_DOUBLE_EQ(defect.where.x, 6);
    EXPECT_GT(defect.where.y, 2);
    EXPECT_LT(defect.where.y, 4);
  }
}

TEST(Failure, NamesAVertexOnABorderAndOnAMarker) {
  MeshData data = square_with_hole();
  data =
      domain_of({rectangle({0, 0}, {6, 6}), reversed(rectangle({2, 2}, {4, 4}))}, {{1, 3}, {5, 3}, {5, 5}});
  Mesh mesh = build_mesh(data);
  place(mesh, 8, {4, 3});
  const auto on_border = expect_failure(mesh, true);
  EXPECT_EQ(on_border.kind, DefectKind::VertexOnEdge);
  EXPECT_THAT(on_border.vertices, ElementsAre(8));
  EXPECT_EQ(on_border.where, Point(4, 3));
  EXPECT_EQ(sorted(on_border.edges.at(0)), sorted(Edge{vertex_at(data, {4, 2}), vertex_at(data, {4, 4})}));

  data.markers = {{"wire", {{9, 10}}}};
  Mesh wired = build_mesh(data);
  place(wired, 8, {5, 4});
  const auto on_marker = expect_failure(wired, true);
  EXPECT_EQ(on_marker.kind, DefectKind::VertexOnEdge);
  EXPECT_EQ(sorted(on_marker.edges.at(0)), (Edge{9, 10}));
}

// Exactly on the line of the frame, on its corner, or beyond, alone or with all others.
TEST(Failure, NamesAVertexThatReachesTheFrame) {
  const Mesh built = build_mesh(four_triangles(), {.frame = 0.5});
  const Point high = built.position(built.frame()[2]), low = built.position(built.frame()[0]);
  const auto expect_lost = [&](int user, const Point& p) {
    Mesh mesh = built;
    place(mesh, user, p);
    const auto defect = expect_failure(mesh, true);
    EXPECT_EQ(defect.kind, DefectKind::LeftDomain) << p.x << " " << p.y;
    EXPECT_THAT(defect.vertices, ElementsAre(user));
    EXPECT_EQ(defect.where, p);
  };
  for (const Point& p : {Point(high.x, 1), Point(1, high.y), Point(9, 9), Point(1e300, 1e200)}) {
    expect_lost(2, p);  // a corner of the domain, outward
    expect_lost(4, p);
  }
  for (const Point& p : {Point(low.x, 1), Point(1, low.y), Point(-9, 1), Point(-1e300, -1)})
    expect_lost(4, p);
  expect_lost(4, high);
  expect_lost(4, low);
}

TEST(Failure, NamesADomainBeyondItsFrame) {
  Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  for (int user = 0; user < 5; ++user) place(mesh, user, position_of(mesh, user) + Point(50, 1));
  EXPECT_EQ(expect_failure(mesh).kind, DefectKind::LeftDomain);
}

TEST(Failure, NamesAVertexOutsideTheHull) {
  for (const Point& p : {Point(3, 1), Point(3, 3), Point(1, -1e-9), Point(-1e9, 1e9)}) {
    Mesh mesh = build_mesh(four_triangles());
    place(mesh, 4, p);
    const auto defect = expect_failure(mesh);
    EXPECT_EQ(defect.kind, DefectKind::LeftDomain);
    EXPECT_THAT(defect.vertices, ElementsAre(4));
  }
}

// A hull edge that padding alone has, and so no constraint.
TEST(Failure, NamesAVertexOnAHullEdgeOfThePadding) {
  Random random(4);
  const MeshData data = u_shape(30, random);
  for (const Point& p : {Point(1.5, 3), Point(1.25, 3), Point(1.5, 3.5)}) {
    Mesh mesh = build_mesh(data);
    place(mesh, data.n_vertices() - 1, p);
    const auto defect = expect_failure(mesh, true);
    EXPECT_EQ(defect.kind, DefectKind::LeftDomain);
    EXPECT_THAT(defect.vertices, ElementsAre(data.n_vertices() - 1));
  }
}

// Faces with all corners on the ring have label 2, others 1 or, right of x = 4, 3.
MeshData labelled(MeshData data, const Loop& ring) {
  for (const auto& t : data.triangles) {
    const Point middle = (data.points[t[0]] + data.points[t[1]] + data.points[t[2]]) / 3.0;
    const bool in_ring = std::all_of(t.begin(), t.end(), [&](int v) {
      return std::find(ring.begin(), ring.end(), data.points[v]) != ring.end();
    });
    data.labels.push_back(in_ring ? 2 : middle.x < 4 ? 1 : 3);
  }
  return data;
}

// No images cross and a constrained triangulation exists: only the labels tell.
TEST(Failure, NamesAClosedInterfaceTurnedInsideOut) {
  const Loop ring{{1, 1}, {3, 1}, {2, 3}};
  const auto data = domain_of({rectangle({0, 0}, {4, 4})}, {{3, 3}, {2, 3.5}, {0.5, 2}}, {ring});
  Mesh mesh = build_mesh(labelled(data, ring));
  place(mesh, 4, {3, 1});
  place(mesh, 5, {1, 1});
  const auto defect = expect_failure(mesh, true);
  EXPECT_EQ(defect.kind, DefectKind::LabelsMeet);
  ASSERT_EQ(defect.edges.size(), 2u);
  const std::vector<Edge> ring_edges{{4, 5}, {4, 6}, {5, 6}};
  EXPECT_THAT(ring_edges, testing::Contains(sorted(defect.edges[1])));
}

TEST(Failure, NamesAHoleTurnedInsideOut) {
  const MeshData data = square_with_hole();
  Mesh mesh = build_mesh(data);
  for (const auto& p : {Point(2, 2), Point(2, 4), Point(4, 2), Point(4, 4)})
    place(mesh, vertex_at(data, p), {6 - p.x, p.y});
  EXPECT_EQ(expect_failure(mesh, true).kind, DefectKind::LabelsMeet);
}

// An island of label 2 in label 1 jumps the line x = 4 into label 3.
TEST(Failure, NamesAnIslandThatJumpedAnInterface) {
  const Loop ring{{1, 1}, {3, 1}, {2, 3}}, border{{0, 0}, {4, 0}, {8, 0}, {8, 4}, {4, 4}, {0, 4}};
  const auto data = labelled(domain_of({border}, {{6, 3.5}, {7, 0.5}}, {ring, {{4, 0}, {4, 4}}}), ring);
  Mesh mesh = build_mesh(data);
  for (const auto& p : ring) place(mesh, vertex_at(data, p), {p.x + 4, p.y});
  const auto defect = expect_failure(mesh, true);
  EXPECT_EQ(defect.kind, DefectKind::LabelsMeet) << defect.message();
  EXPECT_EQ(defect.edges.size(), 2u);
}

// Numbered as a hull edge of the padding: the domain's edge has no place left.
TEST(Failure, NamesAMarkedEdgeOutsideTheDomain) {
  MeshData data;
  data.points = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  data.triangles = {{3, 4, 5}, {3, 5, 6}, {3, 6, 7}, {3, 7, 0}, {0, 1, 3}, {1, 2, 3}};
  data.markers = {{"bridge", {{3, 6}}}};
  const auto on_hull = expect_failure(build_mesh(data), true);
  EXPECT_EQ(on_hull.kind, DefectKind::MissingEdge);
  EXPECT_EQ(sorted(on_hull.edges.at(0)), (Edge{3, 6}));
  EXPECT_EQ(expect_failure(build_mesh(data, {.frame = 0.5}), true).kind, DefectKind::LabelsMeet);
  data.markers.clear();
  Mesh unmarked = build_mesh(data);
  EXPECT_TRUE(repair(unmarked));
  EXPECT_EQ(message(validate(unmarked)), "");
}

// Islands that move: no face of the domain is inverted, only padding.
TEST(PaddingAlone, IsRepairedAndNamesNoSeed) {
  int tangled = 0;
  for (int seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    std::vector<Loop> islands;
    for (int i = 0; i < 9; ++i) islands.push_back(rectangle({i % 3, i / 3}, Point(i % 3, i / 3) + 0.2));
    Mesh mesh = build_mesh(domain_of(islands), {.frame = 0.5});
    const int n_faces = mesh.n_user_faces();
    for (int i = 0; i < 9; ++i) {
      const Point shift{random.between(-0.3, 0.3), random.between(-0.3, 0.3)};
      for (int user = 4 * i; user < 4 * i + 4; ++user) place(mesh, user, position_of(mesh, user) + shift);
    }
    const auto outcome = repair(mesh);
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_EQ(mesh.domain().n_faces(), n_faces);
    tangled += !outcome.record.regions.empty();
    for (const auto& region : outcome.record.regions) EXPECT_EQ(region.seed, none);
  }
  EXPECT_GT(tangled, 50);
}

}  // namespace
}  // namespace kinemesh::test
