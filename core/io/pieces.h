// Text in pieces that are read at the same time. Where one of them is refused the caller reads it all again
// from front to back, and so names the first mistake. For .cpp files: brings TBB.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/io/scanner.h"

namespace kinemesh::io {

// Some of a text's lines, numbered from 0.
struct Lines {
  std::string_view text;
  int first, end;
};

// The first n lines of a text; nothing if it has fewer.
std::vector<Lines> cut_lines(std::string_view text, int n);

// The whole text, cut between words.
std::vector<std::string_view> cut_words(std::string_view text);

// Calls read(i) for the pieces 0 to n - 1; whether none of them has thrown an InputError.
template <class Read>
bool read_pieces(std::size_t n, const Read& read) {
  std::atomic<bool> good{true};
  parallel_parts(static_cast<int>(n), 1, [&](int, int begin, int end) {
    try {
      for (int i = begin; i < end && good; ++i) read(i);
    } catch (const InputError&) {
      good = false;
    }
  });
  return good;
}

// Where the next n lines hold one thing each, of which read(scanner, i) reads number i: takes them all. False
// where they do not; nothing is taken then, but read has been called.
template <class Read>
bool read_lines(Scanner& scanner, int n, const Read& read) {
  Scanner ahead = scanner;
  if (!ahead.next_line()) return false;
  const auto pieces = cut_lines(ahead.rest(), n);
  const auto read_piece = [&](int piece) {
    const auto& [text, first, end] = pieces[piece];
    Scanner part = ahead.within(text, first);
    for (int i = first; i < end; ++i) read(part, i);
    part.expect_end("the last line");
  };
  if (pieces.empty() || !read_pieces(pieces.size(), read_piece)) return false;
  scanner = ahead.at_end_of(pieces.back().text, n);
  return true;
}

// All numbers of a text, each taken by read(scanner); nothing where it throws.
template <class Number, class Read>
std::optional<std::vector<Number>> read_numbers(const Scanner& scanner, const Read& read) {
  const auto texts = cut_words(scanner.rest());
  std::vector<std::vector<Number>> parts(texts.size());
  const auto read_piece = [&](int piece) {
    Scanner part = scanner.within(texts[piece], 0);
    while (!part.at_end()) parts[piece].push_back(read(part));
  };
  if (!read_pieces(texts.size(), read_piece)) return std::nullopt;
  std::size_t n = 0;
  for (const auto& part : parts) n += part.size();
  std::vector<Number> numbers;
  numbers.reserve(n);
  for (const auto& part : parts) numbers.insert(numbers.end(), part.begin(), part.end());
  return numbers;
}

}  // namespace kinemesh::io
