#include "tests/fuzz/mutants.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

namespace kinemesh {
namespace {

struct Span {
  std::size_t begin, length;
};

constexpr std::array hostile_numbers{"0",
                                     "-0",
                                     "1",
                                     "-1",
                                     "2",
                                     "3",
                                     "+1",
                                     "nan",
                                     "-nan",
                                     "inf",
                                     "-inf",
                                     "1e400",
                                     "-1e400",
                                     "1e-400",
                                     "1e308",
                                     "0.5",
                                     "1.5.5",
                                     "0x10",
                                     "255",
                                     "256",
                                     "65536",
                                     "2147483647",
                                     "-2147483648",
                                     "2147483648",
                                     "268435455",
                                     "4294967295",
                                     "4294967296",
                                     "9223372036854775807",
                                     "-9223372036854775808",
                                     "18446744073709551615",
                                     "1000000000",
                                     "1e9",
                                     ""};

bool is_in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '-' || c == '+' || c == '$';
}

std::vector<Span> words_of(std::string_view text) {
  std::vector<Span> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    while (i < text.size() && is_in_word(text[i])) ++i;
    if (i > begin) words.push_back({begin, i - begin});
    i += i == begin;
  }
  return words;
}

std::vector<Span> numbers_of(std::string_view text) {
  std::vector<Span> words = words_of(text);
  std::erase_if(words, [&](const Span& w) {
    const char c = text[w.begin], next = w.length > 1 ? text[w.begin + 1] : '0';
    const bool has_sign = c == '-' || c == '+';
    return !(c >= '0' && c <= '9') && !(has_sign && next >= '0' && next <= '9');
  });
  return words;
}

std::vector<Span> lines_of(std::string_view text) {
  std::vector<Span> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    lines.push_back({begin, end - begin});
    begin = end;
  }
  return lines;
}

std::string text_of(std::string_view text, const Span& span) {
  return std::string(text.substr(span.begin, span.length));
}

std::string one_more_or_less(const std::string& number, Dice& dice) {
  std::int32_t value = 0;
  const auto end = std::from_chars(number.data(), number.data() + number.size(), value).ptr;
  if (end != number.data() + number.size()) return number + "1";
  const auto by = static_cast<std::int64_t>(1 + dice.below(2));
  return std::to_string(dice.one_in(2) ? value + by : value - by);
}

void change_number(std::string& text, Dice& dice) {
  const auto numbers = numbers_of(text);
  if (numbers.empty()) return;
  const Span at = dice.one_of(numbers);
  const std::string before = text_of(text, at);
  const std::string after = dice.one_in(3)   ? one_more_or_less(before, dice)
                            : dice.one_in(2) ? text_of(text, dice.one_of(numbers))
                                             : std::string(dice.one_of(hostile_numbers));
  text.replace(at.begin, at.length, after);
}

void repeat_word(std::string& text, Dice& dice) {
  const auto words = words_of(text);
  if (words.empty()) return;
  const std::string word = text_of(text, dice.one_of(words));
  const Span at = dice.one_of(words);
  text.replace(at.begin, at.length, word);
}

// Some lines that follow each other: a section, or a part of one.
Span some_lines(const std::vector<Span>& lines, Dice& dice) {
  const std::size_t first = dice.below(lines.size());
  const std::size_t n = std::min(lines.size() - first, 1 + (dice.one_in(3) ? dice.below(20) : dice.below(2)));
  const Span& last = lines[first + n - 1];
  return {lines[first].begin, last.begin + last.length - lines[first].begin};
}

void move_lines(std::string& text, Dice& dice) {
  const auto lines = lines_of(text);
  if (lines.empty()) return;
  const Span from = some_lines(lines, dice);
  const std::string taken = text_of(text, from);
  const std::size_t to = dice.one_of(lines).begin;
  const std::size_t what = dice.below(3);
  if (what != 0) text.insert(to, taken);  // doubled
  if (what != 1) text.erase(from.begin + (what == 2 && to <= from.begin ? taken.size() : 0), from.length);
}

void cut_off(std::string& text, Dice& dice) {
  text.resize(dice.below(text.size() + 1));
}

