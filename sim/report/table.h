// A CSV file as columns of numbers, by name. Internal to sim/report/.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kinemesh::report {

struct Table {
  std::vector<std::string> names;                         // in the file's order
  std::map<std::string, std::vector<double>> numbers;     // NaN where there is none
  std::map<std::string, std::vector<std::string>> texts;  // of the columns that are texts
  std::size_t size = 0;                                   // rows

  bool has(const std::string& name) const { return numbers.contains(name); }
};

double number_of(std::string_view field);  // NaN where it is none

// As [Shafranovich 2005]. The first record names the columns; none may be missing of those `required`. A last
// record that is not whole, as a killed run may leave it, is left out. Throws InputError with file and line.
Table read_table(
    const std::filesystem::path& file, const std::vector<std::string>& required,
    const std::function<bool(const std::string&)>& is_text = [](const std::string&) { return false; });

// The rows of these numbers.
Table select(const Table& table, const std::vector<std::size_t>& rows);

}  // namespace kinemesh::report
