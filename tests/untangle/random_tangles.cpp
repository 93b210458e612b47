#include "tests/untangle/random_tangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kinemesh/predicates.h"

namespace kinemesh::test {
namespace {

using Map = std::function<Point(const Point&)>;

Tangle built(const char* about, Mesh mesh) {
  snap_frame(mesh);
  std::vector<Point> before(mesh.positions().begin(), mesh.positions().end());
  return {about, std::move(mesh), std::move(before)};
}

Map turn(const Point& centre, double angle, const Point& shift = {0, 0}) {
  return [=](const Point& p) {
    const Point d = p - centre;
    const double c = std::cos(angle), s = std::sin(angle);
    return centre + shift + Point(c * d.x - s * d.y, s * d.x + c * d.y);
  };
}

bool is_in(const Point& p, const Point& low, const Point& high) {
  return low.x < p.x && p.x < high.x && low.y < p.y && p.y < high.y;
}

// The open box free vertices stay in: inside the convex border.
std::pair<Point, Point> arena(const Mesh& mesh) {
  Point low = mesh.position(mesh.hull()[0]), high = low;
  for (const Vertex v : mesh.hull()) {
    low = {std::min(low.x, mesh.position(v).x), std::min(low.y, mesh.position(v).y)};
    high = {std::max(high.x, mesh.position(v).x), std::max(high.y, mesh.position(v).y)};
  }
  return {low, high};
}

// From imperceptible to hopeless, in units of the domain.
void jitter(
    Mesh& mesh, Random& random, const Map& carry = [](const Point& p) { return p; }) {
  const double amplitude = std::pow(10.0, random.between(-3.0, 0.3));
  const auto [low, high] = arena(mesh);
  move_free(mesh, [&, low = low, high = high](const Point& p) {
    for (;;) {
      const Point shift{random.between(-amplitude, amplitude), random.between(-amplitude, amplitude)};
      const Point q = snapped(carry(p) + shift);
      if (is_in(q, low, high)) return q;
    }
  });
}

std::vector<Point> random_points(Random& random, int n, double low, double high) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i)
    points.push_back(snapped({random.between(low, high), random.between(low, high)}));
  return points;
}

double any_angle(Random& random) {
  return random.between(-3.14, 3.14);
}

Tangle square(Random& random) {
  Tangle t = built("square", build_mesh(random_square(8 + random.below(50), random)));
  jitter(t.mesh, random);
  return t;
}

Tangle framed(Random& random) {
  Tangle t = built("framed", build_mesh(random_square(8 + random.below(40), random), {.frame = 0.6}));
  const auto rigid =
      turn({0.5, 0.5}, any_angle(random), {random.between(-0.5, 0.5), random.between(-0.5, 0.5)});
  move_constrained(t.mesh, rigid);
  jitter(t.mesh, random, random.one_in(2) ? rigid : turn({0, 0}, 0));
  return t;
}

Tangle u_with_padding(Random& random) {
  Tangle t = built("u", build_mesh(u_shape(5 + random.below(50), random)));
  jitter(t.mesh, random);
  return t;
}

Tangle turning_hole(Random& random) {
  const Point centre{0.5, 0.5};
  const std::vector<Loop> loops{rectangle({0, 0}, {1, 1}),
                                reversed(circle(centre, 0.2, 5 + random.below(12)))};
  Tangle t =
      built("turning hole", build_mesh(domain_of(loops, random_points(random, 10 + random.below(50), 0, 1))));
  const auto spin = turn(centre, any_angle(random));
  move_constrained(t.mesh, [&](const Point& p) { return glm::distance(p, centre) < 0.3 ? spin(p) : p; });
  jitter(t.mesh, random);
  return t;
}

Tangle nested_islands(Random& random) {
  const Point centre{0.5, 0.5};
  const std::vector<Loop> loops{rectangle({0, 0}, {1, 1}), reversed(circle(centre, 0.4, 9)),
                                circle(centre, 0.25, 8), reversed(circle(centre, 0.12, 6))};
  Tangle t =
      built("nested islands", build_mesh(domain_of(loops, random_points(random, 20 + random.below(50), 0, 1)),
                                         {.frame = random.one_in(2) ? 0.5 : 0.0}));
  const auto shift =
      turn(centre, any_angle(random), {random.between(-0.08, 0.08), random.between(-0.08, 0.08)});
  move_constrained(t.mesh, [&](const Point& p) { return glm::distance(p, centre) < 0.3 ? shift(p) : p; });
  jitter(t.mesh, random);
  return t;
}

