// Angles get better where they are bad; nothing else happens, in whatever order the mesh is stored.
#include "untangle/quality/angles.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "core/mesh/around.h"
#include "kinemesh/build.h"
#include "kinemesh/error.h"
#include "kinemesh/measure.h"
#include "kinemesh/shapes.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/disordered.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/quality/scattered.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"
#include "untangle/places/optimal_point.h"

namespace kinemesh::test {
namespace {

double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

// Valid, and as bad as a repair leaves it.
Mesh bad_but_valid(std::uint64_t seed) {
  auto [about, mesh, was_at] = random_tangle(seed);
  if (!repair(mesh, true)) throw std::logic_error("no valid mesh of " + about);
  return mesh;
}

// Valid, some hundred vertices, every angle there is.
Mesh scattered_domain(int number, std::uint64_t seed) {
  Mesh mesh = scattered(domain_number(number, seed).mesh, 1.0, seed);
  if (!repair(mesh)) throw std::logic_error("no valid mesh");
  return mesh;
}

double smallest(const std::array<Point, 3>& corners) {
  return tangent_of_smallest_angle(corners);
}

// --- Oracle: what could still be done, by looking at everything ---

std::string flip_that_helps(const Mesh& mesh, Face face) {
  for (const Side h : mesh.sides(face)) {
    if (!mesh.is_flippable(h)) continue;
    Mesh flipped = mesh;
    const Face other = mesh.face_across(h);
    flipped.flip(h);
    if (!is_upright(flipped, face) || !is_upright(flipped, other)) continue;
    const double before = std::min(smallest(mesh.corners(face)), smallest(mesh.corners(other)));
    const double after = std::min(smallest(flipped.corners(face)), smallest(flipped.corners(other)));
    if (std::atan(after) > 1.00014 * std::atan(before)) return "flip at face " + std::to_string(face);
  }
  return "";
}

// 100 places around the vertex, and the best one as far as optimal_point can tell.
bool is_well_placed(const Mesh& mesh, Vertex vertex) {
  std::vector<LinkEdge> link;
  for_each_side_from(mesh, vertex, [&](Side side) {
    link.push_back({mesh.position(mesh.to(side)), mesh.position(mesh.apex(side))});
  });
  const Point x = mesh.position(vertex);
  return smallest_angle(link, optimal_point(link, x)) <= 1.0002 * smallest_angle(link, x);
}

std::string move_that_helps(const Mesh& mesh, Face face) {
  for (const Vertex v : mesh.triangles()[face])
    if (is_free(mesh, v) && !is_well_placed(mesh, v)) return "move of vertex " + std::to_string(v);
  return "";
}

std::string what_is_left(const Mesh& mesh, double angle) {
  std::string left;
  for (Face f{0}; f < mesh.n_faces() && left.empty(); ++f) {
    if (mesh.is_padding(f) || smallest(mesh.corners(f)) >= tangent_of(angle)) continue;
    left = flip_that_helps(mesh, f) + move_that_helps(mesh, f);
  }
  return left;
}

// --- Properties ---

void expect_kept(const Mesh& before, const Mesh& mesh, const std::string& about) {
  EXPECT_EQ(message(validate(mesh)), "") << about;
  EXPECT_EQ(moved_what_stays(before, mesh), "") << about;
  auto labels = before.domain().labels, labels_now = mesh.domain().labels;
  std::ranges::sort(labels);
  std::ranges::sort(labels_now);
  EXPECT_EQ(labels, labels_now) << about;
  EXPECT_EQ(message(validate_connectivity(mesh)), "") << about;  // its constrained edges among others
}

TEST(Angles, GetBetterAndNothingElseChanges) {
  int better = 0, met = 0, converged = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const auto about = "seed " + std::to_string(seed);
    const Mesh before = bad_but_valid(seed);
    Mesh mesh = before;
    const double angle = 5.0 + 5.0 * static_cast<double>(seed % 7);
    const int rounds = seed % 2 ? 20 : 2000;
    const auto outcome = improve_angles(mesh, {.angle = angle, .max_rounds = rounds});
    expect_kept(before, mesh, about);
    EXPECT_EQ(outcome.min_angle_before_deg, measure(before).min_angle_deg);
    EXPECT_EQ(outcome.min_angle_after_deg, measure(mesh).min_angle_deg);
    EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg) << about;
    EXPECT_FALSE(outcome.counts.is_cut);
    EXPECT_EQ(outcome.counts.rounds == 0, outcome.counts.flips + outcome.counts.moves == 0);
    better += outcome.min_angle_after_deg > outcome.min_angle_before_deg;
    met += outcome.counts.left == 0;
    if (outcome.counts.rounds == rounds) continue;
    ++converged;
    EXPECT_EQ(what_is_left(mesh, angle), "") << about;
  }
  EXPECT_GT(better, 1000);
  EXPECT_GT(met, 330);
  EXPECT_GT(converged, 1200);
  RecordProperty("better", better);
  RecordProperty("met", met);
  RecordProperty("converged", converged);
}

