#include "kinemesh/orient.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <random>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

// n x n squares of two triangles, all counter-clockwise.
MeshData grid(int n, Point corner = {0, 0}) {
  MeshData mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back(corner.x + i, corner.y + j);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  }
  return mesh;
}

Triangle turned(Triangle t) {
  return {t[0], t[2], t[1]};
}

void expect_face_error(MeshData mesh, int face, const std::string& what) {
  try {
    make_consistent(mesh);
    ADD_FAILURE() << "no error, expected " << what;
  } catch (const FaceError& error) {
    EXPECT_EQ(error.face(), face);
    EXPECT_NE(error.reason().find(what), std::string::npos) << error.what();
    EXPECT_EQ(error.what(), "face " + std::to_string(face) + ": " + error.reason());
  }
}

TEST(Orient, LeavesUprightMeshesAlone) {
  MeshData mesh = grid(3);
  EXPECT_TRUE(make_consistent(mesh).empty());
  EXPECT_EQ(mesh.triangles, grid(3).triangles);
}

TEST(Orient, TurnsAClockwiseMeshOverWithOneNote) {
  MeshData mesh = grid(3);
  for (Triangle& t : mesh.triangles) t = turned(t);
  EXPECT_EQ(make_consistent(mesh),
            std::vector<std::string>{"1 connected part turned over, clockwise as a whole"});
  EXPECT_EQ(mesh.triangles, grid(3).triangles);
}

TEST(Orient, UndoesAnyMixtureWhateverLeads) {
  EXPECT_TRUE(rc::check("mixed winding", [](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const MeshData upright = grid(1 + static_cast<int>(random() % 5));
    MeshData mesh = upright;
    std::size_t n_turned = 0;
    for (Triangle& t : mesh.triangles) {
      if (random() % 2 == 0) continue;
      t = turned(t);
      ++n_turned;
    }
    const auto notes = make_consistent(mesh);
    RC_ASSERT(mesh.triangles == upright.triangles);
    RC_ASSERT(notes.size() == (n_turned > 0 ? 1u : 0u));
    if (n_turned > 1 && n_turned < mesh.triangles.size()) {
      RC_ASSERT(notes[0] == std::to_string(n_turned) + " faces turned over, wound against their neighbours");
    }
  }));
}

TEST(Orient, MixedIsClassifiedByPart) {
  MeshData mesh = grid(2);
  const MeshData second = grid(2, {10, 0});
  const int n = mesh.n_vertices();
  mesh.points.insert(mesh.points.end(), second.points.begin(), second.points.end());
  for (Triangle t : second.triangles) mesh.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  const Triangle first = mesh.triangles[0];
  mesh.triangles[0] = turned(first);
  const auto notes = make_consistent(mesh);
  EXPECT_EQ(notes, (std::vector<std::string>{"1 face turned over, wound against their neighbours",
                                             "1 connected part turned over, clockwise as a whole"}));
  EXPECT_EQ(mesh.triangles[0], first);
  EXPECT_EQ(mesh.triangles[8], (Triangle{n, n + 1, n + 4}));
}

TEST(Orient, TangledStaysTangled) {
  MeshData mesh = grid(4);
  mesh.points[12] = {-1, 2};  // the middle, through the sides
  const auto triangles = mesh.triangles;
  EXPECT_TRUE(make_consistent(mesh).empty());
  EXPECT_EQ(mesh.triangles, triangles);
}

TEST(Orient, RepeatsToTheSame) {
  EXPECT_TRUE(rc::check("idempotent", [](std::uint64_t seed) {
    MeshData mesh = random_mesh(seed);
    const auto once = mesh.triangles;
    RC_ASSERT(make_consistent(mesh).empty());
    RC_ASSERT(mesh.triangles == once);
  }));
}

TEST(Orient, AFoldedMeshOfAreaZeroIsKept) {
  MeshData mesh;
  mesh.points = {{0.1, 0.3}, {0.7, 0.3}, {0.4, 0.9}, {0.4, 0.9}};
  mesh.triangles = {{1, 0, 2}, {0, 1, 3}};  // one lies on the other
  EXPECT_TRUE(make_consistent(mesh).empty());
  std::swap(mesh.triangles[0], mesh.triangles[1]);
  EXPECT_TRUE(make_consistent(mesh).empty());
}

