// Text as UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace kinemesh {

// Bytes of the well-formed UTF-8 character that `text` begins with; 0 if it begins with none. Pre: not empty.
std::size_t utf8_length(std::string_view text);

// The number of the one character in `text`. Pre: well-formed.
char32_t utf8_character(std::string_view text);

bool is_utf8(std::string_view text);

}  // namespace kinemesh
