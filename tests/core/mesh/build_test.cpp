// From arrays to the mesh and back.
#include "kinemesh/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

std::string message(const std::optional<Defect>& defect) {
  return defect ? defect->message() : "";
}

// Labels in four stripes, markers on some border and inner edges, corners rotated at random, two isolated
// vertices.
MeshData decorated(std::uint64_t seed) {
  Random random(seed);
  MeshData data = seed % 2 ? random_grid(6, 5, random) : u_shape(40, random);
  for (auto& t : data.triangles) std::rotate(t.begin(), t.begin() + random.below(3), t.end());
  for (const auto& t : data.triangles)
    data.labels.push_back(
        static_cast<int>(data.points[t[0]].x + data.points[t[1]].x + data.points[t[2]].x) / 9 - 1);
  data.points.push_back({0.5, 0.5});
  data.points.push_back({-100, 7});
  Marker wall{"wall", {}}, wire{"wire", {}};
  for (const auto& t : data.triangles) {
    if (random.one_in(9)) wall.edges.push_back({t[0], t[1]});
    if (random.one_in(9)) wire.edges.push_back({t[2], t[1]});
  }
  data.markers = {wall, wire, {"empty", {}}};
  data.label_names = {{-1, "left"}, {3, "nowhere"}};
  return data;
}

TEST(Build, GivesBackExactlyWhatCameIn) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto data = decorated(seed);
    const Mesh mesh = build_mesh(data, {.frame = seed % 3 ? 0.0 : 0.5});
    const auto back = mesh.domain();
    EXPECT_EQ(back.points, data.points);
    EXPECT_EQ(back.triangles, data.triangles);
    EXPECT_EQ(back.labels, data.labels);
    EXPECT_EQ(back.label_names, data.label_names);
    ASSERT_EQ(back.markers.size(), data.markers.size());
    for (std::size_t i = 0; i < data.markers.size(); ++i) {
      EXPECT_EQ(back.markers[i].name, data.markers[i].name);
      EXPECT_EQ(back.markers[i].edges, data.markers[i].edges);
    }
    EXPECT_EQ(mesh.user_positions(), data.points);
    EXPECT_EQ(message(validate(mesh)), "");
  }
}

TEST(Build, NumbersBothWays) {
  const auto data = decorated(3);
  const Mesh mesh = build_mesh(data, {.frame = 0.5});
  EXPECT_EQ(mesh.n_user_vertices(), data.n_vertices());
  EXPECT_EQ(mesh.n_vertices(), data.n_vertices() + 4);
  EXPECT_EQ(mesh.n_user_faces(), data.n_faces());
  for (const UserVertex user : Numbers<UserVertex>(data.n_vertices())) {
    EXPECT_EQ(mesh.user_vertex(mesh.vertex_of_user(user)), user);
    EXPECT_EQ(mesh.position(mesh.vertex_of_user(user)), data.points[user]);
  }
  for (const Vertex v : mesh.frame()) EXPECT_EQ(mesh.user_vertex(v), none);
  std::vector<int> numbers;
  for (const Face f : mesh.faces()) {
    if (mesh.is_padding(f)) {
      EXPECT_EQ(mesh.user_face(f), none);
    } else {
      numbers.push_back(mesh.user_face(f));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  std::vector<int> all(data.n_faces());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(numbers, all);
}

// Neighbours along the curve are near each other: the sum of the steps is that of a path, not of a shuffle.
TEST(Build, OrdersVerticesAlongACurve) {
  Random random(9);
  const int n = 4000;
  const Mesh mesh = build_mesh(random_square(n, random));
  double length = 0;
  const auto x = mesh.positions();
  for (int v = 1; v < n; ++v) length += glm::distance(x[v - 1], x[v]);
  EXPECT_LT(length, 2.0 * std::sqrt(n));  // a shuffle: about n / 2
  Vertex before{0};
  for (const auto& t : mesh.triangles()) {
    const Vertex lowest = *std::min_element(t.begin(), t.end());
    EXPECT_LE(before, lowest);
    before = lowest;
  }
}

int label_beside(const Mesh& mesh, Side side) {
  const Face face = Mesh::face_of(side);
  return face == none ? padding_label : mesh.label(face);
}

TEST(Build, ConstrainsBordersInterfacesAndMarkersWithTheirSides) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Mesh mesh = build_mesh(decorated(seed), {.frame = 0.25});
    int seen = 0;
    for (const Side e : all_edges(mesh)) {
      const int c = mesh.constraint_of(e);
      if (c == none) {
        EXPECT_EQ(label_beside(mesh, e), label_beside(mesh, mesh.opposite(e)));
        continue;
      }
      ++seen;
      const auto& constraint = mesh.constraints()[c];
      const bool is_along = mesh.from(e) == constraint.from;
      const Side left = is_along ? e : mesh.opposite(e), right = is_along ? mesh.opposite(e) : e;
      EXPECT_EQ(is_along ? mesh.to(e) : mesh.from(e), constraint.to);
      EXPECT_EQ(label_beside(mesh, left), constraint.left);
      EXPECT_EQ(label_beside(mesh, right), constraint.right);
      if (mesh.opposite(e) != none) {
        EXPECT_EQ(mesh.constraint_of(mesh.opposite(e)), c);
      }
      EXPECT_NE(constraint.left, padding_label) << "the domain is to the left of a border";
      EXPECT_TRUE(mesh.is_constrained(constraint.from) && mesh.is_constrained(constraint.to));
    }
    EXPECT_EQ(seen, static_cast<int>(mesh.constraints().size()));
  }
}

