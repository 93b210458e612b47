// Measures what the aims of docs/performance.md speak of.
//
//   kinemesh_aims SUBJECT [VERTICES]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "aims.h"

namespace {

using namespace kinemesh::aims;

struct Subject {
  std::string_view name;
  void (*measure)(int n);
  int n;  // unless said otherwise
};

constexpr Subject subjects[] = {
    {"steps", whole_steps, 1'000'000},
    {"detection", detection, 1'000'000},
    {"regions", regions_against_cgal, 1'000'000},
    {"fixed-tangle", fixed_tangle, 10'000'000},
    {"explored", explored, 1'000'000},
    {"local-growth", local_growth, 400'000},
    {"threads", two_threads, 1'000'000},
    {"interior", interior, 1'000'000},
    {"angles", angles, 10'000},
    {"memory", memory, 1'000'000},
    {"huge", huge, 50'000'000},
    {"file", first_step_of_file, 1'000'000},
};

int refuse() {
  std::fprintf(stderr, "kinemesh_aims SUBJECT [VERTICES], with one of these subjects:\n");
  for (const auto& subject : subjects) std::fprintf(stderr, "  %-14s %9d\n", subject.name.data(), subject.n);
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2 || argc > 3) return refuse();
  for (const auto& subject : subjects) {
    if (subject.name != argv[1]) continue;
    const int n = argc > 2 ? std::atoi(argv[2]) : subject.n;
    if (n < 100) return refuse();
    subject.measure(n);
    return 0;
  }
  return refuse();
} catch (const std::exception& error) {
  std::fprintf(stderr, "kinemesh_aims: %s\n", error.what());
  return 1;
}
