// SVG to pixels, by librsvg.
#pragma once

#include <string>
#include <string_view>

namespace kinemesh::draw {

// A PNG of the drawing at its own size. Throws InputError: too big to be drawn, or librsvg's own reason.
std::string png_of(std::string_view svg);

}  // namespace kinemesh::draw
