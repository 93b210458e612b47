// The times for which a file says where something is. Internal to motion/.
#pragma once

#include <string>

namespace kinemesh {

struct TimeRange {
  double first, last;

  // A step that ends where the file does may miss its last time by rounding.
  bool covers(double from, double to) const;

  // Throws InputError that names the file and what it holds ("rows") unless it covers these.
  void require(double from, double to, const std::string& file, const char* what) const;
};

}  // namespace kinemesh
