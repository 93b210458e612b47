#include "sim/run/adaptive_steps.h"

#include <cmath>
#include <limits>

namespace kinemesh {
namespace {

constexpr int steps_before_doubling = 4;

}  // namespace

AdaptiveSteps::AdaptiveSteps(const TimeSpec& time, const AdaptiveState& state) : time_(time), state_(state) {}

// No step is added for rounding: see steps_to_reach.
double AdaptiveSteps::time_at(double position) const {
  if (!time_.adaptive) return time_.time_after(static_cast<int>(position));
  const double time = position * time_.dt;
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  return position >= time_.steps || time >= time_.end * (1.0 - rounding) ? time_.end : time;
}

double AdaptiveSteps::next_end() const {
  return time_at(state_.position + state_.length);
}

void AdaptiveSteps::accept() {
  state_.position += state_.length;
  if (!time_.adaptive) return;
  ++state_.in_a_row;
  const double doubled = 2.0 * state_.length;
  const bool is_due = state_.in_a_row >= steps_before_doubling && std::fmod(state_.position, doubled) == 0.0;
  if (!is_due || doubled * time_.dt > time_.adaptive->max_dt) return;
  state_.length = doubled;
  state_.in_a_row = 0;
}

// A last step that is shortened is not halved before its length is below what is left.
bool AdaptiveSteps::reject() {
  ++state_.rejected;
  state_.in_a_row = 0;
  if (!time_.adaptive) return false;
  const double end = next_end();
  do state_.length /= 2.0;
  while (next_end() == end);
  return state_.length * time_.dt >= time_.adaptive->min_dt;
}

}  // namespace kinemesh
