#include "kinemesh/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;

double twice_area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area(const MeshData& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * twice_area(mesh.points[a], mesh.points[b], mesh.points[c]);
  return sum;
}

Orientation turn(const MeshData& mesh, const Triangle& t) {
  return orientation(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

// Directed side -> corner opposite.
std::map<Edge, int> sides(const MeshData& mesh) {
  std::map<Edge, int> result;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(result.emplace(Edge{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]).second) << "a side twice";
    }
  }
  return result;
}

std::set<Edge> border(const MeshData& mesh) {
  std::set<Edge> result;
  const auto all = sides(mesh);
  for (const auto& [side, apex] : all) {
    if (!all.contains({side[1], side[0]})) result.insert(side);
  }
  return result;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
  return std::hypot(a.x + t * d.x - p.x, a.y + t * d.y - p.y);
}

// A triangulation of a domain with holes, whose markers hold its border just once, the domain to the left.
void expect_consistent(const MeshData& mesh, int n_holes) {
  const auto all = sides(mesh);
  const std::set<Edge> outline = border(mesh);
  std::set<Edge> marked;
  for (const Marker& marker : mesh.markers) {
    for (const Edge& edge : marker.edges) EXPECT_TRUE(marked.insert(edge).second) << marker.name;
  }
  EXPECT_EQ(marked, outline);
  std::set<int> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(static_cast<int>(used.size()), mesh.n_vertices());
  const int n_edges = static_cast<int>(all.size() + outline.size()) / 2;
  EXPECT_EQ(mesh.n_vertices() - n_edges + mesh.n_faces(), 1 - n_holes);
}

void expect_valid(const MeshData& mesh, int n_holes) {
  expect_consistent(mesh, n_holes);
  for (const Triangle& t : mesh.triangles) ASSERT_EQ(turn(mesh, t), Orientation::CounterClockwise);
}

void expect_delaunay(const MeshData& mesh) {
  const auto all = sides(mesh);
  for (const auto& [side, apex] : all) {
    const auto other = all.find({side[1], side[0]});
    if (other == all.end()) continue;
    EXPECT_NE(
        in_circle(mesh.points[side[0]], mesh.points[side[1]], mesh.points[apex], mesh.points[other->second]),
        InCircle::Inside);
  }
}

void expect_clear_of_border(const MeshData& mesh, double least) {
  std::vector<bool> on_border(mesh.n_vertices());
  const std::set<Edge> outline = border(mesh);
  for (const Edge& edge : outline) on_border[edge[0]] = true;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (on_border[v]) continue;
    for (const auto& [a, b] : outline) {
      ASSERT_GE(distance_to_segment(mesh.points[v], mesh.points[a], mesh.points[b]), least * (1.0 - 1e-12))
          << v;
    }
  }
}

void expect_even_border(const MeshData& mesh, double h) {
  for (const auto& [a, b] : border(mesh)) {
    const double length =
        std::hypot(mesh.points[a].x - mesh.points[b].x, mesh.points[a].y - mesh.points[b].y);
    EXPECT_GT(length, 0.75 * h);
    EXPECT_LT(length, 1.25 * h);
  }
}

std::vector<std::string> marker_names(const MeshData& mesh) {
  std::vector<std::string> names;
  for (const Marker& marker : mesh.markers) names.push_back(marker.name);
  return names;
}

bool same(const MeshData& a, const MeshData& b) {
  return a.points == b.points && a.triangles == b.triangles &&
         std::equal(a.markers.begin(), a.markers.end(), b.markers.begin(), b.markers.end(),
                    [](const Marker& m, const Marker& n) { return m.name == n.name && m.edges == n.edges; });
}

double smallest_angle(const MeshData& mesh) {
  double least = 180.0;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Point u = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]],
                  v = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      least = std::min(least,
                       std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y) * 180.0 / std::numbers::pi);
    }
  }
  return least;
}

double mean_edge(const MeshData& mesh, const Marker& marker) {
  double sum = 0.0;
  for (const auto& [a, b] : marker.edges)
    sum += std::hypot(mesh.points[a].x - mesh.points[b].x, mesh.points[a].y - mesh.points[b].y);
  return sum / static_cast<double>(marker.edges.size());
}

struct RandomShape {
  const char* name;
  int n_holes;
  double area;
};

