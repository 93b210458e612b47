// The region does not depend on where, how large and which way round a tangle is.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/predicates.h"
#include "tests/untangle/explore/tangles.h"
#include "untangle/explore/local_exploration.h"

namespace kinemesh::test {
namespace {

struct Answer {
  std::vector<UserFace> faces{};
  int components = 0, inverted = 0, gamma_first_stable = 0;
  bool operator==(const Answer&) const = default;
};

// By inverted face.
std::map<UserFace, Answer> answers(const MeshData& tangle) {
  const Mesh mesh = build_mesh(tangle);
  std::map<UserFace, Answer> all;
  for (const Face face : mesh.faces()) {
    const auto [a, b, c] = mesh.corners(face);
    if (orientation(a, b, c) != Orientation::Clockwise) continue;
    LocalExploration exploration(mesh);
    if (!exploration.run(face)) continue;  // met a flat face
    Answer answer{{}, exploration.components(), exploration.inverted(), exploration.gamma_first_stable()};
    for (const Face f : exploration.faces()) answer.faces.push_back(mesh.user_face(f));
    std::ranges::sort(answer.faces);
    all[mesh.user_face(face)] = answer;
  }
  return all;
}

MeshData moved(MeshData mesh, const std::function<Point(const Point&)>& move) {
  for (Point& p : mesh.points) p = move(p);
  return mesh;
}

MeshData mirrored(MeshData mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return moved(mesh, [](const Point& p) { return Point{-p.x, p.y}; });
}

MeshData scaled(const MeshData& mesh, double factor) {
  return moved(mesh, [factor](const Point& p) { return factor * p; });
}

MeshData tangle_of(int seed) {
  return seed % 2 ? random_tangle(seed) : nearly_degenerate_tangle(seed);
}

TEST(LocalSymmetry, MirroredTurnedAndScaledTanglesHaveTheSameRegions) {
  int regions = 0;
  for (int seed = 1; regions < 300; ++seed) {
    SCOPED_TRACE("tangle " + std::to_string(seed));
    const auto tangle = tangle_of(seed);
    const auto expected = answers(tangle);
    regions += static_cast<int>(expected.size());
    EXPECT_EQ(answers(mirrored(tangle)), expected);
    EXPECT_EQ(answers(moved(tangle, [](const Point& p) { return Point{-p.y, p.x}; })), expected);
    EXPECT_EQ(answers(scaled(tangle, 0x1p-150)), expected);
  }
}

// Where products of coordinates under- or overflow all is in fractions, which takes long.
TEST(LocalSymmetry, SoHaveSmallTanglesOfExtremeSize) {
  int regions = 0;
  for (int seed = 1; regions < 60; ++seed) {
    const auto tangle = tangle_of(seed);
    if (tangle.n_vertices() > 14) continue;
    SCOPED_TRACE("tangle " + std::to_string(seed));
    const auto expected = answers(tangle);
    regions += static_cast<int>(expected.size());
    EXPECT_EQ(answers(scaled(tangle, 0x1p498)), expected);
    EXPECT_EQ(answers(scaled(tangle, 0x1p-480)), expected);
  }
}

}  // namespace
}  // namespace kinemesh::test
