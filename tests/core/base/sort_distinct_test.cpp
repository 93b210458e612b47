#include "core/base/sort_distinct.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

TEST(SortDistinct, SortsFewNumbersAndAll) {
  Random random(1);
  for (const int n : {1, 2, 31, 32, 33, 64, 1000}) {
    for (int count = 0; count <= n; count += 1 + count / 4) {
      std::vector<int> numbers(n);
      std::iota(numbers.begin(), numbers.end(), 0);
      for (int i = n - 1; i > 0; --i) std::swap(numbers[i], numbers[random.below(i + 1)]);
      numbers.resize(count);
      auto expected = numbers;
      std::sort(expected.begin(), expected.end());
      sort_distinct(numbers, n);
      ASSERT_EQ(numbers, expected) << count << " of " << n;
    }
  }
}

}  // namespace
}  // namespace kinemesh::test
