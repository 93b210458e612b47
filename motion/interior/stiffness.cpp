#include "motion/interior/stiffness.h"

#include <algorithm>
#include <cmath>

#include "kinemesh/measure.h"
#include "motion/interior/vertex_blocks.h"

namespace kinemesh {
namespace {

constexpr double least_area = 1e-4;  // over the sum of the squares of the sides

double scale_of(const std::array<Point, 3>& corners) {
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Point side = corners[(k + 1) % 3] - corners[k];
    squares += glm::dot(side, side);
  }
  const double area = std::max(std::abs(twice_area(corners)), least_area * squares);
  return area > 0.0 ? 1.0 / (area * area) : 0.0;
}

double stiffness_of(const std::map<int, double>& by_label, int label) {
  const auto found = by_label.find(label);
  return found == by_label.end() ? 1.0 : found->second;
}

// What an element says of corners i and j, the sides opposite them running counter-clockwise.
void set_entry(double& entry, double scale, const Point& side_i, const Point& side_j) {
  entry = scale * glm::dot(side_i, side_j);
}

void set_entry(Block& entry, double scale, const Point& side_i, const Point& side_j) {
  const Point i(-side_i.y, side_i.x), j(-side_j.y, side_j.x);
  entry = scale * (lame_lambda * glm::outerProduct(i, j) + glm::outerProduct(j, i) + Block(glm::dot(i, j)));
}

}  // namespace

void scale_faces(const Mesh& mesh, std::span<const Point> positions, const std::map<int, double>& by_label,
                 std::vector<double>& scales) {
  scales.resize(mesh.n_faces());
  parallel_parts(mesh.n_faces(), grain::moves, [&](int, int begin, int end) {
    for (Face f(begin); f < end; ++f) {
      const auto& [a, b, c] = mesh.triangles()[f];
      scales[f] = mesh.is_padding(f) ? 0.0
                                     : stiffness_of(by_label, mesh.label(f)) *
                                           scale_of({positions[a], positions[b], positions[c]});
    }
  });
}

template <class Weight>
void Stiffness<Weight>::fill(const Fans& fans, std::span<const Point> positions,
                             std::span<const double> scales) {
  weights_.resize(fans.n_slots());
  parallel_blocks(fans.n_vertices(), [&](int, int begin, int end) {
    std::fill(weights_.begin() + fans.begin(Vertex(begin)), weights_.begin() + fans.begin(Vertex(end)),
              Weight(0.0));
    for (Vertex v(begin); v < end; ++v)
      for (int slot = fans.begin(v); slot < fans.end(v); ++slot) {
        if (fans.face(slot) == none) continue;
        const int next = slot + 1 < fans.end(v) ? slot + 1 : fans.begin(v);
        const Point a = positions[fans.neighbour(slot)], b = positions[fans.neighbour(next)],
                    x = positions[v];
        const double scale = scales[fans.face(slot)];
        Weight entry;
        set_entry(entry, scale, b - a, x - b);
        weights_[slot] += entry;
        set_entry(entry, scale, b - a, a - x);
        weights_[next] += entry;
      }
  });
}

template <class Weight>
Weight Stiffness<Weight>::diagonal(const Fans& fans, Vertex vertex) const {
  Weight sum(0.0);
  for (int slot = fans.begin(vertex); slot < fans.end(vertex); ++slot) sum -= weights_[slot];
  return sum;
}

template class Stiffness<double>;
template class Stiffness<Block>;

}  // namespace kinemesh
