#include "core/sweep/face_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/sweep/face_minima.h"
#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/predicates.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

struct Stretch {
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  std::array<Point, 3> corners(int f) const {
    const auto& [a, b, c] = triangles[f];
    return {points[a], points[b], points[c]};
  }
  Sight seen_by(SweepKernel* kernel) const {
    return kernel(&points[0].x, triangles[0].data(), triangles[0].data());
  }
};

// Faces of few points, so that many are flat, doubled or thin; coordinates of the size 2^scale.
Stretch random_stretch(Random& random, int scale) {
  Stretch stretch;
  for (int i = 0; i < 12; ++i) {
    const Point p(random.between(-1, 1), random.between(-1, 1));
    stretch.points.push_back(std::ldexp(1.0, scale) * (random.one_in(2) ? p : snapped(0x1p-22 * p)));
  }
  for (int f = 0; f < stretch_faces; ++f)
    stretch.triangles.push_back({random.below(12), random.below(12), random.below(12)});
  return stretch;
}

// One face after the other; what is not a number counts for nothing.
Sight plain_sight(const Stretch& stretch) {
  Sight sight{0, INFINITY, INFINITY};
  for (int f = 0; f < stretch_faces; ++f) {
    const auto [a, b, c] = stretch.corners(f);
    const double l = (a.x - c.x) * (b.y - c.y), r = (a.y - c.y) * (b.x - c.x);
    const bool upright = l - r > orientation_error * (std::abs(l) + std::abs(r)) + underflow_error;
    sight.doubtful |= std::uint64_t{!upright} << f;
    sight.twice_area = std::fmin(sight.twice_area, twice_area({a, b, c}));
    sight.tangent = std::fmin(sight.tangent, tangent_of_smallest_angle({a, b, c}));
  }
  return sight;
}

void expect_equal(const Sight& seen, const Sight& expected, int scale) {
  EXPECT_EQ(seen.doubtful, expected.doubtful) << scale;
  EXPECT_EQ(seen.twice_area, expected.twice_area) << scale;
  EXPECT_EQ(seen.tangent, expected.tangent) << scale;
}

// Both kernels, where the machine has both.
void expect_seen(const Stretch& stretch, int scale) {
  const Sight measured = plain_sight(stretch), judged{measured.doubtful, INFINITY, INFINITY};
  for (const auto kernels : {sweep_by_two, sweep_by_four}) {
    if (!kernels(Look::Judge)) continue;
    expect_equal(stretch.seen_by(kernels(Look::Judge)), judged, scale);
    expect_equal(stretch.seen_by(kernels(Look::JudgeAndMeasure)), measured, scale);
  }
}

TEST(FaceSweep, SeesWithAnyWidthWhatIsThereFaceByFace) {
  Random random(1);
  int doubtful = 0;
  for (const int scale : {0, 20, -30, -500, -530, 505, 511, 1000}) {
    for (int i = 0; i < 200; ++i) {
      const Stretch stretch = random_stretch(random, scale);
      expect_seen(stretch, scale);
      doubtful += std::popcount(plain_sight(stretch).doubtful);
    }
  }
  const int upright = 8 * 200 * stretch_faces - doubtful;
  EXPECT_GT(doubtful, 10000);
  EXPECT_GT(upright, 10000);
}

// Any inverted or flat face has an angle of 0 degrees, so faces are drawn again until they are upright
TEST(FaceSweep, SeesTheSmallestAngleOfUprightFaces) {
  Random random(2);
  for (const int scale : {0, 20, -30, -400, 400, 505, 511}) {
    double smallest = INFINITY;
    for (int i = 0; i < 200; ++i) {
      Stretch stretch = random_stretch(random, scale);
      for (int f = 0; f < stretch_faces; ++f) {
        auto& t = stretch.triangles[f];
        do {
          t = {random.below(12), random.below(12), random.below(12)};
        } while (orientation(stretch.points[t[0]], stretch.points[t[1]], stretch.points[t[2]]) !=
                 Orientation::CounterClockwise);
      }
      expect_seen(stretch, scale);
      smallest = std::min(smallest, plain_sight(stretch).tangent);
    }
    if (scale == 511) continue;  // products overflow
    EXPECT_GT(smallest, 0.0) << scale;
    EXPECT_LT(smallest, 0.1) << scale;
  }
}

// Of the domain: brute force.
Minima minima_of(const Mesh& mesh) {
  Minima minima;
  for (const Face f : mesh.faces()) {
    if (mesh.is_padding(f)) continue;
    minima.twice_area = std::min(minima.twice_area, twice_area(mesh.corners(f)));
    minima.tangent = std::min(minima.tangent, tangent_of_smallest_angle(mesh.corners(f)));
  }
  return minima;
}

void expect_equal(const Minima& measured, const Minima& expected) {
  EXPECT_EQ(measured.twice_area, expected.twice_area);
  EXPECT_EQ(measured.tangent, expected.tangent);
}

TEST(FaceSweep, SeesTheLastFacesToo) {
  for (int n = 3; n <= 140; ++n) {
    Random random(n);
    Mesh mesh = build_mesh(random_square(n, random));
    const int last = n_stretches(mesh.n_faces()) - 1;
    const int rest = mesh.n_faces() - stretch_faces * last;
    EXPECT_EQ(look_at_stretch(mesh, last).doubtful, 0u) << n;
    for (auto& p : mesh.positions()) p.x = -p.x;
    const std::uint64_t all = rest == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
    EXPECT_EQ(look_at_stretch(mesh, last).doubtful, all) << n;
  }
}

TEST(FaceMinima, LeavePaddingOut) {
  Random random(3);
  const Mesh mesh = build_mesh(u_shape(300, random), {.frame = 0.25, .fixed = {}});
  FaceMinima minima;
  minima.reset(mesh.n_faces());
  expect_equal(minima.update(mesh), minima_of(mesh));
}

TEST(FaceMinima, FollowFacesThatAreOutdated) {
  Random random(4);
  Mesh mesh = build_mesh(random_grid(60, 60, random), {.frame = 0.25, .fixed = {}});
  FaceMinima minima;
  minima.reset(mesh.n_faces());
  minima.update(mesh);
  for (int round = 0; round < 200; ++round) {
    const Vertex vertex(random.below(mesh.n_vertices()));
    mesh.positions()[vertex] += Point(random.between(-0.9, 0.9), random.between(-0.9, 0.9));
    std::vector<Face> around;
    for (const Face f : mesh.faces())
      if (std::ranges::count(mesh.triangles()[f], vertex) > 0) around.push_back(f);
    minima.outdate(around);
    expect_equal(minima.update(mesh), minima_of(mesh));
  }
}

}  // namespace
}  // namespace kinemesh::test
