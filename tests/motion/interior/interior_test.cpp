#include "motion/interior/interior.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "kinemesh/error.h"
#include "kinemesh/shapes.h"
#include "tests/motion/grid.h"
#include "tests/motion/interior/dense_interior.h"

namespace kinemesh {
namespace {

using test::DenseSolution;
using test::grid;
using test::grid_vertex;
using test::mapped;
using test::solve_densely;

using Map = std::function<Point(Point)>;

// A mesh, what is known of its increments, and what they are on top of.
struct Case {
  Mesh mesh;
  std::vector<Role> roles;
  std::unordered_map<int, Point> tangents = {};
  std::vector<Point> increments;  // start vector
  std::vector<Point> others = {};

  explicit Case(const MeshData& data, const BuildOptions& options = {})
      : mesh(build_mesh(data, options)),
        roles(mesh.n_vertices(), Role::Free),
        increments(mesh.n_vertices(), Point(0.0, 0.0)) {}

  InteriorProblem problem() const { return {roles, tangents, others}; }
  void fix(Vertex v, const Point& increment) {
    roles[v] = Role::Known;
    increments[v] = increment;
  }
};

std::vector<Vertex> border(const Mesh& mesh) {
  std::vector<Vertex> vertices;
  for (const auto& constraint : mesh.constraints())
    if (constraint.is_border()) vertices.insert(vertices.end(), {constraint.from, constraint.to});
  return vertices;
}

Case with_border(const MeshData& data, const Map& increment) {
  Case c(data);
  for (const Vertex v : border(c.mesh)) c.fix(v, increment(c.mesh.position(v)));
  return c;
}

std::vector<Point> solved(const Case& c, const InteriorOptions& options = {}) {
  auto increments = c.increments;
  const auto solution = Interior(c.mesh, options).solve(c.mesh, c.problem(), increments);
  EXPECT_TRUE(solution.converged);
  EXPECT_LE(solution.residual, options.tolerance);
  return increments;
}

double largest(std::span<const Point> vectors) {
  double length = 0.0;
  for (const auto& v : vectors) length = std::max(length, glm::length(v));
  return length;
}

double largest_difference(std::span<const Point> a, std::span<const Point> b) {
  double length = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) length = std::max(length, glm::distance(a[v], b[v]));
  return length;
}

double largest_error(const Case& c, std::span<const Point> increments, const Map& exact) {
  double error = 0.0;
  for (const Vertex v : c.mesh.vertices())
    if (c.mesh.user_vertex(v) != none && !c.mesh.is_isolated(v))
      error = std::max(error, glm::distance(increments[v], exact(c.mesh.position(v))));
  return error;
}

bool same_bits(std::span<const Point> a, std::span<const Point> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

MeshData times(const MeshData& data, double factor) {
  return mapped(data, [factor](const Point& p) { return factor * p; });
}

constexpr Follow follows[] = {Follow::Harmonic, Follow::Elastic};

// --- Against elimination ---

class RandomCase {
 public:
  explicit RandomCase(std::uint64_t seed) : random_(seed) {}

  // A jittered grid with holes, in which parts may touch in a vertex or not at all, with three labels.
  MeshData mesh() {
    const int n = 4 + number(4);
    MeshData data =
        mapped(grid(n), [&](const Point& p) { return p + Point(real(), real()) * 0.22 / double(n); });
    std::vector<Triangle> triangles;
    for (std::size_t f = 0; f < data.triangles.size(); f += 2) {  // a square of the grid
      if (number(6) == 0) continue;
      triangles.insert(triangles.end(), data.triangles.begin() + f, data.triangles.begin() + f + 2);
    }
    if (triangles.size() > 10) data.triangles = triangles;
    data.markers.clear();
    const int labels = 1 + number(3);
    data.labels.clear();
    for (std::size_t f = 0; f < data.triangles.size(); ++f) data.labels.push_back(number(labels));
    return data;
  }

  Case operator()() {
    Case c(mesh(), {.frame = number(2) * 0.2});
    const int known = 1 + number(9), sliding = 1 + number(9);
    const bool some_rest = number(3) == 0;
    for (const Vertex v : border(c.mesh)) {
      if (number(known) != 0)
        c.fix(v, some_rest && number(2) == 0 ? Point(0.0, 0.0) : 0.02 * Point(real(), real()));
      else if (number(sliding) == 0 && c.roles[v] == Role::Free)
        slide(c, v);
    }
    if (number(2) == 0) c.others.resize(c.mesh.n_vertices());
    for (auto& other : c.others) other = 0.01 * Point(real(), real());
    for (const Vertex v : c.mesh.vertices())
      if (c.roles[v] != Role::Known && number(2) == 0) c.increments[v] = 0.05 * Point(real(), real());
    return c;
  }

  InteriorOptions options(Follow follow) {
    const double range = number(2) == 0 ? 3.0 : 1.0;
    return {.follow = follow,
            .stiffness = {{1, std::pow(10.0, range * real())}, {2, std::pow(10.0, -range)}},
            .tolerance = 1e-11};
  }

 private:
  int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  double real() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  void slide(Case& c, Vertex v) {
    const double angle = 4.0 * real();
    c.roles[v] = Role::Slide;
    c.tangents[v] = Point(std::cos(angle), std::sin(angle));
  }

  std::mt19937_64 random_;
};

TEST(Interior, AgreesWithElimination) {
  int compared = 0;
  for (const Follow follow : follows)
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      RandomCase random(seed);
      const Case c = random();
      const InteriorOptions options = random.options(follow);
      const DenseSolution exact = solve_densely(c.mesh, options, c.problem(), c.increments);
      const auto increments = solved(c, options);
      for (const Vertex v : c.mesh.vertices()) {
        if (c.roles[v] == Role::Known) {
          EXPECT_EQ(increments[v], c.increments[v]);
        } else if (exact.increments[v] == Point(0.0, 0.0) && exact.is_unique) {
          EXPECT_EQ(increments[v], Point(0.0, 0.0));
        }
      }
      if (!exact.is_unique) continue;
      ++compared;
      EXPECT_LE(largest_difference(increments, exact.increments), 1e-6 * largest(exact.increments))
          << "seed " << seed << ", " << (follow == Follow::Harmonic ? "harmonic" : "elastic");
    }
  EXPECT_GT(compared, 450);
}

// --- Against exact solutions; increments so small that the mesh halfway is the mesh ---

constexpr double tiny = 1e-7;

// Errors at n and 2 n, the latter scaled back to what second order would make of it.
void expect_second_order(const std::function<MeshData(int)>& mesh, const InteriorOptions& options,
                         const Map& exact) {
  const auto small = [&](const Point& p) { return tiny * exact(p); };
  std::vector<double> errors;
  for (const int n : {16, 32, 64}) {
    const Case c = with_border(mesh(n), small);
    errors.push_back(largest_error(c, solved(c, options), small) / tiny);
  }
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.2);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.4);
}

