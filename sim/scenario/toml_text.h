// TOML as text: what is looked at before the parser, which recurses and takes memory for every value, sees
// it. Internal to sim/.
#pragma once

#include <string>
#include <string_view>

namespace kinemesh {

// Tables may be nested and names dotted so deep, those of headers, keys and inline values together.
inline constexpr int deepest_table = 256;

// Throws InputError with the line for text that is nested deeper, has more tables that only dots make than
// any scenario, or so many values that they would take far more memory than the text. What else is wrong is
// the parser's to say. Cost: O(n).
void check_toml(std::string_view text, const std::string& file, int first_line = 1);

}  // namespace kinemesh
