// Vertices that jump over a border or an interface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/repairs.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;

// [0,8]x[0,4] with the slit [2,6]x[1.9,2.1]; free vertices 8 below, 9 above, 10 to the left.
MeshData slit() {
  return domain_of({rectangle({0, 0}, {8, 4}), reversed(rectangle({2, 1.875}, {6, 2.125}))},
                   {{4, 1}, {4, 3}, {1, 2}});
}

double area_of(const MeshData& data) {
  double area = 0;
  for (const auto& [a, b, c] : data.triangles) {
    const Point u = data.points[b] - data.points[a], v = data.points[c] - data.points[a];
    area += 0.5 * (u.x * v.y - u.y * v.x);
  }
  return area;
}

bool is_used(const MeshData& data, int vertex) {
  return std::any_of(data.triangles.begin(), data.triangles.end(),
                     [&](const Triangle& t) { return std::count(t.begin(), t.end(), vertex) > 0; });
}

TEST(Escaped, IsAnErrorThatNamesTheVertex) {
  const Mesh built = build_mesh(slit());
  Mesh mesh = built;
  place(mesh, 8, {4.5, 2});
  const Mesh moved = mesh;
  for (const char* strategy : {"global", "remesh"}) {
    const auto outcome = repair(mesh, false, strategy);
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.defect->kind, DefectKind::Escaped);
    EXPECT_THAT(outcome.defect->vertices, ElementsAre(8));
    EXPECT_EQ(outcome.defect->where, Point(4.5, 2));
    EXPECT_TRUE(snapshot_of(mesh) == snapshot_of(moved));
  }
}

TEST(Escaped, IsCountedAndExportedWithoutFacesWhereAllowed) {
  const MeshData data = slit();
  for (const char* strategy : {"global", "remesh"}) {
    Mesh mesh = build_mesh(data);
    place(mesh, 8, {4.5, 2});
    const auto outcome = repair(mesh, true, strategy);
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_EQ(outcome.record.escaped, 1);
    EXPECT_EQ(message(validate(mesh)), "");
    const auto domain = mesh.domain();
    EXPECT_EQ(domain.n_faces(), data.n_faces() - 2);
    EXPECT_EQ(mesh.n_user_faces(), domain.n_faces());
    EXPECT_FALSE(is_used(domain, 8));
    EXPECT_DOUBLE_EQ(area_of(domain), 32 - 4 * 0.25);
  }
}

TEST(Escaped, StaysCountedAndComesHome) {
  const MeshData data = slit();
  Mesh mesh = build_mesh(data);
  place(mesh, 8, {4.5, 2});
  ASSERT_TRUE(repair(mesh, true));
  EXPECT_EQ(repair(mesh, true).record.escaped, 1) << "nothing tangled, still outside";
  place(mesh, 10, {1, 1});  // something else moves
  EXPECT_EQ(repair(mesh, true).record.escaped, 1);
  place(mesh, 8, {4, 1});
  const auto outcome = repair(mesh, true);
  ASSERT_TRUE(outcome) << message(outcome.defect);
  EXPECT_EQ(outcome.record.escaped, 0);
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_EQ(mesh.domain().n_faces(), data.n_faces());
  EXPECT_DOUBLE_EQ(area_of(mesh.domain()), 32 - 4 * 0.25);
}

// Across both borders of the slit into the domain again: nobody is on a wrong side.
TEST(Escaped, IsNotAVertexThatLandsInItsOwnLabel) {
  Mesh mesh = build_mesh(slit());
  place(mesh, 8, {4.5, 3});
  const auto outcome = repair(mesh);
  ASSERT_TRUE(outcome) << message(outcome.defect);
  EXPECT_EQ(outcome.record.escaped, 0);
  EXPECT_EQ(message(validate(mesh)), "");
  EXPECT_TRUE(is_used(mesh.domain(), 8));
}

TEST(Escaped, JumpsFromProngToProng) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const MeshData data = u_shape(60, random);
    Mesh mesh = build_mesh(data);
    for (int user = 9; user < data.n_vertices(); ++user) {
      const Point p = position_of(mesh, user);
      if (p.y > 1 && p.x < 1 && random.one_in(4)) place(mesh, user, snapped({p.x + 2.001, p.y}));
    }
    const auto outcome = repair(mesh);
    ASSERT_TRUE(outcome) << message(outcome.defect);
    EXPECT_EQ(message(validate(mesh)), "");
    EXPECT_EQ(mesh.domain().n_faces(), data.n_faces());
    EXPECT_NEAR(area_of(mesh.domain()), 7, 1e-9);
  }
}

TEST(Escaped, CrossesAnInterfaceAndComesHome) {
  Random random(2);
  MeshData data = random_grid(6, 6, random);
  for (const auto& t : data.triangles)
    data.labels.push_back(data.points[t[0]].x + data.points[t[1]].x + data.points[t[2]].x < 18 ? 1 : 2);
  Mesh mesh = build_mesh(data);
  const int user = 2 * 7 + 2;  // at (4, 4)
  place(mesh, user, {8.5, 4.25});
  Mesh refused = mesh;
  const auto failure = repair(refused);
  ASSERT_FALSE(failure);
  EXPECT_EQ(failure.defect->kind, DefectKind::Escaped);
  EXPECT_THAT(failure.defect->vertices, ElementsAre(user));

  const auto outcome = repair(mesh, true);
  ASSERT_TRUE(outcome) << message(outcome.defect);
  EXPECT_EQ(outcome.record.escaped, 1);
  EXPECT_EQ(mesh.n_user_faces(), data.n_faces());
  const auto labels = mesh.domain().labels;
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 1),
            std::count(data.labels.begin(), data.labels.end(), 1) - 2);
  EXPECT_EQ(message(validate(mesh)), "");

  place(mesh, user, {4, 4});
  ASSERT_TRUE(repair(mesh, true));
  EXPECT_EQ(message(validate(mesh)), "");
  const auto home = mesh.domain().labels;
  EXPECT_EQ(std::count(home.begin(), home.end(), 1), std::count(data.labels.begin(), data.labels.end(), 1));
}

}  // namespace
}  // namespace kinemesh::test
