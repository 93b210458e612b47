// Loops in all threads, or without where none can be made.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "kinemesh/types.h"

namespace kinemesh {

inline constexpr int most_parts = 64;

// How many of them are worth a task.
namespace grain {
inline constexpr int items = 1 << 14;  // vertices, faces or sides of which a few numbers are read
inline constexpr int moves = 1 << 12;  // of a vertex, by fields or by equations
inline constexpr int stretches = 256;  // or blocks: some 64 items each
inline constexpr int places = 32;      // the best ones of a vertex
inline constexpr int regions = 16;
}  // namespace grain

// Into so many parts parallel_parts cuts n things: of `grain` or more, up to most_parts.
inline int n_parts(int n, int grain) {
  return std::clamp(n / grain, 1, most_parts);
}

// Calls do_part(body, part) for each part from 0, each once, in all threads. Where some throw, others may be
// left out; throws what the first of them in order has thrown. The first call makes the threads that TBB may
// use, and they stay: TBB itself ends the process where it wants one that cannot be made. Where they cannot,
// or there is no memory to share the work, the calling thread does it alone.
void do_parts(int parts, void (*do_part)(const void* body, int part), const void* body);

// Calls body(part, begin, end), begin to end out of 0 to n, for each part in all threads. The parts depend on
// n and grain only, so that what is gathered by part and put together in their order does not depend on the
// number of threads. Takes no memory but what TBB takes for itself. What bodies have written can be read
// afterwards.
template <class Body>
void parallel_parts(int n, int grain, const Body& body) {
  const int parts = n_parts(n, grain);
  const auto start = [&](int part) { return static_cast<int>(std::int64_t{n} * part / parts); };
  const auto one = [&](int part) { body(part, start(part), start(part + 1)); };
  if (parts == 1) return one(0);
  do_parts(
      parts, [](const void* all, int part) { (*static_cast<decltype(&one)>(all))(part); }, &one);
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
