#include "sim/compare/bench_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/stopwatch.h"
#include "kinemesh/predicates.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/walk/box_tree.h"
#include "untangle/walk/detect.h"

namespace kinemesh {
namespace {

constexpr int repeats = 3;

// Where the lines a b and c d cross. Pre: the segments cross.
Point crossing(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto side = [&](const Point& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  const double at_c = side(c), at_d = side(d);
  return c + (at_c / (at_c - at_d)) * (d - c);
}

// How the images of a region's faces lie over each other.
class Overlay {
 public:
  Overlay(const Mesh& mesh, const std::vector<Face>& faces) : mesh_(mesh), faces_(faces) {
    std::vector<Box> boxes;
    for (const Face face : faces) boxes.push_back(box_of(mesh.corners(face)));
    faces_tree_.build(boxes);
    for (const Face face : faces)
      for (const Side side : mesh.sides(face)) edges_.push_back(mesh.lower(side));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    boxes.clear();
    for (const Side edge : edges_) boxes.push_back(box_of(end(edge, 0), end(edge, 1)));
    edges_tree_.build(boxes);
  }

  // A cell of the deepest is a whole face, or has a corner where two edges cross; then it is one of the four
  // there.
  void measure(BoundSample& sample) const {
    for (const Face face : faces_) sample.depth = std::max(sample.depth, depth_within(face));
    for (std::size_t i = 0; i < edges_.size(); ++i) add_crossings(i, sample);
    sample.complexity = sample.crossings + count_upright_vertices();
  }

 private:
  const Point& end(Side edge, int which) const {
    return mesh_.position(which == 0 ? mesh_.from(edge) : mesh_.to(edge));
  }
  bool holds(Face face) const { return std::binary_search(faces_.begin(), faces_.end(), face); }
  Orientation turn(Face face) const {
    const auto [a, b, c] = mesh_.corners(face);
    return orientation(a, b, c);
  }

  // Faces over a point, but for those named.
  int depth_at(const Point& p, const std::array<Face, 4>& besides) const {
    int depth = 0;
    faces_tree_.any(box_of(p, p), [&](int i) {
      const bool counts = std::find(besides.begin(), besides.end(), faces_[i]) == besides.end();
      depth += counts && strictly_inside(p, mesh_.corners(faces_[i]));
      return false;
    });
    return depth;
  }

  int depth_within(Face face) const {
    const auto [a, b, c] = mesh_.corners(face);
    return 1 + depth_at((a + b + c) / 3.0, {face, none, none, none});
  }

  std::array<Face, 2> beside(Side edge) const { return {Mesh::face_of(edge), mesh_.face_across(edge)}; }

  // The more of the region's faces that lie on one side of the edge's image.
  int depth_beside(Side edge) const {
    int left = 0, right = 0;
    for (const Face face : beside(edge)) {
      if (face == none || !holds(face)) continue;
      const bool is_left = (turn(face) == Orientation::CounterClockwise) == (face == Mesh::face_of(edge));
      ++(is_left ? left : right);
    }
    return std::max(left, right);
  }

  bool is_upright_edge(Side edge) const {
    return std::ranges::any_of(beside(edge), [&](Face face) {
      return face != none && holds(face) && turn(face) == Orientation::CounterClockwise;
    });
  }

  void add_crossings(std::size_t i, BoundSample& sample) const {
    const Side e = edges_[i];
    const Point &a = end(e, 0), &b = end(e, 1);
    edges_tree_.any(box_of(a, b), [&](int j) {
      const Side g = edges_[j];
      if (static_cast<std::size_t>(j) <= i || !segments_cross(a, b, end(g, 0), end(g, 1))) return false;
      sample.crossings += is_upright_edge(e) && is_upright_edge(g);
      const auto [e0, e1] = beside(e);
      const auto [g0, g1] = beside(g);
      const int others = depth_at(crossing(a, b, end(g, 0), end(g, 1)), {e0, e1, g0, g1});
      sample.depth = std::max(sample.depth, others + depth_beside(e) + depth_beside(g));
      return false;
    });
  }

  int count_upright_vertices() const {
    std::vector<Vertex> vertices;
    for (const Face face : faces_)
      if (turn(face) == Orientation::CounterClockwise)
        vertices.insert(vertices.end(), mesh_.triangles()[face].begin(), mesh_.triangles()[face].end());
    std::sort(vertices.begin(), vertices.end());
    return static_cast<int>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
  }

  const Mesh& mesh_;
  const std::vector<Face>& faces_;  // ascending
  std::vector<Side> edges_;         // theirs, ascending
  BoxTree faces_tree_, edges_tree_;
};

// The first face of each component.
std::vector<Face> seeds_of(const Mesh& mesh) {
  const auto inverted = detect(mesh).inverted;
  const auto components = inverted_components(mesh, inverted);
  std::vector<Face> seeds;
  for (std::size_t i = 0; i < inverted.size(); ++i)
    if (components.of[i] == static_cast<int>(seeds.size())) seeds.push_back(inverted[i]);
  return seeds;
}

// False where degenerate positions are in the way.
bool explore(const Mesh& mesh, Face seed, BoundSample& sample) {
  sample.seed = mesh.user_face(seed);
  sample.explore_us = std::numeric_limits<double>::infinity();
  std::vector<Face> faces;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch exploring;
    LocalExploration exploration(mesh);
    if (!exploration.run(seed)) return false;
    sample.explore_us = std::min(sample.explore_us, 1e3 * exploring.milliseconds());
    if (i > 0) continue;
    faces = exploration.faces();
    sample.inverted = exploration.inverted();
    sample.upright = static_cast<int>(faces.size()) - sample.inverted;
    sample.components = exploration.components();
    sample.rounds = exploration.rounds();
  }
  Overlay(mesh, faces).measure(sample);
  return true;
}

}  // namespace

double BoundSample::bound() const {
  const double sheets = std::max(depth, components);
  return inverted + (upright * sheets + static_cast<double>(complexity)) * std::log(faces());
}

std::vector<BoundSample> sample_bound(const Mesh& tangled, int most) {
  const auto seeds = seeds_of(tangled);
  const std::size_t n = std::min(seeds.size(), static_cast<std::size_t>(std::max(most, 0)));
  std::vector<BoundSample> samples;
  for (std::size_t i = 0; i < n; ++i) {
    BoundSample sample;
    if (explore(tangled, seeds[i * seeds.size() / n], sample)) samples.push_back(sample);
  }
  return samples;
}

}  // namespace kinemesh
