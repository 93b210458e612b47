#include "motion/fields/csv.h"

#include <algorithm>
#include <string_view>

namespace kinemesh {

std::string without_commas(std::string csv) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF", blanks = " \t\r\n";
  std::ranges::replace(csv, ',', ' ');
  const auto is_blank = [&](std::size_t i) { return i == csv.size() || blanks.find(csv[i]) != blanks.npos; };
  const std::size_t first = csv.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  for (auto begin = csv.find('"', first); begin != csv.npos; begin = csv.find('"', begin + 1)) {
    const auto end = csv.find_first_of("\" \t\r\n", begin + 1);
    if (end == csv.npos) break;
    const bool is_cell = csv[end] == '"' && is_blank(end + 1) && (begin == first || is_blank(begin - 1));
    if (is_cell) csv[begin] = csv[end] = ' ';
  }
  return csv;
}

}  // namespace kinemesh
