// VTK's XML files for unstructured grids (.vtu) and their time series (.pvd), as ParaView and meshio read
// them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// What a time step knows beyond its mesh. Empty spans are left out of the file.
struct VtuFields {
  std::optional<double> time = {};  // TimeValue, the user's time unit
  // Per vertex, the user's length unit; written with a third component 0.
  std::span<const Point> displacement = {};
  std::span<const std::uint8_t> replaced = {};  // per face: 1 if replaced since the file before
  std::span<const int> region = {};             // per face: number of the region that replaced it, or none
};

// Version 1.0, appended raw data, Float64 points. The labels are cell data `label` (Int32), always there;
// markers are field data `marker:NAME` (Int32, pairs of vertex numbers), names of labels are field data
// `label_name:NAME` (Int32). Whole or not at all. Throws InputError: unwritable, non-finite, numbers out of
// range, a span of another length.
void write_vtu(const std::filesystem::path& path, const MeshData& mesh, const VtuFields& fields = {});
std::string format_vtu(const MeshData& mesh, const VtuFields& fields = {});

struct PvdEntry {
  double time;
  std::string file;  // relative to the .pvd
};

// The series, in the order given. Whole or not at all. Throws InputError if unwritable.
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);

}  // namespace kinemesh
#pragma GCC visibility pop
