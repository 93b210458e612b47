// Loops are done whole, and their threads are there before they are needed.
#include "core/base/parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <filesystem>
#include <iterator>
#include <thread>
#include <vector>

namespace kinemesh {
namespace {

namespace fs = std::filesystem;
using Limit = tbb::global_control;

long n_threads() {
  return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

int sum_to(int n) {
  std::atomic<int> sum{0};
  parallel_parts(n, 1, [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) sum += i;
  });
  return sum;
}

TEST(Parallel, AsManyThreadsAsAllowedAreMadeAtOnceAndStay) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer has threads of its own";
#endif
  if (!fs::exists("/proc/self/task")) GTEST_SKIP() << "no /proc";
  const long before = n_threads(), all = std::max<long>(before, tbb::info::default_concurrency());
  {
    const Limit one(Limit::max_allowed_parallelism, 1);
    EXPECT_EQ(sum_to(1000), 499500);
    EXPECT_EQ(n_threads(), before);
  }
  std::thread([] { EXPECT_EQ(sum_to(1000), 499500); }).join();
  EXPECT_EQ(n_threads(), all);
  EXPECT_EQ(sum_to(1000), 499500);
  EXPECT_EQ(n_threads(), all);
}

TEST(Parallel, ManyThreadsMayStartAtTheSameTime) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) threads.emplace_back([] { EXPECT_EQ(sum_to(1000), 499500); });
  for (auto& thread : threads) thread.join();
}

TEST(Parallel, MayBeCalledWithinALoop) {
  std::atomic<int> sum{0};
  tbb::parallel_for(0, 20, [&](int) { sum += sum_to(100); });
  EXPECT_EQ(sum, 20 * 4950);
}

TEST(Parallel, TheFirstExceptionInOrderReachesTheCaller) {
  for (int round = 0; round < 100; ++round) {
    try {
      parallel_parts(64, 1, [](int part, int, int) {
        if (part >= 7) throw part;
      });
      FAIL();
    } catch (const int part) {
      EXPECT_EQ(part, 7);
    }
  }
}

}  // namespace
}  // namespace kinemesh