TEST(Interior, ConvergesToHarmonicFunctionsWhereFacesAreEqual) {
  expect_second_order(grid, {.tolerance = 1e-10}, [](const Point& p) {
    return std::exp(2.0 * p.x) * Point(std::cos(2.0 * p.y), std::sin(2.0 * p.y));
  });
}

// Columns get wider by e^(a x): the stiffness is e^(-a x), and X(x) Y(y) with X = e^(m x), m^2 - a m = l^2, Y
// = sin(l y) solves div(e^(-a x) grad u) = 0.
TEST(Interior, ConvergesToTheSolutionWithStiffnessOneOverArea) {
  constexpr double a = 1.5, l = 2.0;
  const double m = 0.5 * (a + std::sqrt(a * a + 4.0 * l * l));
  const auto graded = [](int n) {
    return mapped(grid(n),
                  [](const Point& p) { return Point(-std::log(1.0 - p.x * (1.0 - std::exp(-a))) / a, p.y); });
  };
  expect_second_order(graded, {.tolerance = 1e-10}, [=](const Point& p) {
    return std::exp(m * (p.x - 1.0)) * Point(std::sin(l * p.y), std::cos(l * p.y));
  });
}

// [Muskhelishvili 1953, §32]: 2 mu (u + i v) = (3 - 4 nu) f - z conj(f') - conj(g) for analytic f and g.
TEST(Interior, ConvergesToElasticDisplacements) {
  expect_second_order(grid, {.follow = Follow::Elastic, .tolerance = 1e-10}, [](const Point& p) {
    const std::complex<double> z(p.x, p.y), f = std::exp(z), g = std::sin(z);
    const auto w = (3.0 - 4.0 * 0.3) * f - z * std::conj(f) - std::conj(g);
    return Point(w.real(), w.imag());
  });
}

