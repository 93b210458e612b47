// What strategies did in a benchmark, as a table.
#pragma once

#include <string>
#include <vector>

#include "kinemesh/compare.h"

namespace kinemesh::cli {

double median(std::vector<double> values);  // 0 of none

// What a strategy did over all steps, at one value of the sweep.
struct Score {
  int steps = 0, failed = 0;
  double replaced = 0.0;  // share of all faces, summed over the steps
  double min_angle_deg = 180.0;
  double bytes_per_vertex = 0.0;                                            // held after the last step
  std::vector<double> detect, explore, triangulate, splice, quality, step;  // ms; the step without the move

  void add(const Round& round);
};

// At most 100 columns wide.
void print_scores(const std::vector<std::string>& strategies, const std::vector<Score>& scores);

}  // namespace kinemesh::cli
