// One tokenizer for all text formats, over a buffer in memory. Every refusal names the file and the line.
#pragma once

#include <string>
#include <string_view>

#include "kinemesh/error.h"

namespace kinemesh::io {

class Scanner {
 public:
  // `comment` starts a comment up to the end of the line wherever a word could start; 0: the format has none.
  Scanner(std::string_view text, std::string file, char comment = 0, int first_line = 1);

  int line() const { return line_; }  // where the last word was, from 1
  const std::string& file() const { return file_; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  [[noreturn]] void fail(const std::string& what) const;  // at line()

  // Across lines. `what` says what is expected, for the refusal at the end of the file.
  bool at_end();  // nothing but blanks, line ends and comments left
  std::string_view word(const char* what);
  double number(const char* what);  // finite; "+1" is a number, what underflows is 0
  int integer(const char* what);
  long long long_integer(const char* what);
  // A count of things of which each takes at least `bytes_each` bytes of what is left: refused if they cannot
  // be there.
  int count(const char* what, std::size_t bytes_each);
  void check_count(long long n, const char* what, std::size_t bytes_each) const;
  void expect_end(const char* what);  // refuses what is left

  // Within a line.
  bool at_line_end();                    // nothing but blanks and comments left in this line
  double number_here(const char* what);  // refuses a line that ends before it
  int integer_here(const char* what);
  void expect_line_end(const char* what);  // refuses what is left in it
  void skip_line();                        // drops what is left in it
  std::string_view rest_of_line();         // trimmed, without comment
  bool next_line();                        // goes behind the end of this one; false if it has none

  // Parts of what is left (core/io/pieces.h).
  std::string_view rest() const { return {at_, bytes_left()}; }
  Scanner within(std::string_view text,
                 int lines_down) const;  // reads `text` only, so many lines further down
  Scanner at_end_of(std::string_view lines,
                    int n) const;  // behind n lines from here, before the end of the last

 private:
  void skip_blanks();
  bool is_comment() const { return comment_ != 0 && *at_ == comment_; }
  std::string_view take_word();
  template <class Number>
  bool take_plain(Number& value);

  const char* at_;
  const char* end_;
  std::string file_;
  char comment_;
  int line_;
};

// Words to numbers; the scanner supplies the place. They throw InputError without one.
double to_number(std::string_view word, const char* what);
long long to_integer(std::string_view word, const char* what);
std::string in_quotes(
    std::string_view word);  // for messages: 'word', shortened and with strange bytes as \xNN

}  // namespace kinemesh::io
