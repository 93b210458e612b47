// How the interior of a moving mesh follows its border: by a linear elliptic equation for the increments of
// each step, with the border's as its boundary values (docs/algorithm.md).
#pragma once

#include <cstdint>
#include <map>

#pragma GCC visibility push(default)
namespace kinemesh {

enum class Follow : std::uint8_t {
  None,
  Harmonic,  // both coordinates by themselves: translations are followed exactly
  Elastic    // in plane strain: infinitesimal rotations, too
};

struct InteriorOptions {
  Follow follow = Follow::Harmonic;
  // By label, times that of the area; from 1e-6 to 1e6; 1 where not named.
  std::map<int, double> stiffness = {};
  double tolerance = 1e-5;  // norm of the residual over the diagonal, relative to that of the right-hand side
  int max_iterations = 10000;  // of each of the two solutions
};

}  // namespace kinemesh
#pragma GCC visibility pop
