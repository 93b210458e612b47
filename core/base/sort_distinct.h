// Sorting numbers of a mesh's faces, edges or vertices, be they few of them or all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinemesh {

// Ascending. Pre: each from 0 and below n, and there once.
template <class List>
void sort_distinct(List& numbers, int n) {
  using Number = typename List::value_type;
  if (numbers.size() < static_cast<std::size_t>(n) / 32) {
    std::sort(numbers.begin(), numbers.end());
    return;
  }
  std::vector<bool> is_there(n, false);
  for (const int number : numbers) is_there[number] = true;
  auto next = numbers.begin();
  for (int number = 0; number < n; ++number)
    if (is_there[number]) *next++ = Number(number);
}

}  // namespace kinemesh