TEST(Angles, ReachWhatIsWantedInScatteredDomains) {
  for (int number = 0; number < n_domains; ++number) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto about = domain_number(number, seed).about + " " + std::to_string(seed);
      const Mesh before = scattered_domain(number, seed);
      ASSERT_LT(measure(before).min_angle_deg, 5.0) << about;
      Mesh mesh = before;
      const auto outcome = improve_angles(mesh, {.angle = 15.0, .max_rounds = 100});
      expect_kept(before, mesh, about);
      EXPECT_GE(outcome.min_angle_after_deg, 15.0 - 1e-9) << about << " " << outcome.counts.left;
      EXPECT_EQ(outcome.counts.left, 0) << about;
    }
  }
}

TEST(Angles, LeaveAMeshAloneThatMeetsThem) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Mesh before = bad_but_valid(seed);
    const double angle = measure(before).min_angle_deg * (1.0 - 1e-12);
    if (!(angle > 0.0)) continue;
    Mesh mesh = before;
    const auto counts = improve_angles(mesh, {.angle = angle}).counts;
    EXPECT_EQ(counts.flips + counts.moves + counts.rounds + counts.left, 0) << seed;
    EXPECT_EQ(snapshot_of(mesh), snapshot_of(before)) << seed;
  }
}

TEST(Angles, ChangeNothingOfWhatIsFarFromABadOne) {
  Mesh mesh = build_mesh(make_square(2000, 1), {.frame = 0.25});
  improve_angles(mesh, {.angle = 20.0});
  ASSERT_GT(measure(mesh).min_angle_deg, 20.0 - 1e-9);
  const double near = 4.0 * mean_spacing(mesh);
  Vertex v(0);
  const auto distance = [&](const Point& p) { return std::hypot(p.x - 0.5, p.y - 0.5); };
  for (const Vertex u : mesh.vertices()) v = distance(mesh.position(u)) < distance(mesh.position(v)) ? u : v;
  const Point place = mesh.position(v), neighbour = mesh.position(mesh.to(mesh.side_from(v)));
  double share = 1.0;
  do {
    share *= 0.9;
    mesh.positions()[v] = place + share * (neighbour - place);
  } while (validate(mesh) || measure(mesh).min_angle_deg > 15.0);
  const Mesh before = mesh;
  const auto counts = improve_angles(mesh, {.angle = 20.0}).counts;
  EXPECT_GT(counts.moves + counts.flips, 0);
  for (const Vertex u : mesh.vertices()) {
    EXPECT_TRUE(distance(mesh.position(u)) < near || mesh.position(u) == before.position(u));
  }
}

