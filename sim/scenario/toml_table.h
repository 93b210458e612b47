// One table of a TOML file, read key by key: values are typed and checked, and keys nobody asked for are
// errors. Internal to sim/.
#pragma once

#include <toml++/toml.h>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/parameters.h"
#include "kinemesh/scenario.h"

namespace kinemesh {

// Where a node was written: the file, or the `--set` it came from.
Where where_of(const toml::node& node);

// ", did you mean 'x'?" for the candidate nearest to `word` if it is near, else the list of all.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

class TomlTable {
 public:
  // name: as messages call it, "[mesh]". The table must outlive this.
  TomlTable(const toml::table& table, std::string name);

  // The value, or nothing where the key is absent. Throw InputError with the place for another type or range.
  std::optional<double> number(std::string_view key);  // finite
  std::optional<double> positive(std::string_view key);
  std::optional<double> not_negative(std::string_view key);
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t from,
                                      std::int64_t to = std::numeric_limits<std::int64_t>::max());
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<std::vector<std::string>> texts(std::string_view key);  // one, or a list of some
  std::optional<ParameterValue> value(
      std::string_view key);  // a number, a text, a list of numbers or of points
  const toml::table* table(std::string_view key);
  std::vector<const toml::table*> tables(
      std::string_view key);  // [[key]] or a list of them; empty where absent

  void known(std::string_view key) { known_.emplace_back(key); }  // is read later
  bool has(std::string_view key) const { return table_.contains(key); }
  std::vector<std::string> keys() const;    // those present, in alphabetical order
  Where where() const;                      // of the table's header
  Where where(std::string_view key) const;  // of the key, or of the table where it is absent

  // Throws InputError at the first key, in the file's order, that none of the above was asked for.
  void refuse_other_keys() const;

  [[noreturn]] void fail(std::string_view key, const std::string& what) const;  // "KEY: what"

 private:
  const toml::node* find(std::string_view key);

  const toml::table& table_;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace kinemesh