TEST(Build, GivesAnEdgeToTheFirstMarkerThatHoldsIt) {
  auto data = four_triangles();
  data.markers = {{"first", {{0, 1}}}, {"second", {{1, 0}, {1, 2}, {4, 1}}}};
  const Mesh mesh = build_mesh(data);
  EXPECT_THAT(mesh.marker_names(), ElementsAre("first", "second"));
  std::map<std::pair<int, int>, int> marker;
  for (const auto& c : mesh.constraints()) {
    const int a = mesh.user_vertex(c.from), b = mesh.user_vertex(c.to);
    marker[std::minmax(a, b)] = c.marker;
  }
  EXPECT_EQ(marker.size(), 5u);
  EXPECT_EQ(marker.at({0, 1}), 0);
  EXPECT_EQ(marker.at({1, 2}), 1);
  EXPECT_EQ(marker.at({1, 4}), 1);
  EXPECT_EQ(marker.at({2, 3}), none);
}

TEST(Build, KeepsFixedVertices) {
  const Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5, .fixed = {1, 4}});
  for (const UserVertex user : Numbers<UserVertex>(5))
    EXPECT_EQ(mesh.is_fixed(mesh.vertex_of_user(user)), user == 1 || user == 4);
  for (const Vertex v : mesh.frame()) EXPECT_FALSE(mesh.is_fixed(v));
}

TEST(Build, PlacesTheFrameAroundTheDomain) {
  const Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  const double d = 0.5 * std::sqrt(8.0);
  ASSERT_EQ(mesh.frame().size(), 4u);
  const std::vector<Point> corners{{-d, -d}, {2 + d, -d}, {2 + d, 2 + d}, {-d, 2 + d}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(mesh.position(mesh.frame()[i]).x, corners[i].x);
    EXPECT_DOUBLE_EQ(mesh.position(mesh.frame()[i]).y, corners[i].y);
  }
  EXPECT_THAT(mesh.hull(),
              UnorderedElementsAre(mesh.frame()[0], mesh.frame()[1], mesh.frame()[2], mesh.frame()[3]));
}