TEST(Angles, SayWhatTheyHaveMovedAndFlipped) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Mesh before = bad_but_valid(seed);
    Mesh mesh = before;
    AngleUpkeep upkeep(mesh, {.angle = 30.0});
    for (int again = 0; again < 2; ++again) {
      const Mesh now = mesh;
      const auto counts = upkeep.run(mesh);
      std::set<Vertex> moved;
      const std::set<Face> flipped(upkeep.flipped_faces().begin(), upkeep.flipped_faces().end());
      for (const auto& [vertex, was_at] : upkeep.moved_vertices()) {
        EXPECT_TRUE(moved.insert(vertex).second);
        EXPECT_EQ(was_at, now.position(vertex));
      }
      EXPECT_EQ(flipped.size(), upkeep.flipped_faces().size());
      EXPECT_LE(static_cast<int>(flipped.size()), 2 * counts.flips);
      EXPECT_LE(static_cast<int>(moved.size()), counts.moves);
      for (const Vertex v : mesh.vertices())
        EXPECT_TRUE(moved.contains(v) || mesh.position(v) == now.position(v));
      for (const Face f : mesh.faces())
        EXPECT_TRUE(flipped.contains(f) || mesh.triangles()[f] == now.triangles()[f]);
    }
  }
}

// --- The same bits ---

// Faces by users' numbers, the smallest first, in ascending order.
std::vector<Triangle> faces_of(const Mesh& mesh) {
  std::vector<Triangle> faces = mesh.domain().triangles;
  for (auto& t : faces) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(faces);
  return faces;
}

TEST(Angles, DoNotDependOnHowTheMeshIsStored) {
  int differently = 0;
  for (int number = 0; number < n_domains; ++number) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Mesh mesh = scattered_domain(number, seed);
      const MeshData data = mesh.domain();
      improve_angles(mesh, {.angle = 25.0});
      for (const double frame : {0.25, 0.6}) {
        Mesh other = disordered(shuffled(data, seed), {.frame = frame}, seed);
        differently += !std::ranges::equal(other.triangles(), mesh.triangles());
        improve_angles(other, {.angle = 25.0});
        EXPECT_EQ(other.user_positions(), mesh.user_positions()) << number << " " << seed;
        EXPECT_EQ(faces_of(other), faces_of(mesh)) << number << " " << seed;
      }
    }
  }
  EXPECT_EQ(differently, 2 * 6 * n_domains);
}

TEST(Angles, DoNotDependOnTheNumberOfThreads) {
  const Mesh before = [] {
    Mesh mesh = scattered(build_mesh(make_square(3000, 5), {.frame = 0.25}), 0.5, 7);
    EXPECT_TRUE(repair(mesh));
    return mesh;
  }();
  std::vector<Mesh> results;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(before);
    EXPECT_GT(improve_angles(results.back(), {.angle = 25.0}).counts.moves, 300);
  }
  EXPECT_EQ(snapshot_of(results[0]), snapshot_of(results[1]));
  EXPECT_EQ(snapshot_of(results[0]), snapshot_of(results[2]));
}

TEST(Angles, DoNotDependOnScaleByPowersOfTwo) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Mesh before = bad_but_valid(seed);
    Mesh mesh = before;
    improve_angles(mesh, {.angle = 25.0});
    for (const double scale : {0x1p-40, 0x1p30}) {
      Mesh scaled = before;
      for (auto& p : scaled.positions()) p *= scale;
      improve_angles(scaled, {.angle = 25.0});
      for (auto& p : scaled.positions()) p /= scale;
      EXPECT_EQ(snapshot_of(scaled), snapshot_of(mesh)) << seed;
    }
  }
}

