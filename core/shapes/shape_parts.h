// What the shapes' source files share.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

#include "kinemesh/types.h"

namespace kinemesh {

// The standard fixes this generator's bits, but not those of its distributions.
class UniformRandom {
 public:
  explicit UniformRandom(std::uint64_t seed) : bits_(seed) {}
  double in_unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  // [0, 1)
  double between(double a, double b) { return a + (b - a) * in_unit(); }

 private:
  std::mt19937_64 bits_;
};

inline Point on_circle(double radius, double turns) {
  const double angle = 2.0 * std::numbers::pi * turns;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Throws InputError for a shape that `vertices` are not enough for, and where they are more than a mesh can
// have.
void require_vertices(std::string_view shape, int vertices, int minimum);

}  // namespace kinemesh
