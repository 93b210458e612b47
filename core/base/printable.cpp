#include "core/base/printable.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/utf8.h"

namespace kinemesh {
namespace {

// Besides the noncharacters at the end of each plane, first and last.
constexpr std::array<std::pair<char32_t, char32_t>, 9> hidden{{{0x00, 0x1F},  // controls
                                                               {0x7F, 0x9F},
                                                               {0x061C, 0x061C},  // direction
                                                               {0x200E, 0x200F},
                                                               {0x2028, 0x202E},  // separators, direction
                                                               {0x2066, 0x2069},
                                                               {0xFDD0, 0xFDEF},    // noncharacters
                                                               {0xFEFF, 0xFEFF},    // mark of byte order
                                                               {0xFFF9, 0xFFFB}}};  // annotations

bool is_hidden(char32_t character) {
  return (character & 0xFFFE) == 0xFFFE || std::ranges::any_of(hidden, [&](const auto& range) {
           return range.first <= character && character <= range.second;
         });
}

std::string escape(char kind, char32_t value, int digits) {
  std::string text{'\\', kind};
  while (digits-- > 0) text += "0123456789abcdef"[value >> 4 * digits & 0xF];
  return text;
}

std::string escaped(char32_t character) {
  if (character == '\n') return "\\n";
  if (character == '\r') return "\\r";
  if (character == '\t') return "\\t";
  if (character < 0x80) return escape('x', character, 2);
  return character <= 0xFFFF ? escape('u', character, 4) : escape('U', character, 8);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view one = text.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0)
      result += escape('x', static_cast<unsigned char>(one[0]), 2);
    else if (const char32_t character = utf8_character(one); is_hidden(character))
      result += escaped(character);
    else
      result += one;
    text.remove_prefix(one.size());
  }
  return result;
}

std::string printable(std::string_view text, std::size_t most) {
  const std::string whole = printable(text);
  std::size_t end = 0;
  for (; most > 0 && end < whole.size(); --most) end += utf8_length(std::string_view(whole).substr(end));
  return end < whole.size() ? whole.substr(0, end) + "..." : whole;
}

}  // namespace kinemesh
