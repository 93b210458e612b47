#include "sim/run/stop_signal.h"

namespace kinemesh {
namespace {

volatile std::sig_atomic_t last_signal = 0;

extern "C" void remember_signal(int signal) {
  last_signal = signal;
}

}  // namespace

StopOnSignals::StopOnSignals(bool enabled) : enabled_(enabled), old_interrupt_{}, old_terminate_{} {
  last_signal = 0;
  if (!enabled_) return;
  struct sigaction once {};
  once.sa_handler = remember_signal;
  once.sa_flags = SA_RESETHAND | SA_RESTART;
  sigaction(SIGINT, &once, &old_interrupt_);
  sigaction(SIGTERM, &once, &old_terminate_);
}

StopOnSignals::~StopOnSignals() {
  if (!enabled_) return;
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
}

const char* StopOnSignals::received() {
  if (last_signal == SIGINT) return "SIGINT";
  return last_signal == SIGTERM ? "SIGTERM" : nullptr;
}

}  // namespace kinemesh
