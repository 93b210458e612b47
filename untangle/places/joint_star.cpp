#include "untangle/places/joint_star.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "core/mesh/around.h"
#include "kinemesh/predicates.h"
#include "untangle/places/star.h"

namespace kinemesh {
namespace {

constexpr int max_steps = 100;
constexpr int max_halvings = 15;
constexpr int memory = 8;             // steps
constexpr int doublings = 6;          // of the power: 64
constexpr double first_shift = 0.05;  // of an edge's length: the longest shift of the first step
constexpr double least_share = 1e-4;  // of the gain a step promises that it has to bring
constexpr double least_gain = 1e-6;   // of the energy: a smaller one ends it
constexpr double infinite = std::numeric_limits<double>::infinity();

using kinemesh::dot;

double dot(std::span<const Point> a, std::span<const Point> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

void add(std::span<Point> to, double factor, std::span<const Point> what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * what[i];
}

std::vector<Point> difference(std::span<const Point> a, std::span<const Point> b) {
  std::vector<Point> result(a.begin(), a.end());
  add(result, -1.0, b);
  return result;
}

double power(double x) {
  for (int i = 0; i < doublings; ++i) x *= x;
  return x;
}

double root(double x) {
  for (int i = 0; i < doublings; ++i) x = std::sqrt(x);
  return x;
}

// The inverse of a function's matrix of second derivatives, by what its last steps have taught.
class InverseHessian {
 public:
  // Of a function whose second derivatives are, but for a factor, the inverses of the scale, squares of
  // lengths: until something has been learnt, a small share of them is as far as the gradient leads.
  InverseHessian(std::span<const double> scale, std::span<const Point> gradient) : scale_(scale) {
    double longest = 0.0;
    for (std::size_t i = 0; i < scale.size(); ++i)
      longest = std::max(longest, scale[i] * dot(gradient[i], gradient[i]));
    factor_ = longest > 0.0 ? first_shift / std::sqrt(longest) : 0.0;
  }

  void learn(std::vector<Point> step, std::vector<Point> change_of_gradient) {
    const double curvature = dot(step, change_of_gradient);
    if (!(curvature > 0.0)) return;
    factor_ = curvature / scaled(change_of_gradient);
    if (pairs_.size() == memory) pairs_.pop_front();
    pairs_.push_back({std::move(step), std::move(change_of_gradient), curvature});
  }

  void apply(std::span<Point> v) const {
    std::array<double, memory> shares;
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      shares[i] = dot(pairs_[i].step, v) / pairs_[i].curvature;
      add(v, -shares[i], pairs_[i].change);
    }
    for (std::size_t i = 0; i < v.size(); ++i) v[i] *= factor_ * scale_[i];
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      add(v, shares[i] - dot(pairs_[i].change, v) / pairs_[i].curvature, pairs_[i].step);
  }

 private:
  struct Pair {
    std::vector<Point> step, change;
    double curvature;
  };

  double scaled(std::span<const Point> v) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += scale_[i] * dot(v[i], v[i]);
    return sum;
  }

  std::span<const double> scale_;
  std::deque<Pair> pairs_;
  double factor_;
};

}  // namespace

JointStar::JointStar(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge)
    : scale_(vertices.size(), 0.0), tangent_(infinite) {
  for (const auto& [v, along] : vertices) {
    start_.push_back(mesh.position(v));
    along_.push_back(along);
  }
  list_faces(mesh, vertices, flipped_edge);
  for (const Face face : faces_)
    if (!mesh.is_padding(face)) tangent_ = std::min(tangent_, tangent_from_any_corner(mesh.corners(face)));
  list_triangles(mesh, vertices, flipped_edge);
  measure_scale();
}

void JointStar::list_faces(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge) {
  for (const auto& free : vertices)
    for_each_side_from(mesh, free.vertex, [&](Side side) { faces_.push_back(Mesh::face_of(side)); });
  if (flipped_edge != none)
    for (const Side side : {flipped_edge, mesh.opposite(flipped_edge)}) faces_.push_back(Mesh::face_of(side));
  std::ranges::sort(faces_);
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
}

void JointStar::list_triangles(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge) {
  const auto user = [&](Vertex v) { return mesh.user_vertex(v); };
  const auto corner = [&](Vertex v) {
    const auto of_free = [&](const FreeVertex& free) { return user(free.vertex); };
    const auto found = std::ranges::lower_bound(vertices, user(v), {}, of_free);
    const bool is_free = found != vertices.end() && found->vertex == v;
    return Corner{is_free ? static_cast<int>(found - vertices.begin()) : none, mesh.position(v)};
  };
  std::vector<MeshTriangle> of_domain;  // the lowest user's number first
  const auto list = [&](MeshTriangle v, bool is_padding) {
    if (is_padding) return padding_.push_back({corner(v[0]), corner(v[1]), corner(v[2])});
    std::rotate(v.begin(), std::ranges::min_element(v, {}, user), v.end());
    of_domain.push_back(v);
  };
  for (const Face face : faces_) {
    const auto is_flipped = [&](Side side) { return mesh.lower(side) == flipped_edge; };
    const auto sides = Mesh::sides(face);
    if (const auto h = std::ranges::find_if(sides, is_flipped); h != sides.end())
      list({mesh.from(*h), mesh.apex(mesh.opposite(*h)), mesh.apex(*h)}, mesh.is_padding(face));
    else
      list(mesh.triangles()[face], mesh.is_padding(face));
  }
  std::ranges::sort(of_domain, {}, [&](const auto& v) {
    return std::array{user(v[0]), user(v[1]), user(v[2])};
  });
  for (const auto& v : of_domain) triangles_.push_back({corner(v[0]), corner(v[1]), corner(v[2])});
}

