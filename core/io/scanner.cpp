#include "core/io/scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "kinemesh/mesh_data.h"

namespace kinemesh::io {
namespace {

// The comparison first that nearly all characters pass.
bool is_blank(char c) {
  return c <= ' ' && (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f');
}
bool ends_word(char c) {
  return is_blank(c) || c == '\n';
}

// from_chars takes no plus sign, and none may hide a second sign.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

// Whether a number that no double can hold is too large rather than too small: by its decimal exponent.
bool is_too_large(std::string_view word) {
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const std::string_view digits = word.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const auto magnitude = static_cast<long long>(point) - static_cast<long long>(first);
  if (e == word.size()) return magnitude > 0;
  std::string_view exponent = without_plus(word.substr(e + 1));
  long long value = 0;
  if (std::from_chars(exponent.begin(), exponent.end(), value).ec == std::errc::result_out_of_range) {
    return exponent[0] != '-';
  }
  return value > -magnitude;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (char c : word.substr(0, longest)) {
    if (c >= ' ' && c <= '~') {
      text += c;
    } else {
      constexpr char hex[] = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      text += {'\\', 'x', hex[byte >> 4], hex[byte & 15]};
    }
  }
  return text + (word.size() > longest ? "...'" : "'");
}

double to_number(std::string_view word, const char* what) {
  const std::string_view digits = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
  if (error == std::errc::invalid_argument || end != digits.end()) {
    throw InputError(in_quotes(word) + " is not a number, expected " + what);
  }
  if (error == std::errc::result_out_of_range) {
    if (is_too_large(digits))
      throw InputError(in_quotes(word) + " is larger than any double, expected " + what);
    return digits[0] == '-' ? -0.0 : 0.0;
  }
  if (!std::isfinite(value)) throw InputError(in_quotes(word) + " is not finite, expected " + what);
  return value;
}

long long to_integer(std::string_view word, const char* what) {
  const std::string_view digits = without_plus(word);
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
  if (error == std::errc::invalid_argument || end != digits.end()) {
    throw InputError(in_quotes(word) + " is not a whole number, expected " + what);
  }
  if (error == std::errc::result_out_of_range)
    throw InputError(in_quotes(word) + " is out of range, expected " + what);
  return value;
}

Scanner::Scanner(std::string_view text, std::string file, char comment, int first_line)
    : at_(text.data()),
      end_(text.data() + text.size()),
      file_(std::move(file)),
      comment_(comment),
      line_(first_line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.substr(0, 3) == byte_order_mark) at_ += 3;
}

void Scanner::fail(const std::string& what) const {
  throw InputError(file_, line_, what);
}

void Scanner::skip_blanks() {
  while (at_ != end_ && is_blank(*at_)) ++at_;
}

std::string_view Scanner::take_word() {
  const char* begin = at_;
  while (at_ != end_ && !ends_word(*at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

// A number as nearly all are, the whole next word, finite and in range. Otherwise nothing is taken.
template <class Number>
bool Scanner::take_plain(Number& value) {
  if (at_end()) return false;
  const auto [end, error] = std::from_chars(at_, end_, value);
  if (error != std::errc() || !std::isfinite(value) || (end != end_ && !ends_word(*end))) return false;
  at_ = end;
  return true;
}

bool Scanner::at_end() {
  if (at_ != end_ && *at_ > ' ' && !is_comment()) return false;  // the way it nearly always is
  for (;;) {
    skip_blanks();
    if (at_ == end_) return true;
    if (is_comment()) {
      skip_line();
    } else if (*at_ == '\n') {
      ++at_;
      ++line_;
    } else {
      return false;
    }
  }
}

std::string_view Scanner::word(const char* what) {
  if (at_end()) fail(std::string("the file ends, expected ") + what);
  return take_word();
}

double Scanner::number(const char* what) {
  if (double value; take_plain(value)) return value;
  const std::string_view digits = word(what);
  try {
    return to_number(digits, what);
  } catch (const InputError& error) {
    fail(error.what());
  }
}

long long Scanner::long_integer(const char* what) {
  if (long long value; take_plain(value)) return value;
  const std::string_view digits = word(what);
  try {
    return to_integer(digits, what);
  } catch (const InputError& error) {
    fail(error.what());
  }
}

int Scanner::integer(const char* what) {
  if (int plain; take_plain(plain)) return plain;
  const long long value = long_integer(what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    fail("'" + std::to_string(value) + "' is out of range, expected " + what);
  }
  return static_cast<int>(value);
}

int Scanner::count(const char* what, std::size_t bytes_each) {
  const long long value = long_integer(what);
  check_count(value, what, bytes_each);
  return static_cast<int>(value);
}

void Scanner::check_count(long long n, const char* what, std::size_t bytes_each) const {
  if (n < 0) fail(std::to_string(n) + " is negative, expected " + what);
  if (n > most_items)
    fail(std::to_string(n) + " is more than " + std::to_string(most_items) + ", the largest " + what);
  if (static_cast<std::size_t>(n) > bytes_left() / bytes_each + 1) {
    fail(std::to_string(n) + " as " + what + " is more than the rest of the file can hold");
  }
}

void Scanner::expect_end(const char* what) {
  if (!at_end())
    fail("unexpected " + in_quotes(take_word()) + " after " + what + ", expected the end of the file");
}

bool Scanner::at_line_end() {
  skip_blanks();
  return at_ == end_ || *at_ == '\n' || is_comment();
}

double Scanner::number_here(const char* what) {
  if (at_line_end()) fail(std::string("the line ends, expected ") + what);
  return number(what);
}

int Scanner::integer_here(const char* what) {
  if (at_line_end()) fail(std::string("the line ends, expected ") + what);
  return integer(what);
}

void Scanner::expect_line_end(const char* what) {
  if (!at_line_end())
    fail("unexpected " + in_quotes(take_word()) + " after " + what + ", expected the end of the line");
}

void Scanner::skip_line() {
  at_ = std::find(at_, end_, '\n');
}

bool Scanner::next_line() {
  skip_line();
  if (at_ == end_) return false;
  ++at_;
  ++line_;
  return true;
}

Scanner Scanner::within(std::string_view text, int lines_down) const {
  Scanner part = *this;
  part.at_ = text.data();
  part.end_ = text.data() + text.size();
  part.line_ += lines_down;
  return part;
}

Scanner Scanner::at_end_of(std::string_view lines, int n) const {
  Scanner result = *this;
  result.at_ = lines.data() + lines.size() - lines.ends_with('\n');
  result.line_ += n - 1;
  return result;
}

std::string_view Scanner::rest_of_line() {
  skip_blanks();
  const char* begin = at_;
  while (at_ != end_ && *at_ != '\n' && !is_comment()) ++at_;
  const char* last = at_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

}  // namespace kinemesh::io
