// The exploration equals brute force on random tangles. KINEMESH_TANGLES and KINEMESH_FIRST_TANGLE in the
// environment choose how many tangled ones and the first seed (scripts/sweep_local.sh).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "tests/untangle/local/compare.h"
#include "tests/untangle/local/tangles.h"

namespace kinemesh::test {
namespace {

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

TEST(LocalSweep, EqualsBruteForceOnRandomTangles) {
  const int first = from_environment("KINEMESH_FIRST_TANGLE", 1);
  const int n = from_environment("KINEMESH_TANGLES", 250);
  Counts counts;
  for (int seed = first; counts.tangled < n; ++seed) {
    compare(random_tangle(seed), "tangle" + std::to_string(seed), counts);
  }
  std::cout << counts;
  EXPECT_LE(counts.degenerate, n / 100);
  EXPECT_GT(counts.extended, 0);
  EXPECT_GT(counts.valid, 0);
}

}  // namespace
}  // namespace kinemesh::test
