#include "sim/scenario/overrides.h"

#include <charconv>
#include <optional>
#include <sstream>

#include "kinemesh/scenario.h"
#include "sim/scenario/toml_text.h"

namespace kinemesh {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw InputError(name, 0, what);
}

std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 100;
  return name.size() > longest ? name.substr(0, longest) + "..." : name;
}

std::optional<toml::table> try_parse(const std::string& text, const std::string& name) {
  try {
    auto table = toml::parse(text, name);
    // A line break in the value would open a second assignment.
    return table.size() == 1 && text.find('\n') == std::string::npos ? std::optional(std::move(table))
                                                                     : std::nullopt;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::value<std::string>(text);
  return out.str();
}

// The assignment as a document of one line: tables down to the key, and the value.
toml::table parse_assignment(const std::string& assignment, const std::string& name) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) fail(name, "key=value expected");
  const std::string key = assignment.substr(0, equals), value = assignment.substr(equals + 1);
  check_toml(key + " = " + value, shortened(name), 0);
  if (auto typed = try_parse(key + " = " + value, name)) return std::move(*typed);
  if (auto text = try_parse(key + " = " + quoted(value), name)) return std::move(*text);
  fail(name, "'" + key + "' is not a key like mesh.frame or motion.0.rate");
}

// The tables that stand for the dots of a key, not those that are values.
bool is_path(const toml::node& node) {
  return node.is_table() && !node.as_table()->is_inline();
}

void merge_table(toml::table& target, toml::table& change, const std::string& path, const std::string& name);

size_t list_index(const toml::key& key, size_t size, const std::string& path, const std::string& name) {
  const std::string_view text = key.str();
  size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error == std::errc{} && end == text.data() + text.size() && index <= size) return index;
  fail(name, path + " is a list of " + std::to_string(size) + ", a number from 0 to " + std::to_string(size) +
                 " expected instead of '" + std::string(text) + "'");
}

void merge_list(toml::array& target, toml::table& change, const std::string& path, const std::string& name) {
  const auto only = change.begin();
  const toml::key& key = only->first;
  toml::node& node = only->second;
  const size_t index = list_index(key, target.size(), path, name);
  const std::string here = path + "." + std::string(key.str());
  if (!is_path(node)) {
    if (index < target.size()) target.erase(target.begin() + static_cast<std::ptrdiff_t>(index));
    target.insert(target.begin() + static_cast<std::ptrdiff_t>(index), std::move(node));
    return;
  }
  if (index == target.size()) target.push_back(toml::table{});
  if (!target[index].is_table()) fail(name, here + " is not a table");
  merge_table(*target[index].as_table(), *node.as_table(), here, name);
}

void merge_table(toml::table& target, toml::table& change, const std::string& path, const std::string& name) {
  const auto only = change.begin();
  const toml::key& key = only->first;
  toml::node& node = only->second;
  const std::string here = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
  toml::node* existing = target.get(key.str());
  if (!existing || !is_path(node)) {
    target.erase(key.str());  // so that the key, too, is from the override
    target.insert(key, std::move(node));
  } else if (existing->is_table()) {
    merge_table(*existing->as_table(), *node.as_table(), here, name);
  } else if (existing->is_array()) {
    merge_list(*existing->as_array(), *node.as_table(), here, name);
  } else {
    fail(name, here + " is neither a table nor a list");
  }
}

}  // namespace

void apply_override(toml::table& scenario, const std::string& assignment) {
  const std::string name = "--set " + assignment;
  auto change = parse_assignment(assignment, name);
  merge_table(scenario, change, "", name);
}

}  // namespace kinemesh
