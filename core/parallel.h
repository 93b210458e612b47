// Loops in all threads. For .cpp files: brings TBB.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

#include "core/types.h"

namespace kinemesh {

inline constexpr int most_parts = 64;

// Into so many parts parallel_parts cuts n things: of `grain` or more, up to most_parts.
inline int n_parts(int n, int grain) {
  return std::clamp(n / grain, 1, most_parts);
}

// Calls body(part, begin, end), begin to end out of 0 to n, for each part in all threads. The parts depend on
// n and grain only, so that what is gathered by part and put together in their order does not depend on the
// number of threads. Takes no memory but what TBB takes for itself. What bodies have written can be read afterwards: TBB sees to that; the
// two counters say it to the thread sanitizer, which does not see into TBB.
template <class Body>
void parallel_parts(int n, int grain, const Body& body) {
  const int parts = n_parts(n, grain);
  const auto start = [&](int part) { return static_cast<int>(std::int64_t{n} * part / parts); };
  std::atomic<int> started{0}, done{0};
  started.fetch_add(1, std::memory_order_release);
  tbb::parallel_for(0, parts, [&](int part) {
    started.load(std::memory_order_acquire);
    body(part, start(part), start(part + 1));
    done.fetch_add(1, std::memory_order_release);
  });
  done.load(std::memory_order_acquire);
}

// The lowest i from 0 and below n with is_wanted(i), or none, whatever the number of threads.
template <class Predicate>
int find_first(int n, int grain, const Predicate& is_wanted) {
  std::array<int, most_parts> found;
  found.fill(none);
  parallel_parts(n, grain, [&](int part, int begin, int end) {
    int i = begin;
    while (i < end && !is_wanted(i)) ++i;
    if (i < end) found[part] = i;
  });
  const auto first = std::find_if(found.begin(), found.end(), [](int i) { return i != none; });
  return first == found.end() ? none : *first;
}

// Calls both, at the same time where there are threads. Neither may write what the other reads.
template <class First, class Second>
void parallel_pair(const First& first, const Second& second) {
  parallel_parts(2, 1, [&](int part, int, int) {
    if (part == 0)
      first();
    else
      second();
  });
}

}  // namespace kinemesh