// --- What is reproduced whatever the mesh ---

TEST(Interior, FollowsTranslations) {
  const Point way(0.3, -0.2);
  for (const Follow follow : follows)
    for (const auto& data : {make_annulus(2000), make_channel(2000), make_square(500)}) {
      const auto translation = [&](const Point&) { return way; };
      const Case c = with_border(data, translation);
      EXPECT_LE(largest_error(c, solved(c, {.follow = follow}), translation), 1e-3 * glm::length(way));
      EXPECT_LE(largest_error(c, solved(c, {.follow = follow, .tolerance = 1e-10}), translation), 1e-8);
    }
}

TEST(Interior, FollowsAffineMapsWhereFacesAreEqual) {
  std::mt19937 random(3);
  MeshData data = mapped(grid(30), [](const Point& p) { return Point(2.0 * p.x + p.y, 0.3 * p.x + p.y); });
  for (std::size_t f = 0; f < data.triangles.size(); f += 2)  // the other diagonal of some
    if (random() % 2 == 0) {
      const int corner = static_cast<int>(f / 2) + static_cast<int>(f / 2) / 30;
      data.triangles[f] = {corner, corner + 1, corner + 31};
      data.triangles[f + 1] = {corner + 1, corner + 32, corner + 31};
    }
  const auto affine = [](const Point& p) {
    return Point(0.1 + 0.2 * p.x - 0.3 * p.y, 0.25 * p.x + 0.4 * p.y);
  };
  for (const Follow follow : follows) {
    const Case c = with_border(data, affine);
    EXPECT_LE(largest_error(c, solved(c, {.follow = follow, .tolerance = 1e-9}), affine), 1e-7);
  }
}

TEST(Interior, ElasticFollowsInfinitesimalRotations) {
  const auto rotation = [](const Point& p) { return tiny * Point(-p.y, p.x); };
  for (const auto& data : {make_annulus(1000), make_channel(1000)}) {
    const Case c = with_border(data, rotation);
    const InteriorOptions options{.follow = Follow::Elastic, .stiffness = {{0, 7.0}}, .tolerance = 1e-10};
    EXPECT_LE(largest_error(c, solved(c, options), rotation), 1e-6 * tiny);
  }
}

// --- What stays ---

TEST(Interior, StaysWhereNothingMoves) {
  for (const Follow follow : {Follow::None, Follow::Harmonic, Follow::Elastic}) {
    Case c = with_border(make_annulus(500), [](const Point&) { return Point(0.0, 0.0); });
    for (const Vertex v : c.mesh.vertices())
      if (c.roles[v] == Role::Free) c.increments[v] = {0.1, 0.2};
    const std::vector<Point> zero(c.mesh.n_vertices(), Point(0.0, 0.0));
    EXPECT_TRUE(same_bits(solved(c, {.follow = follow}), zero));
  }
}

// Two squares, the first of which has a border that moves; the other's rests, slides, or is free.
TEST(Interior, PartsThatNothingPullsStay) {
  MeshData data = grid(8);
  const MeshData second = mapped(data, [](const Point& p) { return p + Point(2.0, 0.0); });
  for (auto t : second.triangles) {
    for (int& v : t) v += data.n_vertices();
    data.triangles.push_back(t);
  }
  data.points.insert(data.points.end(), second.points.begin(), second.points.end());
  for (const Role role : {Role::Known, Role::Slide, Role::Free})
    for (const Follow follow : follows) {
      Case c(data);
      for (const Vertex v : border(c.mesh)) {
        c.roles[v] = c.mesh.position(v).x < 1.5 ? Role::Known : role;
        if (c.mesh.position(v).x < 1.5) c.increments[v] = Point(0.01, 0.02);
        if (role == Role::Slide) c.tangents[v] = Point(1.0, 0.0);
      }
      for (const Vertex v : c.mesh.vertices())
        if (c.roles[v] != Role::Known) c.increments[v] = {0.1, 0.2};
      const auto increments = solved(c, {.follow = follow});
      for (const Vertex v : c.mesh.vertices())
        EXPECT_EQ(increments[v] != Point(0.0, 0.0), c.mesh.position(v).x < 1.5);
    }
}