Tangle bow_tie(Random& random) {
  const std::vector<Loop> loops{rectangle({0, 0}, {1, 1}), rectangle({1, 1}, {2, 2})};
  Tangle t = built(
      "bow-tie",
      build_mesh(domain_of(loops, random_points(random, 10 + random.below(40), 0.01, 1.99)), {.frame = 0.5}));
  const auto swing = turn({1, 1}, random.between(-1.5, 1.5));
  const auto carry = [&](const Point& p) { return p.x > 1 ? swing(p) : p; };
  move_constrained(t.mesh, carry);
  jitter(t.mesh, random, carry);
  return t;
}

bool is_left_of_all(const Loop& convex, const Point& p) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (orientation(convex[i], convex[(i + 1) % convex.size()], p) != Orientation::CounterClockwise)
      return false;
  }
  return true;
}

Tangle interface(Random& random) {
  const Point centre{0.5, 0.5};
  const auto ring = circle(centre, 0.3, 5 + random.below(12));
  auto data =
      domain_of({rectangle({0, 0}, {1, 1})}, random_points(random, 10 + random.below(50), 0, 1), {ring});
  for (const auto& [a, b, c] : data.triangles) {
    const Point middle = (data.points[a] + data.points[b] + data.points[c]) / 3.0;
    data.labels.push_back(is_left_of_all(ring, middle) ? 7 : 3);
  }
  Tangle t = built("interface", build_mesh(data, {.frame = random.one_in(2) ? 0.3 : 0.0}));
  const auto spin =
      turn(centre, any_angle(random), {random.between(-0.15, 0.15), random.between(-0.15, 0.15)});
  move_constrained(t.mesh, [&](const Point& p) { return glm::distance(p, centre) < 0.35 ? spin(p) : p; });
  jitter(t.mesh, random);
  return t;
}

// Small islands in the cells of [0,1]^2 that move within their cells, or to others.
Tangle archipelago(Random& random) {
  const int n = 3 + random.below(2);
  const double cell = 1.0 / n, size = 0.3 * cell;
  const auto corner_in = [&](int c) {
    return cell * Point(c % n + random.between(0.05, 0.6), c / n + random.between(0.05, 0.6));
  };
  std::vector<Loop> islands;
  std::vector<Point> inside;
  for (int c = 0; c < n * n; ++c) {
    const Point low = snapped(corner_in(c));
    islands.push_back(rectangle(low, snapped(low + size)));
    inside.push_back(snapped(low + size * Point(random.between(0.1, 0.9), random.between(0.1, 0.9))));
  }
  Tangle t = built("archipelago", build_mesh(domain_of(islands, inside), {.frame = 0.4}));
  const int change_cells = random.below(3) == 0 ? 1 + random.below(n * n) : 0;
  const double step = random.between(0, 1);
  std::vector<Point> shift;
  for (int c = 0; c < n * n; ++c) {
    const Point to = corner_in((c + change_cells) % (n * n));
    shift.push_back(snapped((change_cells > 0 ? 1.0 : step) * (to - islands[c][0])));
  }
  const auto carry = [&](const Point& p) {
    return p + shift[static_cast<int>(p.y / cell) * n + static_cast<int>(p.x / cell)];
  };
  move_free(t.mesh, carry);
  move_constrained(t.mesh, carry);
  return t;
}

// --- lattices ---

bool is_free(const Mesh& mesh, Vertex v) {
  return !mesh.is_isolated(v) && !mesh.is_constrained(v) && mesh.user_vertex(v) != none;
}

std::vector<Vertex> free_vertices(const Mesh& mesh) {
  std::vector<Vertex> free;
  for (const Vertex v : mesh.vertices()) {
    if (is_free(mesh, v)) free.push_back(v);
  }
  return free;
}

void permute_some(Mesh& mesh, Random& random) {
  auto chosen = free_vertices(mesh);
  std::erase_if(chosen, [&](int) { return random.one_in(3); });
  for (std::size_t i = chosen.size(); i > 1; --i) {
    std::swap(mesh.positions()[chosen[i - 1]], mesh.positions()[chosen[random.below(static_cast<int>(i))]]);
  }
}

void swap_pairs(Mesh& mesh, Random& random) {
  const auto free = free_vertices(mesh);
  for (int i = 0; free.size() > 1 && i < 1 + random.below(4); ++i) {
    std::swap(mesh.positions()[free[random.below(static_cast<int>(free.size()))]],
              mesh.positions()[free[random.below(static_cast<int>(free.size()))]]);
  }
}

