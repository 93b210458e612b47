// Lets the interior of a moving mesh follow its border.
//
// The increments of a step solve a linear elliptic equation on the domain's faces, by linear finite elements,
// with the border's increments as its Dirichlet values: Laplace's equation, div(k grad u) = 0, or that of
// linear elasticity. The stiffness k is one over the area of the face, so that small faces, which lie where
// the mesh has to be fine, are hardly deformed [Johnson & Tezduyar 1994; Masud & Hughes 1997]. It is solved
// twice: on the mesh as it is at the start of the step, and then on the mesh halfway through it. The second
// solution is the step's: like the midpoint rule it is right to second order in the step's length, and a mesh
// that is turned and turned back comes home. Faces that are inverted halfway count with the absolute value of
// their area.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>

#include "kinemesh/interior.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

enum class Role : std::uint8_t {
  Known,  // the increment is given
  Free,   // it is unknown
  Slide   // its part along a tangent is unknown, the other part is 0
};

// All per vertex of the mesh, in the mesh's numbering.
struct InteriorProblem {
  std::span<const Role> roles;
  const std::unordered_map<int, Point>& tangents;  // unit vectors of the Slide vertices
  std::span<const Point> others = {};  // increments that come on top of these, for the mesh halfway; or empty
};

struct InteriorSolution {
  bool converged = true;
  int iterations = 0;     // of both solutions
  double residual = 0.0;  // relative, of the last solution
};

// Solves by conjugate gradients with a preconditioner of two levels (motion/interior/two_level.h).
//
// Unknown are Free and Slide vertices with a face of the domain around them, if something moves them: two
// vertices of a face that are not Known belong to one part, and a part none of whose faces has a Known vertex
// with an increment other than 0 stays where it is, bit for bit. So what no border moves keeps its bits, and
// so does a part without Known vertices, or one that is only free to slide.
class Interior {
 public:
  // Takes most of the memory for meshes of this size, about 220 bytes a vertex for Harmonic and 430 for
  // Elastic; the first solve() takes the rest. Throws InputError for a stiffness that is not from 1e-6
  // to 1e6, a tolerance that is not positive, and max_iterations below 1.
  Interior(const Mesh& mesh, const InteriorOptions& options);
  ~Interior();
  Interior(Interior&&) noexcept;
  Interior& operator=(Interior&&) noexcept;

  // increments: at Known vertices given, and left as they are; elsewhere the start vector before, of which
  // Slide vertices take the part along their tangent, and the solution after; 0 where nothing moves. Without
  // convergence the last iterate. Pre: the mesh is valid, of as many vertices as the constructor's, and at
  // the start of the step; increments are finite. In all threads, the same bits whatever their number, and
  // whatever has been solved before. Coordinates and increments times a power of two give the solution times
  // that power, bit for bit, short of overflow. Cost: O(n) an iteration, of which there are some tens, nearly
  // independent of n. Throws std::bad_alloc.
  [[nodiscard]] InteriorSolution solve(const Mesh& mesh, const InteriorProblem& problem,
                                       std::span<Point> increments);

 private:
  class Solver;
  template <class Weight>
  class WeightedSolver;

  std::unique_ptr<Solver> solver_;  // none: nothing follows
};

}  // namespace kinemesh