TEST(Interior, SlidesAlongTangentsOnly) {
  Case c = with_border(make_square(800), [](const Point& p) { return Point(0.1 * p.x, 0.0); });
  const double tilt = 0.7;
  for (const Vertex v : border(c.mesh)) {
    const Point p = c.mesh.position(v);
    if (p.x <= 0.0 || p.x >= 1.0) continue;
    c.roles[v] = Role::Slide;
    c.tangents[v] = p.y < 0.5 ? Point(1.0, 0.0) : Point(std::cos(tilt), std::sin(tilt));
    c.increments[v] = {0.3, 0.3};
  }
  for (const Follow follow : follows) {
    const auto increments = solved(c, {.follow = follow});
    for (const auto& [v, tangent] : c.tangents) {
      EXPECT_NEAR(glm::dot(increments[v], Point(-tangent.y, tangent.x)), 0.0, 1e-15);
      EXPECT_NE(increments[v], Point(0.0, 0.0));
      EXPECT_TRUE(tangent.y != 0.0 || increments[v].y == 0.0);
    }
  }
}

// --- Units, threads, starts ---

Case turning(const MeshData& data, double factor = 1.0, const Point& shift = {0.0, 0.0}) {
  return with_border(data, [=](const Point& p) {
    const Point x = (p - shift) / factor;
    return glm::length(x) < 0.75 ? factor * 0.05 * Point(0.3 - x.y, x.x) : Point(0.0, 0.0);
  });
}

TEST(Interior, KeepsItsBitsWhenScaledByPowersOfTwo) {
  for (const Follow follow : follows) {
    const Case c = turning(make_annulus(3000));
    auto increments = solved(c, {.follow = follow});
    for (const double factor : {0x1p20, 0x1p-20}) {
      const Case scaled = turning(times(make_annulus(3000), factor), factor);
      auto expected = increments;
      for (auto& p : expected) p *= factor;
      EXPECT_TRUE(same_bits(solved(scaled, {.follow = follow}), expected));
    }
  }
}

TEST(Interior, DoesNotDependOnUnitsOrPlace) {
  const MeshData data = make_annulus(3000);
  for (const Follow follow : follows) {
    const InteriorOptions options{.follow = follow, .tolerance = 1e-8};
    const Case c = turning(data);
    const auto increments = c.mesh.in_user_order(solved(c, options));
    for (const double factor : {1e6, 1e-6}) {
      const Case scaled = turning(times(data, factor), factor);
      auto others = scaled.mesh.in_user_order(solved(scaled, options));
      for (auto& p : others) p /= factor;
      EXPECT_LE(largest_difference(others, increments), 1e-6);
    }
    const Point shift(1000.0, -1000.0);
    const Case shifted = turning(mapped(data, [&](const Point& p) { return p + shift; }), 1.0, shift);
    EXPECT_LE(largest_difference(shifted.mesh.in_user_order(solved(shifted, options)), increments), 1e-6);
  }
}

