// ParaView's time series of meshes (.pvd), read; kinemesh/vtu.h writes them.
#pragma once

#include <filesystem>
#include <vector>

#include "kinemesh/vtu.h"

namespace kinemesh {

// At least one entry, times ascending. Throws InputError with file and line.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace kinemesh
