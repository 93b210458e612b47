// The rows of a benchmark that a page has room for, and a browser time. Internal to sim/report/.
#pragma once

#include <string>
#include <vector>

#include "sim/report/table.h"

namespace kinemesh::report {

inline constexpr std::size_t most_cases =
    200;  // values of a sweep: each is a row of the page's table for a strategy
inline constexpr std::size_t most_bench_rows = 50'000;

// Columns that are texts, but for the strategy, are what a sweep has varied. Of more values than most_cases
// every second, third, ... is kept, and likewise of the steps where there are more than most_bench_rows rows;
// notes say so.
Table thin_bench(const Table& rows, std::vector<std::string>& notes);

// In the order of appearance.
std::vector<std::string> distinct(const std::vector<std::string>& values);

}  // namespace kinemesh::report
