#include "sim/report/table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "core/io/atomic_file.h"

namespace kinemesh::report {
namespace {

std::vector<std::string_view> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (std::size_t start = 0;;) {
    const std::size_t comma = line.find(',', start);
    cells.push_back(line.substr(start, comma - start));
    if (comma == std::string_view::npos) return cells;
    start = comma + 1;
  }
}

double number_of(std::string_view cell) {
  double value = 0.0;
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number = result.ec == std::errc() && result.ptr == cell.data() + cell.size();
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::vector<std::string>& text_columns) {
  const std::string content = read_file(file);
  Table table;
  std::vector<std::vector<double>*> numbers;
  std::vector<std::vector<std::string>*> texts;
  std::string_view rest = content;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos && line > 1) break;
    const auto cells = cells_of(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line == 1) {
      table.names.assign(cells.begin(), cells.end());
      for (const std::string& name : table.names) {
        const bool is_text = std::ranges::find(text_columns, name) != text_columns.end();
        numbers.push_back(is_text ? nullptr : &table.numbers[name]);
        texts.push_back(is_text ? &table.texts[name] : nullptr);
      }
      continue;
    }
    if (cells.size() != numbers.size())
      throw InputError(
          file.string(), line,
          std::to_string(cells.size()) + " columns, " + std::to_string(numbers.size()) + " expected");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (numbers[i])
        numbers[i]->push_back(number_of(cells[i]));
      else
        texts[i]->emplace_back(cells[i]);
    }
    ++table.size;
  }
  for (const std::string& name : required)
    if (std::ranges::find(table.names, name) == table.names.end())
      throw InputError(file.string(), 1, "a column " + name + " expected");
  return table;
}

Table select(const Table& table, const std::vector<std::size_t>& rows) {
  Table selected;
  selected.names = table.names;
  selected.size = rows.size();
  for (const auto& [name, values] : table.numbers)
    for (const std::size_t row : rows) selected.numbers[name].push_back(values[row]);
  for (const auto& [name, values] : table.texts)
    for (const std::size_t row : rows) selected.texts[name].push_back(values[row]);
  return selected;
}

}  // namespace kinemesh::report
