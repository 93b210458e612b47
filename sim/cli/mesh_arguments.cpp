#include "sim/cli/mesh_arguments.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "kinemesh/mesh_io.h"
#include "sim/cli/console.h"

namespace kinemesh::cli {
namespace {

std::string writable_extensions() {
  std::string list;
  for (const FormatInfo& info : formats())
    if (info.can_write) list += (list.empty() ? "" : " ") + std::string(info.extension);
  return list;
}

bool can_write(Format format) {
  const auto all = formats();
  return std::any_of(all.begin(), all.end(),
                     [&](const FormatInfo& info) { return info.format == format && info.can_write; });
}

bool has_labels(const MeshData& data) {
  return std::any_of(data.labels.begin(), data.labels.end(), [](int label) { return label != 0; });
}

}  // namespace

void add_mesh_input(CLI::App& command, MeshInput& input, const std::string& name) {
  command.add_option(name, input.path, "Mesh to read; `kinemesh list` names the formats")->required();
  command.add_flag("--split-quads", input.split_quads, "Cut quadrilaterals in two instead of refusing them");
}

MeshData read(const MeshInput& input) {
  ReadResult result = read_mesh(input.path, {.split_quads = input.split_quads});
  for (const std::string& note : result.notes) print_note(note);
  return std::move(result.mesh);
}

Mesh build(const MeshInput& input, const MeshData& data) try {
  return build_mesh(data);
} catch (const NoEmbedding&) {
  throw;
} catch (const InputError& error) {
  if (!error.file().empty()) throw;
  throw InputError(input.path, 0, error.what());
}

void require_writable(const std::string& path) {
  const auto format = format_of(path);
  if (format && can_write(*format)) return;
  const std::string extension = std::filesystem::path(path).extension().string();
  throw InputError(path, 0,
                   fmt::format("cannot write {}, expected one of {}",
                               extension.empty() ? "a file without extension" : extension + " files",
                               writable_extensions()));
}

void note_losses(const std::string& path, const MeshData& data) {
  const Format format = *format_of(path);
  const bool loses_labels = has_labels(data) && !keeps_labels(format);
  const bool loses_markers = !data.markers.empty() && !keeps_markers(format);
  if (!loses_labels && !loses_markers) return;
  print_note(fmt::format("{}: this format keeps no {}", path,
                         loses_labels && loses_markers ? "labels and no markers"
                         : loses_labels                ? "labels"
                                                       : "markers"));
}

}  // namespace kinemesh::cli
