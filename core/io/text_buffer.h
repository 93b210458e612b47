// Text for files, fast: numbers in the shortest form that reads back to the same bits.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace kinemesh::io {

class TextBuffer {
 public:
  explicit TextBuffer(std::size_t expected_bytes = 0) { text_.reserve(expected_bytes); }

  TextBuffer& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  TextBuffer& operator<<(char c) {
    text_ += c;
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> TextBuffer& operator<<(Number number) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
    return *this;
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace kinemesh::io
