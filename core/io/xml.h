// Text for attributes and elements of XML.
#pragma once

#include <string>
#include <string_view>

#include "core/base/utf8.h"

namespace kinemesh::io {

// With & < > and quotes spelt out. What is not UTF-8 is taken for Latin-1, so that the file remains
// well-formed.
std::string xml_text(std::string_view text);

}  // namespace kinemesh::io
