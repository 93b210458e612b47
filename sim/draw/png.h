// SVG to pixels, by librsvg.
#pragma once

#include <string>
#include <string_view>

namespace kinemesh::draw {

inline constexpr int most_pixels = 100'000'000;     // each takes 4 bytes of memory
inline constexpr int most_svg_bytes = 100'000'000;  // each takes librsvg 15 bytes of memory

// A PNG of the drawing at its own size. Throws InputError: too much of either, or librsvg's own reason.
std::string png_of(std::string_view svg);

}  // namespace kinemesh::draw
