#include "kinemesh/mesh_io.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/atomic_file.h"
#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/writable.h"
#include "kinemesh/svg.h"
#include "kinemesh/vtu.h"

namespace kinemesh {
namespace {

constexpr std::array<FormatInfo, 7> all_formats{{
    {Format::Off, "off", ".off", true, true, "Object File Format"},
    {Format::Obj, "obj", ".obj", true, true, "Wavefront"},
    {Format::Ply, "ply", ".ply", true, true, "Polygon File Format, ASCII"},
    {Format::Su2, "su2", ".su2", true, true, "SU2, with markers"},
    {Format::Gmsh, "gmsh", ".msh", true, true,
     "Gmsh 2.2 and 4.1 ASCII, with physical groups as markers and labels; written as 2.2"},
    {Format::Vtu, "vtu", ".vtu", true, true, "VTK unstructured grid, with labels and markers"},
    {Format::Svg, "svg", ".svg", false, true, "drawing, with inverted faces marked"},
}};

const FormatInfo& info(Format format) {
  return all_formats[static_cast<std::size_t>(format)];
}

std::string known_extensions(bool FormatInfo::*able) {
  std::string list;
  for (const FormatInfo& f : all_formats) {
    if (f.*able) list += (list.empty() ? "" : " ") + std::string(f.extension);
  }
  return list;
}

Format require_format(const std::filesystem::path& path, bool FormatInfo::*able) {
  const std::optional<Format> format = format_of(path);
  if (format && info(*format).*able) return *format;
  const std::string extension = path.extension().string();
  throw InputError(
      path.string(), 0,
      (extension.empty() ? "has no extension" : "has the extension " + io::in_quotes(extension)) +
          ", expected one of " + known_extensions(able));
}

}  // namespace

std::span<const FormatInfo> formats() {
  return all_formats;
}

std::optional<Format> format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::transform(extension.begin(), extension.end(), extension.begin(), lower);
  for (const FormatInfo& f : all_formats) {
    if (f.extension == extension) return f.format;
  }
  return std::nullopt;
}

bool keeps_labels(Format format) {
  return format == Format::Gmsh || format == Format::Vtu;
}
bool keeps_markers(Format format) {
  return format == Format::Su2 || keeps_labels(format);
}

ReadResult parse_mesh(std::string_view text, Format format, const std::string& name,
                      const ReadOptions& options) {
  if (text.empty()) throw InputError(name, 0, "is empty, expected a mesh");
  switch (format) {
    case Format::Off:
      return io::read_off(text, name, options);
    case Format::Obj:
      return io::read_obj(text, name, options);
    case Format::Ply:
      return io::read_ply(text, name, options);
    case Format::Su2:
      return io::read_su2(text, name, options);
    case Format::Gmsh:
      return io::read_gmsh(text, name, options);
    case Format::Vtu:
      return io::read_vtu(text, name, options);
    case Format::Svg:
      break;
  }
  throw InputError(name, 0, "is a drawing, expected a mesh");
}

ReadResult read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  const Format format = require_format(path, &FormatInfo::can_read);
  return parse_mesh(read_file(path), format, path.string(), options);
}

std::string format_mesh(const MeshData& mesh, Format format) {
  io::check_writable(mesh);
  switch (format) {
    case Format::Off:
      return io::write_off(mesh);
    case Format::Obj:
      return io::write_obj(mesh);
    case Format::Ply:
      return io::write_ply(mesh);
    case Format::Su2:
      return io::write_su2(mesh);
    case Format::Gmsh:
      return io::write_gmsh(mesh);
    case Format::Vtu:
      return format_vtu(mesh);
    case Format::Svg:
      break;
  }
  return format_svg(mesh);
}

void write_mesh(const std::filesystem::path& path, const MeshData& mesh) {
  const Format format = require_format(path, &FormatInfo::can_write);
  io::write_content(follow_links(path), [&] { return format_mesh(mesh, format); });
}

}  // namespace kinemesh
