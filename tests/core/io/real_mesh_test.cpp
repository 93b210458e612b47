// Meshes of others, where they lie beside the project.
#include <gmock/gmock.h>

#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

struct RealMesh {
  std::string name;
  int vertices, faces;
  std::vector<std::pair<std::string, std::size_t>> markers;  // with their numbers of edges
};

class RealMeshes : public ::testing::TestWithParam<RealMesh> {};

TEST_P(RealMeshes, AreReadWholeAndSurviveEveryFormat) {
  const std::filesystem::path path =
      std::filesystem::path(KINEMESH_SHARED_DIR) / "data" / (GetParam().name + ".su2");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const ReadResult result = read_mesh(path);
  EXPECT_TRUE(result.notes.empty()) << ::testing::PrintToString(result.notes);
  EXPECT_EQ(result.mesh.n_vertices(), GetParam().vertices);
  EXPECT_EQ(result.mesh.n_faces(), GetParam().faces);
  std::vector<std::pair<std::string, std::size_t>> markers;
  for (const Marker& m : result.mesh.markers) markers.emplace_back(m.name, m.edges.size());
  EXPECT_EQ(markers, GetParam().markers);
  for (Format format : {Format::Off, Format::Obj, Format::Ply, Format::Su2, Format::Gmsh, Format::Vtu}) {
    EXPECT_TRUE(same(result.mesh, parse(format_mesh(result.mesh, format), format).mesh, format));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Su2, RealMeshes,
    ::testing::Values(RealMesh{"naca64a010", 8606, 16937, {{"airfoil", 200}, {"farfield", 75}}},
                      RealMesh{"naca0012", 5233, 10216, {{"airfoil", 200}, {"farfield", 50}}},
                      RealMesh{"bump_channel",
                               4550,
                               8778,
                               {{"bottom_front", 36},
                                {"bottom_rear", 44},
                                {"inlet", 20},
                                {"interface", 40},
                                {"outlet", 20},
                                {"slip_bottom", 20},
                                {"top", 140}}}),
    [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace kinemesh