TEST(Angles, GetBetterInMirroredAndTurnedMeshes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const MeshData data = bad_but_valid(seed).domain();
    MeshData turned = data;
    for (auto& p : turned.points) p = {-p.y, p.x};
    for (const MeshData& each : {mirrored(data), turned, mapped(data, {1e-3, 1e-3}, {5.0, -7.0})}) {
      const Mesh before = build_mesh(each, {.frame = 0.25});
      if (validate(before)) continue;  // vertices beyond their borders
      Mesh mesh = before;
      const auto outcome = improve_angles(mesh, {.angle = 25.0});
      expect_kept(before, mesh, std::to_string(seed));
      EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg) << seed;
    }
  }
}

// --- Who may move ---

TEST(Angles, NeverMoveWhatIsHeldOrFixed) {
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const MeshData data = bad_but_valid(seed).domain();
    Random random(seed);
    std::vector<int> fixed;
    for (int u = 0; u < data.n_vertices(); ++u)
      if (random.one_in(4)) fixed.push_back(u);
    const Mesh before = build_mesh(data, {.frame = 0.25, .fixed = fixed});
    if (validate(before)) continue;
    VertexFreedom freedom;
    freedom.held.resize(before.n_vertices());
    for (auto& held : freedom.held) held = random.one_in(4);
    Mesh mesh = before;
    improve_angles(mesh, {.angle = 25.0}, freedom);
    expect_kept(before, mesh, std::to_string(seed));
    for (const Vertex v : mesh.vertices()) {
      const bool is_moved = mesh.position(v) != before.position(v);
      EXPECT_FALSE(is_moved && (freedom.held[v] || before.is_fixed(v))) << seed;
      moved += is_moved;
    }
  }
  EXPECT_GT(moved, 500);
}

// The unit square, turned; its vertices but the corners slide along its sides, where they are crowded.
struct Sliding {
  Mesh mesh;
  VertexFreedom freedom;
};

Sliding crowded_square(double turn, std::uint64_t seed) {
  constexpr int n = 12;
  Random random(seed);
  MeshData data = make_grid(n + 1, n + 1);
  const double c = std::cos(turn), s = std::sin(turn);
  std::vector<Point> tangent(data.points.size(), {0.0, 0.0});
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    Point& p = data.points[i];
    const bool x_end = p.x == 0.0 || p.x == 1.0, y_end = p.y == 0.0 || p.y == 1.0;
    if (!x_end) p.x += random.between(-0.45, 0.45) / n;
    if (!y_end) p.y += random.between(-0.45, 0.45) / n;
    if (x_end != y_end) tangent[i] = x_end ? Point(-s, c) : Point(c, s);
    p = {c * p.x - s * p.y, s * p.x + c * p.y};
  }
  Mesh mesh = build_mesh(data, {.frame = 0.25});
  if (!repair(mesh, true)) throw std::logic_error("no valid mesh");
  VertexFreedom freedom;
  for (const Vertex v : mesh.vertices())
    if (const UserVertex u = mesh.user_vertex(v); u != none && tangent[u] != Point(0.0, 0.0))
      freedom.tangents.emplace(v, tangent[u]);
  return {std::move(mesh), std::move(freedom)};
}

TEST(Angles, LetVerticesSlideAlongTheirLinesInOrder) {
  int slid = 0;
  double gain = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const double turn = seed % 2 ? 0.0 : 0.01 * static_cast<double>(seed);
    const auto [before, freedom] = crowded_square(turn, seed);
    Mesh mesh = before, stiff = before;
    const auto outcome = improve_angles(mesh, {.angle = 40.0}, freedom);
    gain += outcome.min_angle_after_deg - improve_angles(stiff, {.angle = 40.0}).min_angle_after_deg;
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg);
    for (const Vertex v : mesh.vertices()) {
      if (is_free(before, v)) continue;
      const Point d = mesh.position(v) - before.position(v);
      if (d == Point(0.0, 0.0)) continue;
      ++slid;
      ASSERT_TRUE(freedom.tangents.contains(v)) << seed;
      const Point t = freedom.tangents.at(v);
      EXPECT_LE(std::abs(d.x * t.y - d.y * t.x), turn == 0.0 ? 0.0 : 1e-15) << seed;
    }
    for (const auto& [number, t] : freedom.tangents) {
      const Vertex v(number);  // its neighbours along the border are still on either side
      for_each_neighbour(mesh, v, [&, t = t](Vertex neighbour, Side side) {
        if (mesh.constraint_of(side) == none) return;
        const Point now = mesh.position(neighbour) - mesh.position(v);
        const Point then = before.position(neighbour) - before.position(v);
        EXPECT_GT((now.x * t.x + now.y * t.y) * (then.x * t.x + then.y * t.y), 0.0) << seed;
      });
    }
  }
  EXPECT_GT(slid, 500);
  EXPECT_GT(gain, 0.0);
  RecordProperty("slid", slid);
}

