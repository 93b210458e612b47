// Ctrl-C ends a run after the step it is in. Internal to sim/.
#pragma once

#include <csignal>

namespace kinemesh {

// While it lives, the first SIGINT or SIGTERM is remembered instead of ending the process; the second ends
// it.
class StopOnSignals {
 public:
  explicit StopOnSignals(bool enabled);
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;

  // "SIGINT", "SIGTERM", or nullptr.
  static const char* received();

 private:
  bool enabled_;
  struct sigaction old_interrupt_, old_terminate_;
};

}  // namespace kinemesh
