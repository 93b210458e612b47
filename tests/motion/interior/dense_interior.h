// The interior's equations by Gaussian elimination: slow, and written down face by face.
#pragma once

#include <vector>

#include "motion/interior/interior.h"

namespace kinemesh::test {

struct DenseSolution {
  std::vector<Point> increments;
  bool is_unique = true;  // no pivot is small
};

// What Interior::solve is to find, solved exactly but for rounding.
DenseSolution solve_densely(const Mesh& mesh, const InteriorOptions& options, const InteriorProblem& problem,
                            std::vector<Point> increments);

}  // namespace kinemesh::test