class RandomShapes : public testing::TestWithParam<RandomShape> {};

TEST_P(RandomShapes, are_as_promised) {
  const auto& [name, n_holes, full_area] = GetParam();
  for (const int vertices : {48, 49, 63, 100, 331, 1000, 2500}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << vertices << " vertices, seed " << seed);
      const MeshData mesh = make_shape(name, {.vertices = vertices, .seed = seed});
      const double h = std::sqrt(full_area / vertices);
      EXPECT_EQ(mesh.n_vertices(), vertices);
      EXPECT_NEAR(area(mesh), full_area, 2.0 * h * h);
      expect_valid(mesh, n_holes);
      expect_delaunay(mesh);
      expect_clear_of_border(mesh, 0.5 * h);
      expect_even_border(mesh, h);
    }
  }
}

TEST_P(RandomShapes, depend_on_nothing_but_the_seed) {
  const MeshData mesh = make_shape(GetParam().name, {.vertices = 500, .seed = 7});
  EXPECT_TRUE(same(mesh, make_shape(GetParam().name, {.vertices = 500, .seed = 7})));
  EXPECT_FALSE(same(mesh, make_shape(GetParam().name, {.vertices = 500, .seed = 8})));
}

INSTANTIATE_TEST_SUITE_P(Shapes, RandomShapes,
                         testing::Values(RandomShape{"square", 0, 1.0},
                                         RandomShape{"disk", 0, std::numbers::pi},
                                         RandomShape{"annulus", 1, 0.75 * std::numbers::pi}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Shapes, a_square_has_its_corners_and_straight_sides) {
  const MeshData mesh = make_square(777);
  EXPECT_NEAR(area(mesh), 1.0, 1e-13);
  for (const Marker& marker : mesh.markers) {
    for (const auto& [a, b] : marker.edges) {
      for (const Point& p : {mesh.points[a], mesh.points[b]}) {
        const double off = marker.name == "bottom"  ? p.y
                           : marker.name == "right" ? p.x - 1.0
                           : marker.name == "top"   ? p.y - 1.0
                                                    : p.x;
        EXPECT_EQ(off, 0.0) << marker.name;
      }
    }
  }
}

TEST(Shapes, a_grid_is_regular) {
  const MeshData mesh = make_grid(5, 3);
  EXPECT_EQ(mesh.n_vertices(), 24);
  EXPECT_EQ(mesh.n_faces(), 30);
  expect_valid(mesh, 0);
  EXPECT_EQ(mesh.points[0], Point(0.0, 0.0));
  EXPECT_EQ(mesh.points[23], Point(1.0, 1.0));
  EXPECT_EQ(mesh.points[7], Point(0.2, 1.0 / 3.0));
  for (const auto& [a, b, c] : mesh.triangles) {
    EXPECT_NEAR(twice_area(mesh.points[a], mesh.points[b], mesh.points[c]), 1.0 / 15.0, 1e-15);
  }
  EXPECT_THROW(make_grid(0, 3), InputError);
}

// Ordinates in percent of the chord, from the table of the section [Abbott & von Doenhoff 1959, appendix
// III].
TEST(Shapes, naca0012_is_the_tabulated_section) {
  const double table[][2] = {{1.25, 1.894}, {2.5, 2.615},  {5.0, 3.555},
                             {10.0, 4.683}, {20.0, 5.737}, {30.0, 6.002}};
  for (const auto& [x, y] : table) EXPECT_NEAR(100.0 * naca0012_half_thickness(0.01 * x), y, 2e-3) << x;
  EXPECT_EQ(naca0012_half_thickness(0.0), 0.0);
  EXPECT_EQ(naca0012_half_thickness(1.0), 0.0);
}

TEST(Shapes, graded_meshes_have_about_as_many_vertices) {
  for (const int vertices : {400, 1000, 4000, 10000}) {
    for (const char* name : {"channel", "airfoil"}) {
      SCOPED_TRACE(testing::Message() << name << ", " << vertices);
      const MeshData mesh = make_shape(name, {.vertices = vertices});
      EXPECT_NEAR(mesh.n_vertices(), vertices, 0.05 * vertices);
      expect_valid(mesh, 1);
      EXPECT_GT(smallest_angle(mesh), 15.0);
      EXPECT_TRUE(same(mesh, make_shape(name, {.vertices = vertices})));
    }
  }
}

TEST(Shapes, an_airfoil_is_the_section_in_a_circle) {
  const MeshData mesh = make_airfoil(5000);
  std::set<Point,
           decltype([](const Point& p, const Point& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); })>
      section;
  for (const auto& [a, b] : mesh.markers[0].edges) {
    const Point p = mesh.points[a];
    EXPECT_EQ(std::abs(p.y), naca0012_half_thickness(p.x));
    section.insert(p);
  }
  EXPECT_TRUE(section.contains({0.0, 0.0}));
  EXPECT_EQ(section.rbegin()->x, 1.0);
  for (const auto& [a, b] : mesh.markers[1].edges) {
    EXPECT_NEAR(std::hypot(mesh.points[a].x - 0.5, mesh.points[a].y), 15.0, 1e-12);
  }
  const double section_area =
      0.6 * 2.0 * (0.2969 / 1.5 - 0.1260 / 2.0 - 0.3516 / 3.0 + 0.2843 / 4.0 - 0.1036 / 5.0);
  const double n = static_cast<double>(mesh.markers[1].edges.size());
  const double polygon_area = 0.5 * n * 225.0 * std::sin(2.0 * std::numbers::pi / n);
  EXPECT_NEAR(area(mesh), polygon_area - section_area, 0.02 * polygon_area / n);
  EXPECT_GT(mean_edge(mesh, mesh.markers[1]), 100.0 * mean_edge(mesh, mesh.markers[0]));
}

