// A mesh large enough that anything quadratic, or a copy too many of a large buffer, would be felt.
#include <gtest/gtest.h>

#include "kinemesh/orient.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

MeshData large_grid(int n) {
  MeshData mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back(i / 3.0 + 0.1 * j, j / 7.0);
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

TEST(LargeMesh, GoesThroughEveryFormat) {
  const MeshData mesh = large_grid(300);
  for (Format format : {Format::Off, Format::Obj, Format::Ply, Format::Su2, Format::Gmsh, Format::Vtu}) {
    EXPECT_TRUE(same(mesh, parse(format_mesh(mesh, format), format).mesh, format));
  }
}

TEST(LargeMesh, IsWoundFromOneFace) {
  const MeshData upright = large_grid(300);
  MeshData mesh = upright;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  make_consistent(mesh);
  EXPECT_EQ(mesh.triangles, upright.triangles);
}

}  // namespace
}  // namespace kinemesh