// The circles of an annulus slide.
struct Circle {
  std::vector<UserVertex> vertices;  // in order
  Polyline line;
};

std::vector<Circle> circles_of(const MeshData& annulus) {
  std::vector<Circle> circles;
  for (const Marker& marker : annulus.markers) {
    std::vector<UserVertex> vertices;
    for (const Edge& edge : marker.edges) vertices.push_back(UserVertex(edge[0]));
    std::ranges::sort(vertices, {},
                      [&](UserVertex v) { return std::atan2(annulus.points[v].y, annulus.points[v].x); });
    std::vector<Point> points;
    for (const UserVertex v : vertices) points.push_back(annulus.points[v]);
    points.push_back(points.front());
    circles.push_back({std::move(vertices), Polyline(std::move(points))});
  }
  return circles;
}

VertexFreedom freedom_on(const std::vector<Circle>& circles, const Mesh& mesh) {
  VertexFreedom freedom;
  for (const Circle& circle : circles) {
    for (const UserVertex user : circle.vertices)
      freedom.curve_of.emplace(mesh.vertex_of_user(user), static_cast<int>(freedom.curves.size()));
    freedom.curves.push_back(circle.line);
  }
  return freedom;
}

// Valid; vertices are thrown about, those of the circles along these.
MeshData crowded(MeshData annulus, const std::vector<Circle>& circles, std::uint64_t seed) {
  Random random(seed);
  for (const auto& [vertices, line] : circles)
    for (const UserVertex v : vertices) {
      const double way = random.between(-0.45, 0.45) * line.length() / static_cast<double>(vertices.size());
      annulus.points[v] = line.at(line.parameter_near(annulus.points[v]) + way);
    }
  Mesh mesh = scattered(build_mesh(annulus, {.frame = 0.25}), 0.5, seed);
  if (!repair(mesh, true)) throw std::logic_error("no valid mesh");
  return mesh.domain();
}

bool are_in_order(const Circle& circle, std::span<const Point> at) {
  double round = 0.0;
  for (std::size_t i = 0, n = circle.vertices.size(); i < n; ++i) {
    const double here = circle.line.parameter_near(at[circle.vertices[i]]);
    const double way = circle.line.way(here, circle.line.parameter_near(at[circle.vertices[(i + 1) % n]]));
    if (!(way > 0.0)) return false;
    round += way;
  }
  return std::abs(round / circle.line.length() - 1.0) < 1e-9;
}

