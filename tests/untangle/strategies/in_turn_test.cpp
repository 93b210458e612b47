#include "tests/untangle/strategies/in_turn.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/untangle/random_tangles.h"

namespace kinemesh::test {
namespace {

void expect_in_turn(int seeds, const std::function<Tangle(std::uint64_t)>& make) {
  int broken = 0;
  for (int seed = 1; seed <= seeds && broken < 3; ++seed) {
    const auto tangle = make(seed);
    Random order(seed);
    const auto wrong = check_in_turn(tangle.mesh, order);
    EXPECT_EQ(wrong, "") << tangle.about << " " << seed;
    broken += !wrong.empty();
  }
}

TEST(LocalInTurn, EndsAsGlobalUntanglingDoesOnRandomTangles) {
  expect_in_turn(1300, random_tangle);
}

TEST(LocalInTurn, EndsAsGlobalUntanglingDoesInDegeneratePositions) {
  expect_in_turn(1500, lattice_tangle);
  expect_in_turn(1500, polyomino_tangle);
}

}  // namespace
}  // namespace kinemesh::test
