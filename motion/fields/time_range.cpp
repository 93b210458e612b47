#include "motion/fields/time_range.h"

#include <fmt/format.h>

#include "kinemesh/error.h"

namespace kinemesh {

bool TimeRange::covers(double from, double to) const {
  constexpr double slack = 1e-9;  // of its length
  const double tolerance = slack * (last - first);
  return from >= first - tolerance && to <= last + tolerance;
}

void TimeRange::require(double from, double to, const std::string& file, const char* what) const {
  if (!covers(from, to))
    throw InputError(
        file, 0, fmt::format("{} from time {} to {}, but needed from {} to {}", what, first, last, from, to));
}

}  // namespace kinemesh
