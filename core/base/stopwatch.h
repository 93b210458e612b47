// Wall time, for the records of what a step cost; nothing is decided by it.
#pragma once

#include <chrono>

namespace kinemesh {

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace kinemesh