TEST(Orient, HugeAndTinyCoordinatesHaveASign) {
  for (double size : {1e308, 1e-308, 1e-160}) {
    MeshData mesh = grid(1);
    for (Point& p : mesh.points) p = (p * 2.0 - 1.0) * size;
    for (Triangle& t : mesh.triangles) t = turned(t);
    make_consistent(mesh);
    EXPECT_EQ(mesh.triangles, grid(1).triangles) << size;
  }
}

TEST(Orient, FarFromTheOriginTheSignIsRight) {
  MeshData mesh = grid(4, {1e15, -1e15});
  for (Triangle& t : mesh.triangles) t = turned(t);
  make_consistent(mesh);
  EXPECT_EQ(mesh.triangles, grid(4).triangles);
}

TEST(Orient, RefusesFacesThatCannotBe) {
  MeshData mesh = grid(2);
  mesh.triangles[3][1] = 9;
  expect_face_error(mesh, 3, "vertex 9 does not exist, expected a number from 0 and below 9");
  mesh.triangles[3][1] = -1;
  expect_face_error(mesh, 3, "vertex -1 does not exist");
  for (int k = 0; k < 3; ++k) {
    mesh = grid(2);
    mesh.triangles[5][k] = mesh.triangles[5][(k + 1) % 3];
    expect_face_error(mesh, 5, "vertex " + std::to_string(mesh.triangles[5][k]) + " is there twice");
  }
}

TEST(Orient, RefusesRepeatedFacesInAnyRotation) {
  const MeshData upright = grid(2);
  Triangle copy = upright.triangles[2];
  for (int i = 0; i < 6; ++i) {
    MeshData mesh = upright;
    mesh.triangles.push_back(copy);
    expect_face_error(mesh, 8, "has the same vertices as face 2");
    std::rotate(copy.begin(), copy.begin() + 1, copy.end());
    if (i == 2) copy = turned(copy);
  }
  MeshData twice;
  twice.points.resize(3);
  twice.triangles = {{0, 1, 2}, {2, 1, 0}};
  expect_face_error(twice, 1, "has the same vertices as face 0");
}

TEST(Orient, RefusesAThirdFaceAtAnEdge) {
  MeshData mesh = grid(1);
  mesh.points.emplace_back(5, 5);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 3, 4});
  expect_face_error(mesh, 2, "is one of 3 at the edge between vertices 0 and 3, expected at most two");
}

TEST(Orient, NamesTheFirstCulpritOfTheFile) {
  MeshData mesh = grid(4);
  mesh.triangles.push_back(mesh.triangles[31]);
  mesh.triangles.push_back(mesh.triangles[0]);
  expect_face_error(mesh, 32, "has the same vertices as face 31");
}

TEST(Orient, RefusesAMoebiusStrip) {
  MeshData mesh;
  mesh.points.resize(5);
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
  try {
    make_consistent(mesh);
    FAIL();
  } catch (const FaceError& error) {
    EXPECT_NE(error.reason().find("the surface has only one side"), std::string::npos);
  }
}

TEST(Orient, ManyFacesAtOneVertexAndOneEdgeTakeNoQuadraticTime) {
  constexpr int n = 400'000;
  MeshData fan;
  fan.points.assign(n + 1, Point(0, 0));
  for (int i = 1; i < n; ++i) fan.triangles.push_back({0, i, i + 1});
  EXPECT_TRUE(make_consistent(fan).empty());
  for (int i = 2; i <= n; ++i) fan.triangles[i - 2] = {0, 1, i};
  expect_face_error(fan, 2, "is one of 399999 at the edge between vertices 0 and 1");
}

TEST(Orient, BowTiesAreTwoParts) {
  MeshData mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {-1, 0}, {-1, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 4, 3}};
  EXPECT_EQ(make_consistent(mesh).size(), 1u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}}));
}

}  // namespace
}  // namespace kinemesh
