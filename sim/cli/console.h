// Lines on stderr, in the one form that users and scripts can rely on.
#pragma once

#include <cstddef>
#include <string>

namespace kinemesh::cli {

// `text` as it is, at once. Does not throw: whether anybody can read it must not change what a run does.
void say(const std::string& text) noexcept;

// "kinemesh: MESSAGE"; line breaks within become spaces, so that it stays one line.
void print_error(const std::string& message);

// "kinemesh: note: MESSAGE".
void print_note(const std::string& message);

// Whether stderr is a terminal that can rewrite its last line, and one that wants colours
// (https://no-color.org).
bool has_live_line();
bool has_colour();
std::size_t live_line_width();  // characters that fit into it; more would wrap and stay

}  // namespace kinemesh::cli