TEST(Shapes, a_channel_is_a_rectangle_without_a_disk) {
  const MeshData mesh = make_channel(3000);
  const auto points_of = [&](int marker) {
    std::vector<Point> points;
    for (const auto& edge : mesh.markers[marker].edges) {
      for (const int v : edge) points.push_back(mesh.points[v]);
    }
    return points;
  };
  for (const Point& p : points_of(0)) EXPECT_EQ(p.x, 0.0);
  for (const Point& p : points_of(1)) EXPECT_EQ(p.x, 4.0);
  for (const Point& p : points_of(2)) EXPECT_EQ(p.y, 0.0);
  for (const Point& p : points_of(3)) EXPECT_EQ(p.y, 1.0);
  for (const Point& p : points_of(4)) {
    EXPECT_NEAR(std::hypot(p.x - cylinder_centre.x, p.y - cylinder_centre.y), cylinder_radius, 1e-15);
  }
  EXPECT_NEAR(area(mesh), 4.0 - std::numbers::pi / 64.0, 5e-4);
  EXPECT_GT(mean_edge(mesh, mesh.markers[1]), 3.0 * mean_edge(mesh, mesh.markers[4]));
}

TEST(Shapes, are_known_by_name) {
  for (const ShapeInfo& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const MeshData least = make_shape(shape.name, {.vertices = shape.min_vertices});
    EXPECT_EQ(marker_names(least), shape.markers);
    EXPECT_FALSE(shape.description.empty());
    try {
      make_shape(shape.name, {.vertices = shape.min_vertices - 1});
      ADD_FAILURE() << "too few vertices are accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(shape.name));
      EXPECT_THAT(error.what(), HasSubstr(std::to_string(shape.min_vertices)));
    }
  }
}

// And before any memory is asked for.
TEST(Shapes, are_no_larger_than_numbers_go) {
  for (const auto& [nx, ny] :
       {std::pair(50000, 50000), {1, 1 << 28}, {2147483647, 2147483647}, {1 << 14, 1 << 13}}) {
    try {
      make_grid(nx, ny);
      ADD_FAILURE() << nx << " by " << ny << " cells are accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("of a grid, at most 268435455 expected"));
    }
  }
  for (const ShapeInfo& shape : shapes()) {
    try {
      make_shape(shape.name, {.vertices = 2147483647});
      ADD_FAILURE() << shape.name << ": too many vertices are accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("2147483647 vertices, expected at most 134217727"));
    }
  }
}

TEST(Shapes, unknown_names_are_refused_with_the_known_ones) {
  try {
    make_shape("torus");
    ADD_FAILURE() << "an unknown shape is accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"torus\""));
    for (const ShapeInfo& shape : shapes()) EXPECT_THAT(error.what(), HasSubstr(shape.name));
  }
}

