#include "tests/motion/interior/dense_interior.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace kinemesh::test {
namespace {

using Matrix = std::vector<std::vector<double>>;

// Gradients of the three hat functions.
std::array<Point, 3> gradients(const std::array<Point, 3>& x, double twice_area) {
  std::array<Point, 3> result;
  for (int i = 0; i < 3; ++i) {
    const Point side = x[(i + 2) % 3] - x[(i + 1) % 3];
    result[i] = Point(-side.y, side.x) / twice_area;
  }
  return result;
}

// Energy density of two displacements along coordinates c and d with gradients g and h.
double density(Follow follow, const Point& g, int c, const Point& h, int d) {
  if (follow == Follow::Harmonic) return c == d ? g.x * h.x + g.y * h.y : 0.0;
  constexpr double poisson = 0.3, mu = 1.0, lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
  double strain[2][2][2] = {};  // of which displacement, then two indices
  for (int k = 0; k < 2; ++k) {
    strain[0][c][k] += 0.5 * g[k];
    strain[0][k][c] += 0.5 * g[k];
    strain[1][d][k] += 0.5 * h[k];
    strain[1][k][d] += 0.5 * h[k];
  }
  double product = 0.0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) product += strain[0][i][j] * strain[1][i][j];
  return 2.0 * mu * product +
         lambda * (strain[0][0][0] + strain[0][1][1]) * (strain[1][0][0] + strain[1][1][1]);
}

Matrix assemble(const Mesh& mesh, const std::vector<Point>& positions, const InteriorOptions& options) {
  const int n = 2 * mesh.n_vertices();
  Matrix matrix(n, std::vector<double>(n, 0.0));
  for (const Face f : mesh.faces()) {
    if (mesh.is_padding(f)) continue;
    const auto& t = mesh.triangles()[f];
    const std::array<Point, 3> x{positions[t[0]], positions[t[1]], positions[t[2]]};
    const Point a = x[1] - x[0], b = x[2] - x[0];
    const double twice_area = a.x * b.y - a.y * b.x;
    const auto gradient = gradients(x, twice_area);
    const auto found = options.stiffness.find(mesh.label(f));
    const double label = found == options.stiffness.end() ? 1.0 : found->second;
    const double area = 0.5 * std::abs(twice_area), stiffness = label / area;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        matrix[2 * t[i / 2] + i % 2][2 * t[j / 2] + j % 2] +=
            area * stiffness * density(options.follow, gradient[i / 2], i % 2, gradient[j / 2], j % 2);
  }
  return matrix;
}

// Vertices whose increments are unknown: in a part with something that pulls.
std::set<Vertex> unknowns(const Mesh& mesh, std::span<const Role> roles, std::span<const Point> increments) {
  std::set<Vertex> found;
  for (std::size_t before = 1; before != found.size();) {
    before = found.size();
    for (const Face f : mesh.faces()) {
      if (mesh.is_padding(f)) continue;
      const auto& t = mesh.triangles()[f];
      const bool pulled = std::any_of(t.begin(), t.end(), [&](Vertex v) {
        return found.count(v) > 0 || (roles[v] == Role::Known && increments[v] != Point(0.0, 0.0));
      });
      for (const Vertex v : t)
        if (pulled && roles[v] != Role::Known) found.insert(v);
    }
    if (found.empty()) break;
  }
  return found;
}

// A coordinate along which an unknown vertex moves.
struct Freedom {
  Vertex vertex;
  Point along;
};

std::vector<Freedom> freedoms(const std::set<Vertex>& vertices, const InteriorProblem& problem) {
  std::vector<Freedom> all;
  for (const Vertex v : vertices) {
    if (problem.roles[v] == Role::Slide) {
      all.push_back({v, problem.tangents.at(v)});
    } else {
      all.push_back({v, {1.0, 0.0}});
      all.push_back({v, {0.0, 1.0}});
    }
  }
  return all;
}

// Solves in place with the largest pivots; false if one is small.
bool eliminate(Matrix& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  bool is_regular = true;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    const double size = *std::max_element(a[k].begin(), a[k].end(),
                                          [](double x, double y) { return std::abs(x) < std::abs(y); });
    if (std::abs(a[k][k]) < 1e-9 * std::abs(size) || size == 0.0) is_regular = false;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      if (factor == 0.0) continue;
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return is_regular;
}

void solve_on(const Mesh& mesh, const std::vector<Point>& positions, const InteriorOptions& options,
              const std::vector<Freedom>& unknown, DenseSolution& solution) {
  const Matrix full = assemble(mesh, positions, options);
  const auto entry = [&](const Freedom& f, int column) {
    return f.along.x * full[2 * f.vertex][column] + f.along.y * full[2 * f.vertex + 1][column];
  };
  for (const auto& f : unknown) solution.increments[f.vertex] = Point(0.0, 0.0);
  Matrix a(unknown.size(), std::vector<double>(unknown.size()));
  std::vector<double> b(unknown.size(), 0.0);
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    for (std::size_t j = 0; j < unknown.size(); ++j)
      a[i][j] = unknown[j].along.x * entry(unknown[i], 2 * unknown[j].vertex) +
                unknown[j].along.y * entry(unknown[i], 2 * unknown[j].vertex + 1);
    for (const Vertex v : mesh.vertices())
      b[i] -= solution.increments[v].x * entry(unknown[i], 2 * v) +
              solution.increments[v].y * entry(unknown[i], 2 * v + 1);
  }
  solution.is_unique = eliminate(a, b) && solution.is_unique;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    solution.increments[unknown[i].vertex] += b[i] * unknown[i].along;
}

}  // namespace

DenseSolution solve_densely(const Mesh& mesh, const InteriorOptions& options, const InteriorProblem& problem,
                            std::vector<Point> increments) {
  const auto moving = unknowns(mesh, problem.roles, increments);
  for (std::size_t v = 0; v < increments.size(); ++v)
    if (problem.roles[v] != Role::Known) increments[v] = Point(0.0, 0.0);
  DenseSolution solution{std::move(increments)};
  const auto unknown = freedoms(moving, problem);
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  solve_on(mesh, positions, options, unknown, solution);
  for (std::size_t v = 0; v < positions.size(); ++v)
    positions[v] +=
        0.5 * (solution.increments[v] + (problem.others.empty() ? Point(0.0, 0.0) : problem.others[v]));
  solve_on(mesh, positions, options, unknown, solution);
  return solution;
}

}  // namespace kinemesh::test
