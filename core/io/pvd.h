// ParaView's time series of meshes (.pvd), read; core/io/vtu.h writes them.
#pragma once

#include <filesystem>
#include <vector>

#include "core/io/vtu.h"

namespace kinemesh {

// At least one entry, times ascending. Throws InputError with file and line.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace kinemesh
