#include "sim/report/bench_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_set>
#include <utility>

namespace kinemesh::report {
namespace {

// So that at most `most` of n stay where only every so many are kept.
std::size_t stride_for(std::size_t n, std::size_t most) {
  return std::max<std::size_t>(1, (n + most - 1) / most);
}

// Per row, a number of the values that a sweep has there, in the order of appearance.
std::vector<std::size_t> cases_of(const Table& rows) {
  std::map<std::vector<std::string>, std::size_t> numbers;
  std::vector<std::size_t> cases;
  for (std::size_t row = 0; row < rows.size; ++row) {
    std::vector<std::string> values;
    for (const auto& [name, texts] : rows.texts)
      if (name != "strategy") values.push_back(texts[row]);
    cases.push_back(numbers.emplace(std::move(values), numbers.size()).first->second);
  }
  return cases;
}

Table keep_some_cases(const Table& rows, std::vector<std::string>& notes) {
  const auto cases = cases_of(rows);
  const std::size_t n = cases.empty() ? 0 : 1 + *std::ranges::max_element(cases);
  const std::size_t stride = stride_for(n, most_cases);
  if (stride == 1) return rows;
  notes.push_back(fmt::format("The benchmark is shown for one of every {} of its {} values.", stride, n));
  std::vector<std::size_t> kept(rows.size);
  std::iota(kept.begin(), kept.end(), 0);
  std::erase_if(kept, [&](std::size_t row) { return cases[row] % stride != 0; });
  return select(rows, kept);
}

Table keep_some_steps(const Table& rows, std::vector<std::string>& notes) {
  const std::size_t stride = stride_for(rows.size, most_bench_rows);
  if (stride == 1) return rows;
  notes.push_back(fmt::format("The benchmark is shown with one of every {} steps.", stride));
  const auto cases = cases_of(rows);
  std::map<std::pair<std::size_t, std::string>, std::size_t> steps;  // so far, by case and strategy
  std::vector<std::size_t> kept;
  for (std::size_t row = 0; row < rows.size; ++row)
    if (steps[{cases[row], rows.texts.at("strategy")[row]}]++ % stride == 0) kept.push_back(row);
  return select(rows, kept);
}

}  // namespace

Table thin_bench(const Table& rows, std::vector<std::string>& notes) {
  return keep_some_steps(keep_some_cases(rows, notes), notes);
}

std::vector<std::string> distinct(const std::vector<std::string>& values) {
  std::vector<std::string> found;
  std::unordered_set<std::string_view> seen;
  for (const std::string& value : values)
    if (seen.insert(value).second) found.push_back(value);
  return found;
}

}  // namespace kinemesh::report
