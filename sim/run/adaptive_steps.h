// How long the next step is: halved where a step was rejected, doubled again where steps go well.
#pragma once

#include <cstdint>

#include "kinemesh/scenario.h"

namespace kinemesh {

// All there is to remember between steps. Position and length count in steps of the scenario's dt and are
// exact: multiples of a power of two, and such a power. So the times of steps that were never halved are
// those of a run without adaptive steps, bit for bit.
struct AdaptiveState {
  double position = 0.0;  // time reached
  double length = 1.0;    // of the next step, before it is shortened to the end
  int in_a_row = 0;       // accepted steps since the length changed
  std::int64_t rejected = 0;
};

// A rejected step is halved. After four accepted steps of one length the length doubles, up to max_dt, once
// the position is a multiple of the doubled length. The last step is shortened to the end, as without
// adaptive steps. Without time.adaptive no step has a half.
class AdaptiveSteps {
 public:
  explicit AdaptiveSteps(const TimeSpec& time, const AdaptiveState& state = {});

  bool is_done() const { return time_at(state_.position) == time_.end; }
  double next_end() const;  // time at the end of the next step; after the time reached unless is_done()
  void accept();            // the step to next_end() was taken
  bool reject();  // it was not; false if it has no half of at least min_dt: there is then no next step
  const AdaptiveState& state() const { return state_; }

 private:
  double time_at(double position) const;

  TimeSpec time_;
  AdaptiveState state_;
};

}  // namespace kinemesh
