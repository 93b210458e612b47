// Text of files and users, as it can be shown to people.
#pragma once

#include <string>
#include <string_view>

namespace kinemesh {

// On one line, without power over a terminal, and well-formed UTF-8 that XML may hold: control characters,
// line and paragraph separators, what turns the direction of text, and noncharacters become \n, \t, \r, \x1b,
// \u202e and the like, bytes that are not UTF-8 become \xe9 and the like. All else is kept, so that it
// changes nothing the second time.
std::string printable(std::string_view text);

// Likewise, but where that is longer than `most` characters, only so many and "...".
std::string printable(std::string_view text, std::size_t most);

}  // namespace kinemesh