void JointStar::measure_scale() {
  std::vector<int> n(start_.size(), 0);
  for (const Triangle& triangle : triangles_)
    for (int k = 0; k < 3; ++k)
      if (const int i = triangle[k].free; i != none) {
        const Point edge = triangle[(k + 1) % 3].place - triangle[k].place;
        scale_[i] += dot(edge, edge);
        ++n[i];
      }
  for (std::size_t i = 0; i < start_.size(); ++i)
    if (n[i] != 0) scale_[i] /= n[i];
}

std::array<Point, 3> JointStar::corners_at(const Triangle& triangle, std::span<const Point> places) const {
  std::array<Point, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = triangle[k].free == none ? triangle[k].place : places[triangle[k].free];
  return p;
}

double JointStar::tangent_at(std::span<const Point> places) const {
  double tangent = infinite;
  for (const Triangle& triangle : triangles_)
    tangent = std::min(tangent, tangent_from_any_corner(corners_at(triangle, places)));
  return tangent;
}

bool JointStar::is_upright_at(std::span<const Point> places) const {
  const auto is_upright = [&](const Triangle& triangle) {
    const auto [a, b, c] = corners_at(triangle, places);
    return orientation(a, b, c) == Orientation::CounterClockwise;
  };
  return std::ranges::all_of(triangles_, is_upright) && std::ranges::all_of(padding_, is_upright);
}

// The 64th root of the sum: infinite unless all are upright. Its gradient goes along the lines on which
// vertices may move.
double JointStar::energy_at(std::span<const Point> places, std::span<Point> gradient) const {
  std::vector<std::array<double, 3>> cotangents;
  cotangents.reserve(triangles_.size());
  double largest = 0.0;
  for (const Triangle& triangle : triangles_) {
    const std::array<Point, 3> p = corners_at(triangle, places);
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    if (!(area > 0.0)) return infinite;
    auto& of_triangle = cotangents.emplace_back();
    for (int k = 0; k < 3; ++k) {
      of_triangle[k] = std::max(dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]) / area, 0.0);
      largest = std::max(largest, of_triangle[k]);
    }
  }
  double sum = 0.0;
  for (const auto& of_triangle : cotangents)
    for (const double cotangent : of_triangle) sum += power(cotangent / largest);
  const double energy = largest * root(sum);

  std::ranges::fill(gradient, Point{0.0, 0.0});
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& triangle = triangles_[t];
    const std::array<Point, 3> p = corners_at(triangle, places);
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    for (int k = 0; k < 3; ++k) {
      const double cotangent = cotangents[t][k];
      if (cotangent == 0.0) continue;
      const double weight = power(cotangent / energy) * energy / cotangent / area;
      const Corner &at = triangle[k], &left = triangle[(k + 1) % 3], &right = triangle[(k + 2) % 3];
      const Point u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
      const Point by_u = weight * (v - cotangent * Point(v.y, -v.x));
      const Point by_v = weight * (u - cotangent * Point(-u.y, u.x));
      if (left.free != none) gradient[left.free] += by_u;
      if (right.free != none) gradient[right.free] += by_v;
      if (at.free != none) gradient[at.free] -= by_u + by_v;
    }
  }
  for (std::size_t i = 0; i < along_.size(); ++i)
    if (along_[i] != Point{0.0, 0.0}) gradient[i] = dot(gradient[i], along_[i]) * along_[i];
  return energy;
}

// Back on the lines on which vertices may move, whatever rounding has done.
void JointStar::put_on_lines(std::span<Point> places) const {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (along_[i] != Point{0.0, 0.0})
      places[i] = start_[i] + dot(places[i] - start_[i], along_[i]) * along_[i];
}

std::vector<Point> JointStar::best_places() const {
  State now{start_, std::vector<Point>(start_.size())}, there = now;
  now.energy = energy_at(now.places, now.gradient);
  std::vector<Point> best = start_, shift;
  double best_tangent = tangent_at(best);
  InverseHessian inverse(scale_, now.gradient);
  for (int step = 0; step < max_steps; ++step) {
    shift = now.gradient;
    inverse.apply(shift);
    if (!descend(now, shift, there)) break;
    inverse.learn(difference(there.places, now.places), difference(there.gradient, now.gradient));
    std::swap(now, there);
    if (const double tangent = tangent_at(now.places); tangent > best_tangent) {
      best_tangent = tangent;
      best = now.places;
    }
    if (there.energy - now.energy < least_gain * now.energy) break;
  }
  put_on_lines(best);
  return best;
}

// Against the shift, as far as that brings what its slope promises; false if it does not.
bool JointStar::descend(const State& from, std::span<const Point> shift, State& to) const {
  const double slope = dot(from.gradient, shift);
  if (!(slope > 0.0)) return false;
  double length = 1.0;
  for (int halving = 0; halving <= max_halvings; ++halving, length /= 2) {
    to.places = from.places;
    add(to.places, -length, shift);
    to.energy = energy_at(to.places, to.gradient);
    if (to.energy <= from.energy - least_share * length * slope) return true;
  }
  return false;
}

}  // namespace kinemesh
