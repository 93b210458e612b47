#include "sim/scenario/toml_text.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_set>
#include <vector>

#include "kinemesh/error.h"

namespace kinemesh {
namespace {

// The parser looks them up one by one.
constexpr std::size_t most_dotted_tables = 2048;

// Bytes that the parser, and a scenario made of what it gives, take at most for what a character of structure
// announces; measured with toml++ 3.3. Tables in lists may be motions.
constexpr std::uint64_t bytes_of_value = 72, bytes_of_list = 128, bytes_of_table = 128, bytes_of_key = 176,
                        bytes_of_motion = 800;
constexpr std::uint64_t most_times = 28, most_beside = 32 << 20;  // of the text's size, and beside it

// Knows comments, the four kinds of strings, headers, keys and brackets; all else are plain characters. Where
// a text is no TOML the parser stops at the first mistake, up to which the two agree.
class TomlText {
 public:
  TomlText(std::string_view text, const std::string& file, int first_line)
      : text_(text), file_(file), line_(first_line) {}

  void check() {
    while (at_ < text_.size()) read_statement();
    if (bytes_ > most_times * text_.size() + most_beside)
      fail("so many values that they would take more than " + std::to_string(most_times) +
           " times the size of the text");
  }

 private:
  // A table by its depth and a number made of the names that lead to it.
  struct Place {
    int depth = 0;
    std::size_t path = 0;
  };
  struct Open {
    char bracket;
    Place place;  // of what is inside
  };

  char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool is_here(std::string_view characters) const {
    return characters.find(here()) != std::string_view::npos;
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, line_, what); }

  void read_statement() {
    const bool is_space = is_here(" \t\r") || static_cast<unsigned char>(here()) >= 0x80;
    if (here() == '\n') {
      next_line();
    } else if (is_space) {  // or a byte order mark
      ++at_;
    } else if (here() == '#') {
      skip_comment();
    } else if (here() == '[') {
      read_header();
    } else {
      read_value(read_key(header_));
    }
  }

  void next_line() {
    ++at_;
    ++line_;
  }
  void skip_comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  void read_header() {
    const bool is_list = here(1) == '[';
    at_ += is_list ? 2 : 1;
    const std::size_t begin = at_;
    header_ = read_key({0, new_path(is_list)});
    if (is_list) note_table(joined(0, text_.substr(begin, at_ - begin)));
    ++header_.depth;
    bytes_ += bytes_of_table + (is_list ? bytes_of_motion : 0);
    skip_comment();  // and the closing brackets
  }

  // Names with dots between, of which the last one is in the place returned, or has its path if it is a
  // table.
  Place read_key(Place place) {
    std::size_t begin = at_;
    int names = 1;
    for (; at_ < text_.size() && !is_here("=]\n#[{},"); is_here("\"'") ? skip_string() : void(++at_)) {
      if (here() != '.') continue;
      deepen(place);
      if (++names > deepest_table) refuse_depth();
      place.path = joined(place.path, text_.substr(begin, at_ - begin));
      note_table(place.path);
      begin = at_ + 1;
    }
    bytes_ += bytes_of_key;
    return {place.depth, joined(place.path, text_.substr(begin, at_ - begin))};
  }

  // Up to the end of the line in which the last bracket closes.
  void read_value(const Place& place) {
    std::vector<Open> open;
    while (at_ < text_.size() && !(open.empty() && here() == '\n')) {
      if (is_here("\"'")) {
        skip_string();
      } else if (here() == '#') {
        skip_comment();
      } else if (here() == '\n') {
        next_line();
      } else if (is_here("[]{},")) {
        read_bracket(place, open);
      } else {
        ++at_;
      }
    }
  }

  void read_bracket(const Place& outside, std::vector<Open>& open) {
    const char c = text_[at_++];
    if (c == '[' || c == '{') {
      Place inside = open.empty() ? outside : key_;
      deepen(inside);
      open.push_back({c, {inside.depth, new_path(true)}});
      bytes_ += c == '[' ? bytes_of_list : bytes_of_table + bytes_of_motion;
    } else if (c != ',') {
      if (!open.empty()) open.pop_back();
    } else {
      bytes_ += bytes_of_value;
    }
    if (open.empty()) return;
    key_ = open.back().place;
    if (open.back().bracket == '{' && (c == '{' || c == ',')) key_ = read_key(key_);
  }

  void skip_string() {
    const char quote = here();
    const bool is_long = here(1) == quote && here(2) == quote;
    at_ += is_long ? 3 : 1;
    is_long ? skip_long_string(quote) : skip_short_string(quote);
  }
  void skip_short_string(char quote) {
    while (at_ < text_.size() && here() != '\n') {
      const char c = text_[at_++];
      if (c == quote) return;
      if (c == '\\' && quote == '"' && here() != '\n') ++at_;
    }
  }
  // Up to two quotes before the three that close it belong to the string.
  void skip_long_string(char quote) {
    while (at_ < text_.size()) {
      if (here() == quote && here(1) == quote && here(2) == quote) {
        at_ += 3;
        for (int i = 0; i < 2 && here() == quote; ++i) ++at_;
        return;
      }
      if (here() == '\\' && quote == '"') ++at_;
      if (here() == '\n') ++line_;
      ++at_;
    }
  }

  void deepen(Place& place) const {
    if (++place.depth > deepest_table) refuse_depth();
  }
  [[noreturn]] void refuse_depth() const {
    fail("nested more than " + std::to_string(deepest_table) + " deep");
  }
  // Every element of a list and every inline table is one more, whatever its name.
  std::size_t new_path(bool is_new) { return lists_ += is_new; }
  static std::size_t joined(std::size_t path, std::string_view name) {
    return (path ^ std::hash<std::string_view>{}(name)) * 0x9E3779B97F4A7C15u;
  }
  void note_table(std::size_t path) {
    dotted_tables_.insert(path);
    if (dotted_tables_.size() > most_dotted_tables)
      fail("more than " + std::to_string(most_dotted_tables) + " tables that only dots or [[ ]] make");
  }

  std::string_view text_;
  const std::string& file_;
  int line_;
  std::size_t at_ = 0;
  Place header_;
  Place key_;              // the last one in brackets
  std::size_t lists_ = 0;  // elements of lists, and inline tables, so far
  std::unordered_set<std::size_t> dotted_tables_;
  std::uint64_t bytes_ = 0;  // the parser takes no more
};

}  // namespace

void check_toml(std::string_view text, const std::string& file, int first_line) {
  TomlText(text, file, first_line).check();
}

}  // namespace kinemesh
