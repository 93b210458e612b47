// Stiffness matrices of linear finite elements on the domain's faces, whose material is the stiffer the
// smaller a face.
//
// With the stiffness 1/area the element matrices have entries without a sign of the area,
//   harmonic  K_ij = s e_i . e_j                                                  a number
//   elastic   K_ij = s (lambda n_i n_j^T + mu n_j n_i^T + mu (n_i . n_j) I)       two by two
// with e_i the side opposite corner i, n_i the same turned by a right angle, and s = label's stiffness / (2
// area)^2. So inverted faces count with the absolute value of their area, and every element is positive
// semidefinite.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <map>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "motion/interior/fans.h"

namespace kinemesh {

// Plane strain; the stiffness of a label is Lame's mu.
inline constexpr double poisson_ratio = 0.3;
inline constexpr double lame_lambda = 2.0 * poisson_ratio / (1.0 - 2.0 * poisson_ratio);  // over mu

// What a label may have; beyond, the solution would be lost in rounding.
inline constexpr double least_stiffness = 1e-6, most_stiffness = 1e6;

using Block = glm::dmat2;

// s of each face; 0 for padding. An area below 1e-4 times the sum of the squares of the sides (angles of
// about 0.01 degrees) counts as that much: a flat face must not make what is around it infinitely stiff. A
// face without extent counts for nothing. In all threads.
void scale_faces(const Mesh& mesh, std::span<const Point> positions, const std::map<int, double>& by_label,
                 std::vector<double>& scales);

// The matrix in rows, one for each vertex with a fan. Weight: double for harmonic, Block for elastic. As
// translations cost nothing, a diagonal entry is minus the sum of the others of its row, and is not stored.
template <class Weight>
class Stiffness {
 public:
  void reserve(int slots) { weights_.reserve(slots); }

  // Where the vertices are. Pre: fans of the mesh the scales are of. In all threads. Symmetric to the last
  // bit.
  void fill(const Fans& fans, std::span<const Point> positions, std::span<const double> scales);

  const Weight& weight(int slot) const { return weights_[slot]; }  // of fans.neighbour(slot) in its row
  Weight diagonal(const Fans& fans, Vertex vertex) const;

  // The row times x.
  Point product(const Fans& fans, Vertex vertex, const Point* x) const {
    Point sum(0.0, 0.0);
    const Point own = x[vertex];
    for (int slot = fans.begin(vertex); slot < fans.end(vertex); ++slot)
      sum += weights_[slot] * (x[fans.neighbour(slot)] - own);
    return sum;
  }

 private:
  std::vector<Weight> weights_;  // per slot
};

extern template class Stiffness<double>;
extern template class Stiffness<Block>;

}  // namespace kinemesh