void flip_byte(std::string& text, Dice& dice) {
  if (text.empty()) return;
  constexpr std::string_view characters = " \n\t\"'#%=[]{}<>/,.:;&$-0123456789";
  char& c = text[dice.below(text.size())];
  c = dice.one_in(2) ? dice.one_of(characters) : static_cast<char>(dice.next());
}

void copy_piece(std::string& text, Dice& dice) {
  const std::size_t from = dice.below(text.size()),
                    length = dice.below(std::min<std::size_t>(text.size(), 40));
  const std::string piece = text.substr(from, length);
  text.insert(dice.below(text.size() + 1), piece);
}

// Deep, long and many: what is cheap to write and dear to read.
void repeat_character(std::string& text, Dice& dice) {
  constexpr std::string_view characters = "[{(.,<\"'\n 0a";
  text.insert(dice.below(text.size() + 1), dice.below(2000), dice.one_of(characters));
}

template <class Number>
void put(std::string& bytes, std::size_t at, Number value) {
  if (at + sizeof value <= bytes.size()) std::memcpy(bytes.data() + at, &value, sizeof value);
}

void overwrite_integer(std::string& bytes, Dice& dice) {
  constexpr std::array<std::uint64_t, 16> values{
      0,          1,           2,          3,          255,        256,        0x7fffffff, 0x80000000,
      0xffffffff, 0x100000000, 1ULL << 40, 1ULL << 61, 1ULL << 62, ~0ULL >> 1, 1ULL << 63, ~0ULL};
  const std::size_t at = dice.below(bytes.size()) / 4 * 4 + (dice.one_in(4) ? dice.below(4) : 0);
  std::uint64_t value = dice.one_of(values);
  if (dice.one_in(2) && at + 8 <= bytes.size()) {
    std::memcpy(&value, bytes.data() + at, 8);
    value += dice.one_in(2) ? 1 : ~0ULL;
  }
  dice.one_in(2) ? put(bytes, at, value) : put(bytes, at, static_cast<std::uint32_t>(value));
}

void overwrite_real(std::string& bytes, Dice& dice) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array values{0.0,
                              -0.0,
                              1.0,
                              -1.0,
                              1e-300,
                              1e300,
                              Limits::max(),
                              -Limits::max(),
                              Limits::denorm_min(),
                              Limits::infinity(),
                              -Limits::infinity(),
                              Limits::quiet_NaN()};
  put(bytes, dice.below(bytes.size()) / 4 * 4, dice.one_of(values));
}

void flip_bit(std::string& bytes, Dice& dice) {
  char& c = bytes[dice.below(bytes.size())];
  c = static_cast<char>(c ^ (1 << dice.below(8)));
}

void move_bytes(std::string& bytes, Dice& dice) {
  const std::size_t at = dice.below(bytes.size());
  const std::size_t n = std::min(bytes.size() - at, (1 + dice.below(8)) * (dice.one_in(2) ? 4 : 1));
  const std::string piece = bytes.substr(at, n);
  dice.one_in(2) ? void(bytes.erase(at, n)) : void(bytes.insert(dice.below(bytes.size()), piece));
}

std::size_t n_changes(Dice& dice) {
  std::size_t n = 1;
  while (n < 8 && dice.one_in(2)) ++n;
  return n;
}

}  // namespace

std::uint64_t Dice::next() {  // splitmix64
  std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

std::string mutated_text(std::string text, Dice& dice) {
  constexpr std::array changes{change_number, change_number, change_number, repeat_word,
                               move_lines,    move_lines,    flip_byte};
  constexpr std::array rare{cut_off, copy_piece, repeat_character};
  for (std::size_t n = n_changes(dice); n > 0 && !text.empty(); --n)
    (dice.one_in(10) ? dice.one_of(rare) : dice.one_of(changes))(text, dice);
  return text;
}

std::string mutated_bytes(std::string bytes, Dice& dice) {
  constexpr std::array changes{overwrite_integer, overwrite_integer, overwrite_real, flip_bit, move_bytes};
  for (std::size_t n = n_changes(dice); n > 0 && !bytes.empty(); --n)
    (dice.one_in(30) ? cut_off : dice.one_of(changes))(bytes, dice);
  return bytes;
}

}  // namespace kinemesh
