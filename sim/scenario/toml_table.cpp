#include "sim/scenario/toml_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace kinemesh {
namespace {

Where where_of(const toml::source_region& source) {
  Where where;
  if (source.path) where.file = *source.path;
  // The text of an override has but one line.
  if (!where.file.starts_with("--set ")) where.line = static_cast<int>(source.begin.line);
  return where;
}

// Levenshtein's distance.
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char c : a) {
    int diagonal = row[0]++;
    for (size_t j = 1; j <= b.size(); ++j) {
      const int changed = diagonal + (c == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// The first of them, where they are many.
std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t most = 50;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) text += (i == 0 ? "" : ", ") + words[i];
  return words.size() > most ? text + ", and " + std::to_string(words.size() - most) + " more" : text;
}

// How different two words may be to be taken for each other.
int near(std::string_view word) {
  return std::max(1, (static_cast<int>(word.size()) + 1) / 3);
}

// The candidate nearest to a word, none where no one is near. Long ones are not looked at: it takes the
// product of their lengths.
const std::string* nearest_to(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 100;
  const std::string* nearest = nullptr;
  int least = near(word) + 1;
  for (const std::string& candidate : candidates) {
    if (std::max(word.size(), candidate.size()) > longest) continue;
    const int distance = edit_distance(word, candidate);
    if (distance < least) nearest = &candidate;
    least = std::min(least, distance);
  }
  return nearest;
}

const char* name_of(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string as_written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& n) {
    if constexpr (toml::is_value<decltype(n)>) text << n;
  });
  return text.str().empty() ? name_of(node.type()) : text.str();
}

// "interior.stiffness" of "[interior]" and "stiffness".
std::string path_of(const std::string& table, std::string_view key) {
  const auto end = table.find(']');
  return (end == std::string::npos ? "" : table.substr(1, end - 1) + ".") + std::string(key);
}

std::optional<double> as_finite(const toml::node& node) {
  const std::optional<double> number = node.is_number() ? node.value<double>() : std::nullopt;
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// All its elements, or nothing unless they are finite numbers.
std::optional<std::vector<double>> as_numbers(const toml::array& list) {
  std::vector<double> numbers;
  for (const auto& element : list) {
    const auto number = as_finite(element);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

// The same for a list of points; an empty list is one of numbers.
std::optional<std::vector<Point>> as_points(const toml::array& list) {
  std::vector<Point> points;
  for (const auto& element : list) {
    const auto pair = element.is_array() ? as_numbers(*element.as_array()) : std::nullopt;
    if (!pair || pair->size() != 2) return std::nullopt;
    points.emplace_back((*pair)[0], (*pair)[1]);
  }
  return points;
}

}  // namespace

Where where_of(const toml::node& node) {
  return where_of(node.source());
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "";
  if (const std::string* nearest = nearest_to(word, candidates)) return ", did you mean '" + *nearest + "'?";
  return ", expected one of: " + joined(candidates);
}

TomlTable::TomlTable(const toml::table& table, std::string name) : table_(table), name_(std::move(name)) {}

const toml::node* TomlTable::find(std::string_view key) {
  known_.emplace_back(key);
  return table_.get(key);
}

std::optional<double> TomlTable::number(std::string_view key) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  const auto number = as_finite(*node);
  if (!number) fail(key, as_written(*node) + ", a finite number expected");
  return number;
}

std::optional<double> TomlTable::positive(std::string_view key) {
  const auto value = number(key);
  if (value && *value <= 0) fail(key, as_written(*table_.get(key)) + ", a number above 0 expected");
  return value;
}

std::optional<double> TomlTable::not_negative(std::string_view key) {
  const auto value = number(key);
  if (value && *value < 0) fail(key, as_written(*table_.get(key)) + ", a number not below 0 expected");
  return value;
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t from, std::int64_t to) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  const auto* number = node->as_integer();
  if (number && number->get() >= from && number->get() <= to) return number->get();
  const bool open = to == std::numeric_limits<std::int64_t>::max();
  fail(key, as_written(*node) + ", an integer from " + std::to_string(from) +
                (open ? std::string(" on") : " to " + std::to_string(to)) + " expected");
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) fail(key, as_written(*node) + ", true or false expected");
  return node->as_boolean()->get();
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) fail(key, as_written(*node) + ", a text in quotes expected");
  return node->as_string()->get();
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  if (node->is_string()) return std::vector{node->as_string()->get()};
  if (const auto* list = node->as_array(); list && list->empty())
    fail(key, "an empty list, a text in quotes or a list of such expected");
  std::vector<std::string> texts;
  if (const auto* list = node->as_array())
    for (const auto& element : *list)
      if (const auto* text = element.as_string()) texts.push_back(text->get());
  if (texts.empty() || texts.size() != node->as_array()->size())
    fail(key, as_written(*node) + ", a text in quotes or a list of such expected");
  return texts;
}

std::optional<ParameterValue> TomlTable::value(std::string_view key) {
  const auto* node = find(key);
  if (!node) return std::nullopt;
  if (const auto* text = node->as_string()) return text->get();
  if (const auto* integer = node->as_integer()) return integer->get();
  if (const auto number = as_finite(*node)) return *number;
  if (const auto* list = node->as_array()) {
    if (auto numbers = as_numbers(*list)) return std::move(*numbers);
    if (auto points = as_points(*list)) return std::move(*points);
  }
  fail(key,
       as_written(*node) + ", a finite number, a text or a list of numbers or of points [x, y] expected");
}

const toml::table* TomlTable::table(std::string_view key) {
  const auto* node = find(key);
  if (node && !node->is_table())
    fail(key, as_written(*node) + ", a table expected: [" + path_of(name_, key) + "]");
  return node ? node->as_table() : nullptr;
}

std::vector<const toml::table*> TomlTable::tables(std::string_view key) {
  const auto* node = find(key);
  if (!node) return {};
  std::vector<const toml::table*> tables;
  if (const auto* list = node->as_array())
    for (const auto& element : *list) tables.push_back(element.as_table());
  if (!node->is_array() || std::ranges::count(tables, nullptr) > 0)
    fail(key, as_written(*node) + ", a list of tables expected: " +
                  (name_.empty() ? "[[" + std::string(key) + "]]" : std::string(key) + " = [{ ... }]"));
  return tables;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table_) keys.emplace_back(key.str());
  return keys;
}

Where TomlTable::where() const {
  // A table that an override made has no place of its own.
  const Where where = where_of(table_);
  return where.file.empty() && !table_.empty() ? where_of(table_.begin()->first.source()) : where;
}

Where TomlTable::where(std::string_view key) const {
  const auto found = table_.find(key);
  return found == table_.end() ? where() : where_of(found->first.source());
}

void TomlTable::refuse_other_keys() const {
  const toml::key* first = nullptr;
  for (const auto& [key, node] : table_) {
    const bool is_known = std::ranges::find(known_, key.str()) != known_.end();
    if (!is_known && (!first || key.source().begin.line < first->source().begin.line)) first = &key;
  }
  if (!first) return;
  throw error_at(where_of(first->source()), "unknown key '" + std::string(first->str()) +
                                                (name_.empty() ? "'" : "' in " + name_) +
                                                suggestion(first->str(), known_));
}

void TomlTable::fail(std::string_view key, const std::string& what) const {
  throw error_at(where(key), std::string(key) + ": " + what);
}

}  // namespace kinemesh
