#include "sim/cli/console.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/base/printable.h"

namespace kinemesh::cli {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

void say(const std::string& text) noexcept {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void print_error(const std::string& message) {
  say("kinemesh: " + printable(message.substr(0, message.find_last_not_of('\n') + 1)) + "\n");
}

void print_note(const std::string& message) {
  print_error("note: " + message);
}

void print_line(const std::string& line) {
  fmt::print("{}\n", printable(line));
}

// What cannot be shown is spelt out, as bash, zsh and others read it within $'...'.
std::string shell_word(const std::string& text) {
  const bool is_plain = printable(text) == text;
  std::string word = is_plain ? "'" : "$'";
  for (const char c : text) {
    if (c == '\'')
      word += is_plain ? "'\\''" : "\\'";
    else if (is_plain)
      word += c;
    else if (c == '\\')
      word += "\\\\";
    else
      word +=
          c >= ' ' && c < 0x7f ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return word + "'";
}

bool has_live_line() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

bool has_colour() {
  return has_live_line() && !is_set("NO_COLOR");
}

std::size_t live_line_width() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col - 1u : std::string::npos;
}

}  // namespace kinemesh::cli