TEST(Interior, IsTheSameForAnyNumberOfThreads) {
  for (const Follow follow : follows) {
    Case c = turning(make_annulus(20'000));
    for (const Vertex v : border(c.mesh))
      if (glm::length(c.mesh.position(v)) > 0.75 && c.mesh.position(v).x > 0.0) {
        c.roles[v] = Role::Slide;
        c.tangents[v] = glm::normalize(Point(-c.mesh.position(v).y, c.mesh.position(v).x));
      }
    std::vector<Point> first;
    for (const int threads : {1, 2, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const auto increments = solved(c, {.follow = follow});
      if (first.empty()) first = increments;
      EXPECT_TRUE(same_bits(increments, first)) << threads << " threads";
    }
  }
}

TEST(Interior, RemembersNothing) {
  const Case c = turning(make_annulus(2000));
  Interior interior(c.mesh, {});
  auto first = c.increments, again = c.increments;
  ASSERT_TRUE(interior.solve(c.mesh, c.problem(), first).converged);
  ASSERT_TRUE(interior.solve(c.mesh, c.problem(), again).converged);
  EXPECT_TRUE(same_bits(first, again));
}

TEST(Interior, GoesFasterFromANearStart) {
  const Case c = turning(make_annulus(5000));
  for (const Follow follow : follows) {
    Interior interior(c.mesh, {.follow = follow});
    auto cold = c.increments;
    const auto from_zero = interior.solve(c.mesh, c.problem(), cold);
    auto warm = cold;
    for (const Vertex v : c.mesh.vertices())
      warm[v] = c.roles[v] == Role::Known ? c.increments[v] : 1.02 * cold[v];
    const auto from_near = interior.solve(c.mesh, c.problem(), warm);
    EXPECT_LT(from_near.iterations, 0.85 * from_zero.iterations);
    EXPECT_LE(largest_difference(cold, warm), 1e-3 * largest(c.increments));
    const auto again = interior.solve(c.mesh, c.problem(), warm);
    EXPECT_TRUE(again.converged);
  }
}

// --- What goes wrong ---

TEST(Interior, TellsThatItHasNotConverged) {
  const Case c = turning(make_annulus(2000));
  for (const Follow follow : follows) {
    auto increments = c.increments;
    const auto solution =
        Interior(c.mesh, {.follow = follow, .max_iterations = 1}).solve(c.mesh, c.problem(), increments);
    EXPECT_FALSE(solution.converged);
    EXPECT_EQ(solution.iterations, 1);
    EXPECT_GT(solution.residual, 1e-5);
    for (const Vertex v : c.mesh.vertices())
      EXPECT_TRUE(c.roles[v] != Role::Known || increments[v] == c.increments[v]);
  }
}

// Halfway, one face of a grid is flat, another a point, and others are inverted.
TEST(Interior, BearsFlatAndInvertedFacesHalfway) {
  for (const Follow follow : follows) {
    Case c = with_border(grid(12), [](const Point& p) { return 0.01 * Point(p.y, 1.0); });
    c.others.assign(c.mesh.n_vertices(), Point(0.0, 0.0));
    const auto send = [&](int i, int j, const Point& target) {
      const Vertex v = grid_vertex(c.mesh, 12, i, j);
      c.others[v] = 2.0 * (target - c.mesh.position(v));
    };
    const auto place = [&](int i, int j) { return c.mesh.position(grid_vertex(c.mesh, 12, i, j)); };
    send(3, 3, 0.5 * (place(4, 3) + place(4, 4)));
    send(7, 7, place(8, 8));
    send(8, 7, place(8, 8));
    send(5, 9, place(7, 9));
    const auto increments = solved(c, {.follow = follow});
    EXPECT_LE(largest(increments), 0.02);
  }
}

TEST(Interior, BearsFacesWithoutExtent) {
  for (const Follow follow : follows) {
    Case c = with_border(grid(12), [](const Point& p) { return 0.01 * Point(p.y, 1.0); });
    c.others.assign(c.mesh.n_vertices(), Point(0.0, 0.0));
    const Point middle = c.mesh.position(grid_vertex(c.mesh, 12, 6, 6));
    const auto way = solved(c, {.follow = follow, .tolerance = 1e-13});
    for (int i = 4; i <= 8; ++i)
      for (int j = 4; j <= 8; ++j) {  // all to one point, but for rounding of the increments
        const Vertex v = grid_vertex(c.mesh, 12, i, j);
        c.others[v] = 2.0 * (middle - c.mesh.position(v)) - way[v];
      }
    EXPECT_LE(largest(solved(c, {.follow = follow})), 0.02);
  }
}

TEST(Interior, BearsNeedles) {
  MeshData data = mapped(grid(10), [](const Point& p) { return Point(p.x, 1e-9 * p.y); });
  for (const Follow follow : follows) {
    const Case c =
        with_border(data, [](const Point& p) { return p.x > 0.5 ? Point(0.0, 1e-12) : Point(0.0, 0.0); });
    EXPECT_LE(largest(solved(c, {.follow = follow})), 2e-12);
  }
}

TEST(Interior, RefusesOptionsWithoutSense) {
  const Mesh mesh = build_mesh(grid(2));
  EXPECT_THROW(Interior(mesh, {.stiffness = {{3, 0.0}}}), InputError);
  EXPECT_THROW(Interior(mesh, {.stiffness = {{3, std::nan("")}}}), InputError);
  EXPECT_THROW(Interior(mesh, {.tolerance = 0.0}), InputError);
  EXPECT_THROW(Interior(mesh, {.max_iterations = 0}), InputError);
}

}  // namespace
}  // namespace kinemesh
