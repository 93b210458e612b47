// The exploration equals brute force on random tangles. KINEMESH_TANGLES and KINEMESH_FIRST_TANGLE in the
// environment choose how many tangled ones and the first seed (scripts/sweep_local.sh).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "tests/untangle/explore/compare.h"
#include "tests/untangle/explore/tangles.h"

namespace kinemesh::test {
namespace {

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

TEST(LocalSweep, EqualsBruteForceOnRandomTangles) {
  const int first = from_environment("KINEMESH_FIRST_TANGLE", 1);
  const int n = from_environment("KINEMESH_TANGLES", 150);
  Counts counts;
  for (int seed = first; counts.tangled < n; ++seed) {
    compare(random_tangle(seed), "tangle" + std::to_string(seed), counts);
  }
  std::cout << counts;
  EXPECT_LE(counts.degenerate, n / 100);
  EXPECT_GT(counts.extended, 0);
  EXPECT_GT(counts.valid, 0);
}

// Small tangles on which each of these happens.
TEST(LocalSweep, EqualsBruteForceOnRarePaths) {
  Counts counts;
  for (const int seed : {301064, 302915, 304552, 301848, 302883, 304098, 304182, 304315, 304794, 310857,
                         311234, 311726, 312594, 1000702}) {
    compare(random_tangle(seed), "tangle" + std::to_string(seed), counts);
  }
  EXPECT_GE(counts.gamma_2, 3);
  EXPECT_GE(counts.overstepped, 20);
  EXPECT_GE(counts.self_overlapping, 20);
  EXPECT_GE(counts.self_overlapping_here, 7);
}

TEST(LocalSweep, EqualsBruteForceOnNearlyDegenerateTangles) {
  Counts counts;
  for (int seed = 1; counts.tangled < 40; ++seed) {
    compare(nearly_degenerate_tangle(seed), "nearly_degenerate" + std::to_string(seed), counts);
  }
  EXPECT_GT(counts.extended, 0);
}

}  // namespace
}  // namespace kinemesh::test