// Takes whole rows to the height of others, half a cell to the side.
void collapse_rows(Mesh& mesh, Random& random) {
  const auto [low, high] = arena(mesh);
  const int from = 2 * (1 + random.below(3)), to = 1 + random.below(static_cast<int>(high.y) - 1);
  const double aside = random.one_in(2) ? 1 : -1;
  for (const Vertex v : free_vertices(mesh)) {
    Point& p = mesh.positions()[v];
    if (p.y == from) p = {p.x + aside, static_cast<double>(to)};
  }
}

Tangle lattice(Random& random) {
  auto data = random_grid(2 + random.below(6), 2 + random.below(6), random);
  if (random.one_in(4)) {  // an interface up the middle
    const double middle = 2.0 * std::floor(data.points.back().x / 4.0);
    for (const auto& [a, b, c] : data.triangles) {
      const double x = data.points[a].x + data.points[b].x + data.points[c].x;
      data.labels.push_back(x < 3 * middle ? 1 : 2);
    }
  }
  const bool has_frame = random.one_in(4);
  Tangle t = built("lattice", build_mesh(data, {.frame = has_frame ? 0.25 : 0.0}));
  return t;
}

Tangle random_lattice(Random& random) {
  const int size = 4 + random.below(8);
  std::vector<Point> inside;
  for (int i = 0; i < 8 + random.below(40); ++i) {
    inside.push_back({1.0 + random.below(size - 1), 1.0 + random.below(size - 1)});
  }
  const double width = size;
  return built("random lattice", build_mesh(domain_of({rectangle({0, 0}, {width, width})}, inside)));
}

}  // namespace

void move_free(Mesh& mesh, const Map& map) {
  for (const Vertex v : mesh.vertices()) {
    if (is_free(mesh, v)) mesh.positions()[v] = snapped(map(mesh.position(v)));
  }
}

void move_constrained(Mesh& mesh, const Map& map) {
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_constrained(v)) mesh.positions()[v] = snapped(map(mesh.position(v)));
  }
}

void snap_frame(Mesh& mesh) {
  for (const Vertex v : mesh.frame()) mesh.positions()[v] = snapped(mesh.position(v));
}

Tangle random_tangle(std::uint64_t seed) {
  Random random(seed);
  switch (random.below(8)) {
    case 0:
      return square(random);
    case 1:
      return framed(random);
    case 2:
      return u_with_padding(random);
    case 3:
      return turning_hole(random);
    case 4:
      return nested_islands(random);
    case 5:
      return bow_tie(random);
    case 6:
      return archipelago(random);
    default:
      return interface(random);
  }
}

void jump_on_lattice(Mesh& mesh, Random& random) {
  const auto [low, high] = arena(mesh);
  const int rarity = 1 + random.below(6), reach = 1 + random.below(3);
  move_free(mesh, [&, low = low, high = high](const Point& p) {
    const Point jump(random.below(2 * reach + 1) - reach, random.below(2 * reach + 1) - reach);
    return random.one_in(rarity) && is_in(p + jump, low, high) ? p + jump : p;
  });
}

Tangle lattice_tangle(std::uint64_t seed) {
  Random random(seed);
  Tangle t = random.one_in(3) ? random_lattice(random) : lattice(random);
  const int way = random.below(4);
  if (way == 0) permute_some(t.mesh, random);
  if (way == 1) swap_pairs(t.mesh, random);
  if (way == 2) collapse_rows(t.mesh, random);
  if (way == 3) jump_on_lattice(t.mesh, random);
  if (!t.mesh.frame().empty()) {  // the border moves too
    const Point shift(random.below(3) - 1, random.below(3) - 1);
    move_constrained(t.mesh, [&](const Point& p) { return p + shift; });
  }
  return t;
}

Tangle polyomino_tangle(std::uint64_t seed) {
  Random random(seed);
  auto data = random_grid(2 + random.below(5), 2 + random.below(5), random);
  const int keep = 2 + random.below(8), n_labels = 1 + random.below(3);
  std::vector<Triangle> kept;
  for (std::size_t cell = 0; cell < data.triangles.size(); cell += 2) {
    if (random.one_in(keep) && !(kept.empty() && cell + 2 == data.triangles.size())) continue;
    const int label = random.below(n_labels);
    for (const std::size_t face : {cell, cell + 1}) {
      kept.push_back(data.triangles[face]);
      data.labels.push_back(label);
    }
  }
  data.triangles = kept;
  Tangle t = built("polyomino", build_mesh(data, {.frame = 1.0}));
  jump_anywhere(t.mesh, random);
  return t;
}

void jump_anywhere(Mesh& mesh, Random& random) {
  const int rarity = 2 + random.below(12);
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v) || mesh.user_vertex(v) == none || !random.one_in(rarity)) continue;
    mesh.positions()[v] += Point(random.below(3) - 1, random.below(3) - 1);
  }
}

}  // namespace kinemesh::test
