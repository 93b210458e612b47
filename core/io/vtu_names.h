// What our arrays in a VTU file are called.
#pragma once

#include <string_view>

namespace kinemesh::io {

inline constexpr const char* label_name = "label";
inline constexpr std::string_view marker_prefix = "marker:";
inline constexpr std::string_view label_name_prefix = "label_name:";

}  // namespace kinemesh::io
