#include "motion/restriction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using test::grid;
using test::grid_vertex;
using testing::HasSubstr;

double smooth(double s) {
  return 1.0 - s * s * (3.0 - 2.0 * s);
}

TEST(ParseRestriction, ReadsEveryForm) {
  EXPECT_TRUE(std::holds_alternative<OnAll>(parse_restriction("all").on));
  EXPECT_EQ(std::get<OnMarker>(parse_restriction("marker:air foil:2").on).name, "air foil:2");
  EXPECT_EQ(std::get<OnLabel>(parse_restriction("label:-3").on).label, -3);
  const auto disc = std::get<OnDisc>(parse_restriction("disc:[1, -2.5e1 ,+.5]").on);
  EXPECT_EQ(disc.center, Point(1.0, -25.0));
  EXPECT_EQ(disc.radius, 0.5);
  const auto blend = parse_restriction("label:1", std::array{0.5, 2.0}).blend;
  ASSERT_TRUE(blend);
  EXPECT_EQ(blend->full, 0.5);
  EXPECT_EQ(blend->zero, 2.0);
}

TEST(ParseRestriction, RefusesWhatIsNone) {
  for (const char* on :
       {"", "ALL", "marker:", "marker", "label:", "label:x", "label:1.5", "label:-2147483648", "disc:1,2,3",
        "disc:[1,2]", "disc:[1,2,3,4]", "disc:[1,2,0]", "disc:[1,2,-1]", "disc:[1,,2]", "disc:[", "disc:]",
        "disc:[1,2,nan]", "disc:[1,2,inf]", "disc"}) {
    try {
      parse_restriction(on);
      ADD_FAILURE() << on;
    } catch (const ParameterError& error) {
      EXPECT_EQ(error.key(), "on");
      EXPECT_THAT(error.what(), HasSubstr("on = \"" + std::string(on) + "\": "));
    }
  }
  for (const auto blend : {std::array{1.0, 1.0}, std::array{2.0, 1.0}, std::array{-1.0, 1.0},
                           std::array{0.0, std::numeric_limits<double>::infinity()}})
    try {
      parse_restriction("label:1", blend);
      ADD_FAILURE();
    } catch (const ParameterError& error) {
      EXPECT_EQ(error.key(), "blend");
    }
}

TEST(Weights, AreOneEverywhereWithoutRestriction) {
  const Mesh mesh = build_mesh(grid(4));
  EXPECT_TRUE(weights(mesh, {}).empty());
  EXPECT_THROW(weights(mesh, {OnAll{}, Blend{0.0, 1.0}}), ParameterError);
}

TEST(Weights, OfAMarkerAreItsVertices) {
  const int n = 8;
  const Mesh mesh = build_mesh(grid(n));
  const auto w = weights(mesh, parse_restriction("marker:left"));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) EXPECT_EQ(w[grid_vertex(mesh, n, i, j)], i == 0 ? 1.0 : 0.0);
}

TEST(Weights, OfAMarkerFadeWithTheDistanceToItsEdges) {
  const int n = 20;
  const Mesh mesh = build_mesh(grid(n), {.frame = 0.5, .fixed = {}});
  const auto w = weights(mesh, parse_restriction("marker:left", std::array{0.19, 0.81}));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double distance = i / 20.0;
      const double expected = distance < 0.19   ? 1.0
                              : distance > 0.81 ? 0.0
                                                : smooth((distance - 0.19) / 0.62);
      EXPECT_NEAR(w[grid_vertex(mesh, n, i, j)], expected, 1e-14);
      if (i == 0) {
        EXPECT_EQ(w[grid_vertex(mesh, n, i, j)], 1.0);
      }
      if (i > 16) {
        EXPECT_EQ(w[grid_vertex(mesh, n, i, j)], 0.0);
      }
    }
}

// Label 5 in the squares with 4 <= i, j < 8 of 16.
MeshData grid_with_patch() {
  MeshData data = grid(16);
  for (int face = 0; face < data.n_faces(); ++face) {
    const int i = face / 2 % 16, j = face / 32;
    data.labels.push_back(i >= 4 && i < 8 && j >= 4 && j < 8 ? 5 : 0);
  }
  return data;
}

TEST(Weights, OfALabelAreTheCornersOfItsFaces) {
  const Mesh mesh = build_mesh(grid_with_patch());
  const auto w = weights(mesh, parse_restriction("label:5"));
  for (int j = 0; j <= 16; ++j)
    for (int i = 0; i <= 16; ++i)
      EXPECT_EQ(w[grid_vertex(mesh, 16, i, j)], i >= 4 && i <= 8 && j >= 4 && j <= 8 ? 1.0 : 0.0);
}

TEST(Weights, OfALabelFadeOutsideItsBorder) {
  const Mesh mesh = build_mesh(grid_with_patch());
  const auto w = weights(mesh, parse_restriction("label:5", std::array{0.0, 0.5}));
  EXPECT_EQ(w[grid_vertex(mesh, 16, 6, 6)], 1.0);  // inside, whatever its distance to the border
  EXPECT_NEAR(w[grid_vertex(mesh, 16, 12, 6)], smooth(0.25 / 0.5), 1e-14);
  EXPECT_NEAR(w[grid_vertex(mesh, 16, 11, 12)], smooth(std::hypot(3.0, 4.0) / 16 / 0.5), 1e-14);
  EXPECT_EQ(w[grid_vertex(mesh, 16, 16, 6)], 0.0);
}

TEST(Weights, OfADiscFadeWithTheDistanceToIt) {
  const Mesh mesh = build_mesh(grid(16));
  const auto sharp = weights(mesh, parse_restriction("disc:[0.5,0.5,0.25]"));
  const auto soft = weights(mesh, parse_restriction("disc:[0.5,0.5,0.25]", std::array{0.05, 0.2}));
  for (const Vertex v : mesh.vertices()) {
    const double r = glm::distance(mesh.positions()[v], Point(0.5)), outside = r - 0.25;
    EXPECT_EQ(sharp[v], r <= 0.25 ? 1.0 : 0.0);
    EXPECT_NEAR(soft[v],
                outside <= 0.05  ? 1.0
                : outside >= 0.2 ? 0.0
                                 : smooth((outside - 0.05) / 0.15),
                1e-14);
  }
}

TEST(Weights, NameTheMarkerOrLabelThatIsMissing) {
  const Mesh mesh = build_mesh(grid(4));
  const auto what = [&](const char* on) {
    try {
      weights(mesh, parse_restriction(on));
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(what("marker:airfoil"), "on = \"marker:airfoil\": the mesh has no marker of that name");
  EXPECT_EQ(what("label:7"), "on = \"label:7\": the mesh has no face with that label");
}

}  // namespace
}  // namespace kinemesh
