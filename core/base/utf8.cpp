#include "core/base/utf8.h"

#include <algorithm>

namespace kinemesh {
namespace {

unsigned char byte(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

}  // namespace

// [Unicode 2022, table 3-7]
std::size_t utf8_length(std::string_view text) {
  const unsigned char first = byte(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  const unsigned char lowest = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char highest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(text, 1) < lowest || byte(text, 1) > highest) return 0;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), continues) ? length
                                                                                                      : 0;
}

char32_t utf8_character(std::string_view text) {
  const std::size_t n = text.size();
  char32_t character = n == 1 ? byte(text, 0) : byte(text, 0) & (0x7Fu >> n);
  for (std::size_t i = 1; i < n; ++i) character = character << 6 | (byte(text, i) & 0x3Fu);
  return character;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace kinemesh
