#include "core/io/pieces.h"

#include <algorithm>
#include <cstdint>

namespace kinemesh::io {
namespace {

constexpr std::size_t grain = 1 << 16;  // bytes that are worth a task

// About equal parts of a text, each but the last up to and with one of the characters `ends`.
std::vector<std::string_view> cut_behind(std::string_view text, std::string_view ends) {
  const std::size_t n = std::clamp<std::size_t>(text.size() / grain, 1, most_parts);
  std::vector<std::string_view> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    const std::size_t last = i == n ? text.size() : text.find_first_of(ends, text.size() / n * i);
    const std::size_t end = std::min(last, text.size() - 1) + 1;
    if (begin < end) pieces.push_back(text.substr(begin, end - begin));
    begin = std::max(begin, end);
  }
  return pieces;
}

// One that does not end counts. So few characters at a time that a byte holds their count: many bytes are
// added in one instruction then.
int count_lines(std::string_view text) {
  int n = text.back() != '\n';
  for (; !text.empty(); text.remove_prefix(std::min<std::size_t>(text.size(), 255))) {
    std::uint8_t ends = 0;
    for (const char c : text.substr(0, 255)) ends = static_cast<std::uint8_t>(ends + (c == '\n'));
    n += ends;
  }
  return n;
}

std::string_view first_lines(std::string_view text, int n) {
  std::size_t end = 0;
  for (; n > 0; --n) end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.substr(0, end);
}

}  // namespace

std::vector<Lines> cut_lines(std::string_view text, int n) {
  if (text.empty()) return {};
  const auto texts = cut_behind(text, "\n");
  std::vector<int> counts(texts.size());
  parallel_parts(static_cast<int>(texts.size()), 1, [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) counts[i] = count_lines(texts[i]);
  });
  std::vector<Lines> pieces;
  int first = 0;
  for (std::size_t i = 0; i < texts.size() && first < n; ++i) {
    const int end = std::min(first + counts[i], n);
    pieces.push_back({end < n ? texts[i] : first_lines(texts[i], end - first), first, end});
    first = end;
  }
  return first == n ? pieces : std::vector<Lines>();
}

std::vector<std::string_view> cut_words(std::string_view text) {
  if (text.empty()) return {};
  return cut_behind(text, " \t\r\v\f\n");
}

}  // namespace kinemesh::io
