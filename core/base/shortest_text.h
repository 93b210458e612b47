// Numbers in messages.
#pragma once

#include <charconv>
#include <string>

namespace kinemesh {

// The shortest that reads back as the same number.
inline std::string shortest_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace kinemesh
