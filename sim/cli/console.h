// Lines on stderr, in the one form that users and scripts can rely on, and lines on stdout for people.
#pragma once

#include <cstddef>
#include <string>

namespace kinemesh::cli {

// `text` as it is, at once. Does not throw: whether anybody can read it must not change what a run does.
void say(const std::string& text) noexcept;

// "kinemesh: MESSAGE", made printable (core/base/printable.h), so that it is one line whatever is in it.
void print_error(const std::string& message);

// "kinemesh: note: MESSAGE".
void print_note(const std::string& message);

// A line of a table or summary on stdout, made printable. Throws std::system_error where it cannot be
// written.
void print_line(const std::string& line);

// A word for the user's shell that reads as `text`, whatever is in it.
std::string shell_word(const std::string& text);

// Whether stderr is a terminal that can rewrite its last line, and one that wants colours
// (https://no-color.org).
bool has_live_line();
bool has_colour();
std::size_t live_line_width();  // characters that fit into it; more would wrap and stay

}  // namespace kinemesh::cli