TEST(Angles, LetVerticesSlideAlongCurvesInOrder) {
  int slid = 0;
  double gain = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const MeshData annulus = make_annulus(200, seed);
    const auto circles = circles_of(annulus);
    ASSERT_EQ(circles.size(), 2u);
    const Mesh before = build_mesh(crowded(annulus, circles, seed), {.frame = 0.25});
    const VertexFreedom freedom = freedom_on(circles, before);
    Mesh mesh = before, stiff = before;
    const auto outcome = improve_angles(mesh, {.angle = 35.0}, freedom);
    gain += outcome.min_angle_after_deg - improve_angles(stiff, {.angle = 35.0}).min_angle_after_deg;
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    EXPECT_GE(outcome.min_angle_after_deg, outcome.min_angle_before_deg) << seed;
    for (const Vertex v : mesh.vertices()) {
      if (is_free(before, v) || mesh.position(v) == before.position(v)) continue;
      ++slid;
      ASSERT_TRUE(freedom.curve_of.contains(v)) << seed;
      const Polyline& curve = freedom.curves[freedom.curve_of.at(v)];
      const Point off = mesh.position(v) - curve.at(curve.parameter_near(mesh.position(v)));
      EXPECT_LE(std::hypot(off.x, off.y), 1e-14) << seed;
    }
    for (const Circle& circle : circles) EXPECT_TRUE(are_in_order(circle, mesh.user_positions())) << seed;
  }
  EXPECT_GT(slid, 500);
  EXPECT_GT(gain, 60.0);
  RecordProperty("slid", slid);
  RecordProperty("gain", std::to_string(gain));
}

TEST(Angles, OnCurvesDoNotDependOnHowTheMeshIsStored) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MeshData annulus = make_annulus(200, seed);
    const auto circles = circles_of(annulus);
    const MeshData data = crowded(annulus, circles, seed);
    Mesh mesh = build_mesh(data, {.frame = 0.25}),
         other = disordered(shuffled(data, seed), {.frame = 0.6}, seed);
    improve_angles(mesh, {.angle = 30.0}, freedom_on(circles, mesh));
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    improve_angles(other, {.angle = 30.0}, freedom_on(circles, other));
    EXPECT_EQ(other.user_positions(), mesh.user_positions()) << seed;
    EXPECT_EQ(faces_of(other), faces_of(mesh)) << seed;
  }
}

TEST(Angles, LeaveTheConvexHullOfTheMeshWhereItIs) {
  int slid = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MeshData annulus = make_annulus(200, seed);
    const auto circles = circles_of(annulus);
    Mesh mesh = scattered(build_mesh(annulus), 1.0, seed);
    ASSERT_TRUE(repair(mesh));
    improve_angles(mesh, {.angle = 35.0}, freedom_on(circles, mesh));
    EXPECT_EQ(message(validate(mesh)), "") << seed;
    const auto now = mesh.user_positions();
    for (std::size_t i = 0; i < circles.size(); ++i)
      for (const UserVertex v : circles[i].vertices) {
        const bool is_moved = now[v] != annulus.points[v], is_outer = glm::length(annulus.points[v]) > 0.75;
        EXPECT_FALSE(is_moved && is_outer) << seed;
        slid += is_moved;
      }
  }
  EXPECT_GT(slid, 20);
}

TEST(Angles, RefuseWhatMakesNoSense) {
  Mesh mesh = build_mesh(make_grid(4, 4));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double angle : {0.0, -1.0, 60.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(improve_angles(mesh, {.angle = angle}), InputError) << angle;
  EXPECT_THROW(improve_angles(mesh, {.max_rounds = -1}), InputError);
  VertexFreedom held, on_curve;
  held.held = {true, false};
  on_curve.curve_of[3] = 0;
  EXPECT_THROW(improve_angles(mesh, {}, held), InputError);
  EXPECT_THROW(improve_angles(mesh, {}, on_curve), InputError);
  mesh.positions()[5] += Point(0.9, 0.9);
  EXPECT_THROW(improve_angles(mesh), InputError);
}

TEST(Angles, DoNothingInNoRounds) {
  const Mesh before = scattered_domain(0, 1);
  Mesh mesh = before;
  const auto counts = improve_angles(mesh, {.angle = 25.0, .max_rounds = 0}).counts;
  EXPECT_EQ(counts.flips + counts.moves + counts.rounds, 0);
  EXPECT_GT(counts.left, 0);
  EXPECT_EQ(snapshot_of(mesh), snapshot_of(before));
}

}  // namespace
}  // namespace kinemesh::test