TEST(Build, KeepsTanglesInsideAGoodBorder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    auto data = u_shape(40, random);
    for (std::size_t v = 9; v < data.points.size(); ++v)
      data.points[v] = {random.between(-9, 9), random.between(-9, 9)};
    const Mesh mesh = build_mesh(data, {.frame = 0.1});
    EXPECT_EQ(message(validate_connectivity(mesh)), "");
    EXPECT_EQ(mesh.domain().triangles, data.triangles);
    EXPECT_EQ(mesh.domain().points, data.points);
  }
}

TEST(Measure, TellsAreaAngleAndSpacing) {
  const Mesh mesh = build_mesh(four_triangles(), {.frame = 0.5});
  const auto measures = measure(mesh);
  EXPECT_DOUBLE_EQ(measures.area, 4);
  EXPECT_DOUBLE_EQ(measures.min_area, 1);
  EXPECT_DOUBLE_EQ(measures.min_angle_deg, 45);
  EXPECT_DOUBLE_EQ(mean_spacing(mesh), std::sqrt(4.0 / 5));
}

// Padding left out, faces of either orientation, an odd number of them.
TEST(Measure, IsThatOfEachFaceInTurn) {
  Random random(7);
  for (int n = 3; n < 40; ++n) {
    Mesh mesh = build_mesh(u_shape(3 * n, random), {.frame = 0.25, .fixed = {}});
    const double shift = n % 2 == 0 ? 1e-9 : 0.5;
    for (Point& p : mesh.positions())
      p += Point(random.between(-shift, shift), random.between(-shift, shift));
    double area = 0.0, min_area = std::numeric_limits<double>::infinity(), min_tangent = min_area;
    for (const Face face : mesh.faces_in_user_order()) {
      const auto [a, b, c] = mesh.corners(face);
      const double face_area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
      area += face_area;
      min_area = std::min(min_area, face_area);
      min_tangent = std::min(min_tangent, tangent_of_smallest_angle(mesh.corners(face)));
    }
    const auto measures = measure(mesh);
    EXPECT_NEAR(measures.area, area, 1e-12);
    EXPECT_NEAR(measures.min_area, min_area, 1e-15);
    EXPECT_NEAR(measures.min_angle_deg, std::atan(min_tangent) * 180.0 / std::numbers::pi, 1e-10);
  }
}

// A hub whose spokes are all marked, many times, and two hubs that share an edge that is marked many times.
TEST(Build, FindsTheMarkedEdgesOfAHubQuickly) {
  constexpr int n = 50'000;
  MeshData data;
  data.points = {{0.0, 0.0}, {0.0, -1.0}};
  for (int i = 0; i < n; ++i) {
    const double t = 2.0 * i / (n - 1) - 1.0;
    data.points.push_back({t, 2.0 - t * t});
    if (i > 0) data.triangles.push_back({0, i + 2, i + 1});
    data.markers.push_back({"spoke", {{0, i + 2}, {i + 2, 0}, {0, n / 2}}});
  }
  data.triangles.push_back({0, 2, 1});
  data.triangles.push_back({0, 1, n + 1});
  const auto before = std::chrono::steady_clock::now();
  const Mesh mesh = build_mesh(data);
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(10));
  EXPECT_FALSE(validate(mesh));
  int n_marked = 0;
  for (const Constraint& c : mesh.constraints()) n_marked += c.marker != none;
  EXPECT_EQ(n_marked, n);
}

TEST(Measure, IsZeroDegreesForFlatAndInvertedFaces) {
  Mesh mesh = build_mesh(four_triangles());
  mesh.positions()[mesh.vertex_of_user(UserVertex(4))] = {2, 1};
  EXPECT_EQ(measure(mesh).min_angle_deg, 0);
  EXPECT_EQ(measure(mesh).min_area, 0);
  mesh.positions()[mesh.vertex_of_user(UserVertex(4))] = {3, 1};
  EXPECT_EQ(measure(mesh).min_angle_deg, 0);
  EXPECT_DOUBLE_EQ(measure(mesh).min_area, -1);
  EXPECT_DOUBLE_EQ(measure(mesh).area, 4);
}

}  // namespace
}  // namespace kinemesh::test
