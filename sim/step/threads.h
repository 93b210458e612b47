// How many threads a run may use. For .cpp files: brings TBB.
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>

#include "kinemesh/error.h"

namespace kinemesh {

// Limits them as long as it lives.
class ThreadLimit {
 public:
  // wanted: 0 for all cores. Throws InputError below 0.
  explicit ThreadLimit(int wanted)
      : count_(count_of(wanted)),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)) {}

  int count() const { return count_; }

 private:
  static int count_of(int wanted) {
    if (wanted < 0) throw InputError("threads: a number not below 0 expected");
    return wanted > 0 ? wanted : tbb::info::default_concurrency();
  }

  int count_;
  tbb::global_control limit_;
};

}  // namespace kinemesh
