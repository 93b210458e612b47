// Every defect, made on purpose, is named.
#include "kinemesh/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "kinemesh/build.h"
#include "tests/core/mesh/flips.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

Defect defect_of(const Mesh& mesh) {
  const auto defect = validate(mesh);
  EXPECT_TRUE(defect);
  return defect ? *defect : Defect{};
}

Mesh square_with_centre_at(const Point& p) {
  Mesh mesh = build_mesh(four_triangles());
  mesh.positions()[mesh.vertex_of_user(UserVertex(4))] = p;
  return mesh;
}

Side side_between(const Mesh& mesh, UserVertex user_a, UserVertex user_b) {
  for (const Face face : mesh.faces())
    for (const Side side : Mesh::sides(face))
      if (mesh.user_vertex(mesh.from(side)) == user_a && mesh.user_vertex(mesh.to(side)) == user_b)
        return side;
  return none;
}

TEST(Validate, FindsNothingInGoodMeshes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    EXPECT_FALSE(validate(build_mesh(u_shape(50, random), {.frame = 0.1})));
    EXPECT_FALSE(validate(build_mesh(random_grid(5, 5, random))));
  }
}

TEST(Validate, NamesAPositionThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto defect = defect_of(square_with_centre_at({1, bad}));
    EXPECT_EQ(defect.kind, DefectKind::NonFinitePosition);
    EXPECT_THAT(defect.vertices, ElementsAre(4));
    EXPECT_THAT(defect.message(), HasSubstr("vertex 4"));
  }
}

TEST(Validate, NamesInvertedAndFlatFaces) {
  const auto inverted = defect_of(square_with_centre_at({3, 1}));
  EXPECT_EQ(inverted.kind, DefectKind::InvertedFace);
  EXPECT_THAT(inverted.faces, ElementsAre(1));
  EXPECT_THAT(inverted.vertices, UnorderedElementsAre(1, 2, 4));
  EXPECT_THAT(inverted.message(), HasSubstr("face 1 (1, 2, 4) is inverted"));
  const auto flat = defect_of(square_with_centre_at({2, 1}));
  EXPECT_EQ(flat.kind, DefectKind::FlatFace);
  EXPECT_THAT(flat.faces, ElementsAre(1));
}

TEST(Validate, NamesAHullThatIsNotConvex) {
  Mesh mesh = square_with_centre_at({0.5, 0.5});
  mesh.positions()[mesh.vertex_of_user(UserVertex(2))] = {0.8, 0.8};  // all faces still upright
  const auto defect = defect_of(mesh);
  EXPECT_EQ(defect.kind, DefectKind::HullMoved);
  EXPECT_THAT(defect.vertices, ElementsAre(2));
}

TEST(Validate, SeesAHullThatGoesAroundTwice) {
  constexpr int n = 12;
  MeshData data;
  data.points = circle({0, 0}, 1, n);
  data.points.push_back({0, 0});
  for (int i = 0; i < n; ++i) data.triangles.push_back({i, (i + 1) % n, n});
  Mesh mesh = build_mesh(data);
  for (int i = 0; i < n; ++i) {
    const double angle = 4 * std::numbers::pi * (i + 0.1) / n;
    mesh.positions()[mesh.vertex_of_user(UserVertex(i))] = {std::cos(angle), std::sin(angle)};
  }
  const auto defect = defect_of(mesh);
  EXPECT_EQ(defect.kind, DefectKind::HullMoved);
  EXPECT_THAT(defect.message(), HasSubstr("more than once"));
}

TEST(Validate, SeesSidesThatDoNotBelongTogether) {
  Mesh mesh = build_mesh(four_triangles());
  auto patch = flip_of(mesh, side_between(mesh, UserVertex(4), UserVertex(0)));
  std::swap(patch.across[0], patch.across[1]);
  mesh.splice(patch);
  EXPECT_EQ(defect_of(mesh).kind, DefectKind::Connectivity);
  EXPECT_THAT(defect_of(mesh).message(), HasSubstr("the sides of an edge differ at face"));
}

TEST(Validate, MissesAConstrainedEdge) {
  auto data = four_triangles();
  data.markers = {{"wire", {{0, 4}}}};
  Mesh mesh = build_mesh(data);
  auto patch = flip_of(mesh, side_between(mesh, UserVertex(4), UserVertex(0)));
  mesh.splice(patch);
  const auto defect = defect_of(mesh);
  EXPECT_EQ(defect.kind, DefectKind::MissingEdge);
  EXPECT_THAT(defect.edges.at(0), UnorderedElementsAre(0, 4));
  EXPECT_THAT(defect.message(), HasSubstr("is not in the mesh"));
}

TEST(Validate, SeesAConstraintInAnothersPlace) {
  auto data = four_triangles();
  data.markers = {{"wire", {{0, 4}}}};
  Mesh mesh = build_mesh(data);
  const Side side = side_between(mesh, UserVertex(4), UserVertex(0));
  auto patch = flip_of(mesh, side);
  patch.lines.push_back({Mesh::side(Face(0), 2), mesh.constraint_of(side)});
  mesh.splice(patch);
  EXPECT_EQ(defect_of(mesh).kind, DefectKind::MissingEdge);
  EXPECT_THAT(defect_of(mesh).message(), HasSubstr("its place is taken"));
}

TEST(Validate, SeesLabelsThatMeetOrChange) {
  Random random(3);
  Mesh mesh = build_mesh(random_grid(4, 4, random));
  Face face{0};
  while (!can_flip(mesh, Mesh::side(face, 0))) ++face;
  auto patch = flip_of(mesh, Mesh::side(face, 0));
  patch.labels[0] = 5;
  mesh.splice(patch);
  EXPECT_EQ(defect_of(mesh).kind, DefectKind::Connectivity);
  EXPECT_THAT(defect_of(mesh).message(), HasSubstr("two labels meet"));

  MeshData single;
  single.points = {{0, 0}, {1, 0}, {0, 1}};
  single.triangles = {{0, 1, 2}};
  Mesh relabelled = build_mesh(single);
  FaceState same = relabelled.save(Face(0));
  same.label = 5;
  relabelled.restore({&same, 1});
  EXPECT_EQ(defect_of(relabelled).kind, DefectKind::MissingEdge);
  EXPECT_THAT(defect_of(relabelled).message(), HasSubstr("labels have changed"));
}

// The sum of areas is the one check that rounds: it must not cry wolf.
TEST(Validate, TrustsThinHugeAndTinyMeshes) {
  Random random(8);
  const auto data = random_grid(20, 2, random);
  for (const double thickness : {1e-3, 1e-8, 1e-13}) {
    for (const double scale : {1e-160, 1.0, 1e160, 1e300}) {
      auto turned = data;
      for (auto& p : turned.points)
        p = scale * Point(0.8 * p.x - 0.6 * thickness * p.y, 0.6 * p.x + 0.8 * thickness * p.y);
      Mesh mesh = build_mesh(data);
      for (const UserVertex user : Numbers<UserVertex>(data.n_vertices()))
        mesh.positions()[mesh.vertex_of_user(user)] = turned.points[user];
      const auto defect = validate(mesh);
      EXPECT_FALSE(defect && defect->kind == DefectKind::Coverage) << defect->message();
    }
  }
}

}  // namespace
}  // namespace kinemesh::test
