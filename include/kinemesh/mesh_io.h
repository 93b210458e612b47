// Mesh files in and out. Coordinates keep every bit: what is written and read again compares equal, -0 and
// denormals included. What a reader cannot represent is refused with file, line and reason; nothing is
// dropped without a note.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

enum class Format { Off, Obj, Ply, Su2, Gmsh, Vtu, Svg };

struct FormatInfo {
  Format format;
  std::string_view name;
  std::string_view extension;  // with its dot, lower case
  bool can_read, can_write;
  std::string_view description;
};

std::span<const FormatInfo> formats();
std::optional<Format> format_of(const std::filesystem::path& path);  // by extension, upper or lower case
bool keeps_labels(Format format);                                    // others write every face alike
bool keeps_markers(Format format);                                   // others leave them out

struct ReadOptions {
  bool split_quads =
      false;  // along the diagonal whose worse triangle is better; otherwise quadrilaterals are refused
};

struct ReadResult {
  MeshData mesh;                   // consistently wound, see kinemesh/orient.h; at least one triangle
  std::vector<std::string> notes;  // what was changed or left out, for the user
};

// Reads a file by its extension. Throws InputError(file, line, what).
ReadResult read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from memory; `name` stands for the file in errors.
ReadResult parse_mesh(std::string_view text, Format format, const std::string& name,
                      const ReadOptions& options = {});

// Writes a file by its extension, whole or not at all (core/io/atomic_file.h); where `path` is a symbolic
// link, the file it leads to. Throws InputError; also for what no reader would take back: numbers out of
// range, non-finite coordinates, marker names the format cannot spell.
void write_mesh(const std::filesystem::path& path, const MeshData& mesh);

// The content that write_mesh gives a file.
std::string format_mesh(const MeshData& mesh, Format format);

}  // namespace kinemesh
#pragma GCC visibility pop
