// A drawing of a mesh: upright faces light, by label; replaced ones amber; inverted and flat ones red;
// constrained edges dark. y points up. Lines keep their width on screen however far one zooms in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

struct ViewBox {
  Point lower, upper;  // the user's length unit
};

struct SvgOptions {
  std::span<const std::uint8_t> replaced = {};  // per face, or empty
  std::string replaced_label = "replaced";      // in the legend, behind their number
  double width = 1000.0;                        // of the drawing, in pixels; the height follows
  std::optional<ViewBox> view = {};             // default: the whole mesh
  std::string title = {};                       // above the drawing; empty: none
  bool draw_edges = true;  // false: only constrained edges and the outlines of marked faces
};

// Borders, interfaces between labels and markers count as constrained. Faces outside the view are left out.
// Throws InputError: unwritable, non-finite, numbers out of range, a span of another length.
void write_svg(const std::filesystem::path& path, const MeshData& mesh, const SvgOptions& options = {});
std::string format_svg(const MeshData& mesh, const SvgOptions& options = {});

}  // namespace kinemesh
#pragma GCC visibility pop
