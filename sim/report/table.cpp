#include "sim/report/table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "core/io/atomic_file.h"

namespace kinemesh::report {
namespace {

// More than any log has; what a record takes is bounded with it.
constexpr std::size_t most_columns = 4096;

// The records of a CSV file [Shafranovich 2005]: fields in quotes may hold commas, line ends, and quotes
// written twice.
class Records {
 public:
  Records(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

  // False at the end, and where a last record is not whole: the first one needs no line end.
  bool read(std::vector<std::string>& fields) {
    fields.assign(1, "");
    first_line_ = line_;
    bool is_quoted = false;
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      line_ += c == '\n';
      if (c == '"') {
        if (!is_quoted && at_ > 1 && text_[at_ - 2] == '"') fields.back() += '"';
        is_quoted = !is_quoted;
      } else if (is_quoted) {
        fields.back() += c;
      } else if (c == '\n') {
        return true;
      } else if (c == ',') {
        if (fields.size() == most_columns)
          fail("more than " + std::to_string(most_columns) + " columns, the most a table may have");
        fields.emplace_back();
      } else if (c != '\r') {
        fields.back() += c;
      }
    }
    if (is_quoted && line_ > first_line_) fail("a quote that does not end");
    return first_line_ == 1 && !std::exchange(is_at_end_, true);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_.string(), first_line_, what);
  }

 private:
  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  int line_ = 1, first_line_ = 1;
  bool is_at_end_ = false;
};

}  // namespace

double number_of(std::string_view field) {
  double value = 0.0;
  const auto result = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool is_number = result.ec == std::errc() && result.ptr == field.data() + field.size();
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& required,
                 const std::function<bool(const std::string&)>& is_text) {
  const std::string content = read_file(file);
  Records records(content, file);
  Table table;
  records.read(table.names);
  if (const std::set<std::string> names(table.names.begin(), table.names.end());
      names.size() < table.names.size())
    records.fail("two columns of one name");
  for (const std::string& name : required)
    if (std::ranges::find(table.names, name) == table.names.end())
      records.fail("a column " + name + " expected");
  std::vector<std::vector<double>*> numbers;
  std::vector<std::vector<std::string>*> texts;
  for (const std::string& name : table.names) {
    numbers.push_back(is_text(name) ? nullptr : &table.numbers[name]);
    texts.push_back(is_text(name) ? &table.texts[name] : nullptr);
  }
  for (std::vector<std::string> fields; records.read(fields); ++table.size) {
    if (fields.size() != table.names.size())
      records.fail(std::to_string(fields.size()) + " columns, " + std::to_string(table.names.size()) +
                   " expected");
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (numbers[i])
        numbers[i]->push_back(number_of(fields[i]));
      else
        texts[i]->push_back(fields[i]);
    }
  }
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
