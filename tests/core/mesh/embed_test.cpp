// Padding: whatever the domain, the whole is a disc with a convex border.
#include <gtest/gtest.h>

#include <cmath>

#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

double hull_area(const Mesh& mesh) {
  const auto hull = mesh.hull();
  double area = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = mesh.position(hull[i]), b = mesh.position(hull[(i + 1) % hull.size()]);
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

double padding_area(const Mesh& mesh) {
  double area = 0;
  for (const Face f : mesh.faces()) {
    const auto [a, b, c] = mesh.corners(f);
    if (mesh.is_padding(f)) area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  return area;
}

// With and without a frame, as it is, mirrored and scaled.
void expect_embedded(const MeshData& data, double area) {
  for (const double frame : {0.0, 0.4}) {
    for (const auto& variant : {data, mirrored(data), mapped(data, {-4, -4}, {100, 1})}) {
      const Mesh mesh = build_mesh(variant, {.frame = frame});
      const auto defect = validate(mesh);
      EXPECT_FALSE(defect) << defect->message();
      const double scale = measure(mesh).area / area;
      EXPECT_TRUE(std::abs(scale - 1) < 1e-9 || std::abs(scale - 16) < 1e-9) << scale;
      EXPECT_NEAR(padding_area(mesh), hull_area(mesh) - measure(mesh).area, 1e-9 * hull_area(mesh));
      EXPECT_EQ(mesh.domain().triangles, variant.triangles);
    }
  }
}

int padding_faces(const MeshData& data) {
  const Mesh mesh = build_mesh(data);
  return mesh.n_faces() - mesh.n_user_faces();
}

TEST(Embed, AddsNothingToAConvexDomain) {
  Random random(1);
  EXPECT_EQ(padding_faces(random_square(30, random)), 0);
  EXPECT_EQ(padding_faces(random_grid(5, 4, random)), 0);
  EXPECT_EQ(padding_faces(domain_of({circle({0, 0}, 1, 17)})), 0);
}

TEST(Embed, FillsAHoleAndANotch) {
  EXPECT_EQ(padding_faces(domain_of({rectangle({0, 0}, {3, 3}), reversed(rectangle({1, 1}, {2, 2}))})), 2);
  expect_embedded(domain_of({rectangle({0, 0}, {3, 3}), reversed(rectangle({1, 1}, {2, 2}))}), 8);
  Random random(2);
  expect_embedded(u_shape(30, random), 7);
}

TEST(Embed, FillsHolesThatShareAVertex) {
  expect_embedded(domain_of({rectangle({0, 0}, {6, 6}), reversed(rectangle({1, 1}, {3, 3})),
                             reversed(rectangle({3, 3}, {5, 5}))}),
                  28);
  // Three around one vertex, and one that touches the outer border in a vertex.
  expect_embedded(domain_of({{{0, 0}, {4, 0}, {8, 0}, {8, 8}, {0, 8}},
                             {{4, 4}, {6, 5}, {6, 3}},
                             {{4, 4}, {3, 6}, {5, 6}},
                             {{4, 4}, {2, 3}, {2, 5}},
                             {{4, 0}, {3, 2}, {5, 2}}}),
                  56);
}

TEST(Embed, FillsNestedIslands) {
  std::vector<Loop> loops;
  double area = 0;
  for (int depth = 0; depth < 6; ++depth) {
    const auto square = rectangle({depth, depth}, {20 - depth, 20 - depth});
    loops.push_back(depth % 2 ? reversed(square) : square);
    area += (depth % 2 ? -1 : 1) * std::pow(20 - 2 * depth, 2);
  }
  expect_embedded(domain_of(loops), area);
}

TEST(Embed, JoinsSeveralPartsAndBowTies) {
  expect_embedded(
      domain_of({rectangle({0, 0}, {1, 1}), rectangle({3, 0}, {4, 1}), rectangle({1, 5}, {2, 6})}), 3);
  expect_embedded(domain_of({rectangle({0, 0}, {1, 1}), rectangle({1, 1}, {2, 2})}), 2);
  // A ring of four squares, each sharing corners with the next: the hole in the middle is padding too.
  expect_embedded(domain_of({rectangle({1, 0}, {2, 1}), rectangle({2, 1}, {3, 2}), rectangle({1, 2}, {2, 3}),
                             rectangle({0, 1}, {1, 2})}),
                  4);
}

TEST(Embed, TakesSingleFaces) {
  expect_embedded(domain_of({{{0, 0}, {1, 0}, {0, 1}}}), 0.5);
  expect_embedded(domain_of({{{0, 0}, {1, 0}, {0, 1}}, {{5, 5}, {6, 5}, {5, 6}}}), 1);
}

TEST(Embed, TakesCollinearBorders) {
  Loop comb;  // many vertices on each straight side
  for (int i = 0; i < 20; ++i) comb.push_back({0.5 * i, 0});
  for (int i = 0; i < 20; ++i) comb.push_back({10, 0.5 * i});
  for (int i = 20; i > 0; --i) comb.push_back({0.5 * i, 10});
  for (int i = 20; i > 0; --i) comb.push_back({0, 0.5 * i});
  EXPECT_EQ(padding_faces(domain_of({comb})), 0);
  EXPECT_EQ(build_mesh(domain_of({comb})).hull().size(), 80u);
  expect_embedded(domain_of({comb, reversed(rectangle({2, 2}, {8, 8}))}), 64);
}

TEST(Embed, LeavesIsolatedVerticesOutside) {
  auto data = four_triangles();
  data.points.push_back({50, 50});
  data.points.push_back({1, 1});  // where a vertex is
  data.points.push_back({0, 0});
  const Mesh mesh = build_mesh(data, {.frame = 0.25});
  EXPECT_EQ(mesh.n_user_vertices(), 8);
  for (const int user : {5, 6, 7}) EXPECT_TRUE(mesh.is_isolated(mesh.vertex_of_user(UserVertex(user))));
  EXPECT_LT(mesh.position(mesh.frame()[2]).x, 4) << "the frame is around what has faces";
  EXPECT_FALSE(validate(mesh));
}

TEST(Embed, TakesTinyHugeAndThinDomains) {
  Random random(5);
  for (const auto& data :
       {u_shape(20, random), domain_of({rectangle({0, 0}, {3, 3}), reversed(rectangle({1, 1}, {2, 2}))})}) {
    for (const Point& scale :
         {Point(1e-300, 1e-300), Point(1e300, 1e300), Point(1, 1e-12), Point(1e-150, 1e150)}) {
      for (const double frame : {0.0, 0.25}) {
        auto turned = mapped(data, scale, {0, 0});
        if (scale.x == 1) {
          for (auto& p : turned.points) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
        }
        const auto defect = validate(build_mesh(turned, {.frame = frame}));
        EXPECT_FALSE(defect) << defect->message() << " at " << scale.x << ", " << scale.y;
      }
    }
  }
}

}  // namespace
}  // namespace kinemesh::test