// Sum of the signs of the faces over p among the first n.
int cover(const MeshData& mesh, const Point& p, int n) {
  int sum = 0;
  for (int i = 0; i < n; ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const std::array<Point, 3> t{mesh.points[a], mesh.points[b], mesh.points[c]};
    if (strictly_inside(p, t)) sum += static_cast<int>(orientation(t[0], t[1], t[2]));
  }
  return sum;
}

int n_inverted_components(const MeshData& mesh) {
  std::map<Edge, int> face_at;
  std::vector<int> leader(mesh.n_faces());
  for (int f = 0; f < mesh.n_faces(); ++f) {
    leader[f] = f;
    for (int k = 0; k < 3; ++k) face_at[{mesh.triangles[f][k], mesh.triangles[f][(k + 1) % 3]}] = f;
  }
  const auto inverted = [&](int f) { return turn(mesh, mesh.triangles[f]) == Orientation::Clockwise; };
  const auto find = [&](int f) {
    while (leader[f] != f) f = leader[f];
    return f;
  };
  for (const auto& [side, f] : face_at) {
    const auto other = face_at.find({side[1], side[0]});
    if (other != face_at.end() && inverted(f) && inverted(other->second))
      leader[find(f)] = find(other->second);
  }
  std::set<int> components;
  for (int f = 0; f < mesh.n_faces(); ++f) {
    if (inverted(f)) components.insert(find(f));
  }
  return static_cast<int>(components.size());
}

class Umbilics : public testing::TestWithParam<int> {};

TEST_P(Umbilics, are_tangled_disks_with_a_border_in_place) {
  const int k = GetParam();
  for (const int vertices : {189 * k + 1, 189 * k + 2, 400 * k}) {
    SCOPED_TRACE(vertices);
    const MeshData mesh = make_umbilic(k, vertices);
    EXPECT_NEAR(mesh.n_vertices(), vertices, 0.05 * vertices);
    expect_consistent(mesh, 0);
    for (const Triangle& t : mesh.triangles) ASSERT_NE(turn(mesh, t), Orientation::Collinear);
    for (const auto& [a, b] : mesh.markers[0].edges)
      EXPECT_NEAR(std::hypot(mesh.points[a].x, mesh.points[a].y), 4.0, 1e-12);
    EXPECT_GE(n_inverted_components(mesh), 2);
    if (k <= 8) {  // beyond, the cusps crumble
      EXPECT_LE(n_inverted_components(mesh), 3);
    }
    EXPECT_TRUE(same(mesh, make_umbilic(k, vertices)));
    EXPECT_FALSE(same(mesh, make_umbilic(k, vertices, 2)));
  }
}

// Every place is covered once, counting signs; but the rings down to the outer rim of the first sheet cover
// the hypocycloid, the shadow of the innermost inverted component, k + 1 times.
TEST_P(Umbilics, cover_the_shadow_more_than_once) {
  const int k = GetParam();
  const MeshData mesh = make_umbilic(k, 400 * k);
  const int ring = 2 * static_cast<int>(mesh.markers[0].edges.size());  // faces
  const double e = std::pow(7.0 * (k + 1), -1.0 / k), inscribed = (k - 1) * std::pow(e, k);
  std::mt19937_64 random(5);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < 30; ++i) {
    const double angle = 2.0 * std::numbers::pi * unit(), far = 3.5 * unit(),
                 near = (0.75 + 0.2 * unit()) * inscribed;
    EXPECT_EQ(cover(mesh, Point{std::cos(angle), std::sin(angle)} * far, mesh.n_faces()), 1);
    const Point p = Point{std::cos(angle), std::sin(angle)} * near;
    int most = 0;
    for (int n = ring; n < mesh.n_faces(); n += ring) most = std::max(most, cover(mesh, p, n));
    EXPECT_EQ(most, k + 1);
    EXPECT_EQ(cover(mesh, p, mesh.n_faces()), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Umbilics, testing::Values(2, 3, 4, 5, 8, 13, 32),
                         testing::PrintToStringParamName());

TEST(Shapes, umbilics_take_only_sensible_k) {
  EXPECT_THROW(make_umbilic(1, 1000), InputError);
  EXPECT_THROW(make_umbilic(33, 100000), InputError);
  EXPECT_THROW(make_umbilic(5, 900), InputError);
}

}  // namespace
}  // namespace kinemesh
