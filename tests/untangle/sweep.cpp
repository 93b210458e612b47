// Long sweeps over the properties of tests/untangle/properties.h and in_motion.h: sweep_untangle [SEEDS]
// [FIRST]. Prints every seed that breaks one; exit 1 if there is any.
#include <charconv>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iostream>

#include "tests/untangle/in_motion.h"
#include "tests/untangle/properties.h"

namespace {

using Property = std::string (*)(std::uint64_t);

std::string attempt(Property property, std::uint64_t seed) {
  try {
    return property(seed);
  } catch (const std::exception& e) {
    return std::to_string(seed) + ": " + e.what();
  }
}

std::uint64_t sweep(const char* name, Property property, std::uint64_t first, std::uint64_t seeds) {
  std::uint64_t broken = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    const auto wrong = attempt(property, seed);
    if (wrong.empty()) continue;
    ++broken;
    std::cout << name << ": " << wrong << std::endl;
  }
  std::cout << name << ": " << seeds << " seeds from " << first << ", " << broken << " broken" << std::endl;
  return broken;
}

std::uint64_t number(int argc, char** argv, int i, std::uint64_t otherwise) {
  if (i < argc) std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), otherwise);
  return otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kinemesh::test;
  const auto seeds = number(argc, argv, 1, 100000), first = number(argc, argv, 2, 1);
  const auto broken = sweep("random tangles", check_random_tangle, first, seeds) +
                      sweep("lattice tangles", check_lattice_tangle, first, seeds) +
                      sweep("polyomino tangles", check_polyomino_tangle, first, seeds) +
                      sweep("tangles in motion", check_tangles_in_motion, first, seeds);
  return broken == 0 ? 0 : 1;
}
