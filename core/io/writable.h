// What all writers share.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "kinemesh/mesh_data.h"

namespace kinemesh::io {

// Throws InputError for what no reader would take back: numbers out of range, coordinates that are not
// finite, labels of another count than faces or the reserved one, names without a printable character.
void check_writable(const MeshData& mesh);

void check_length(std::size_t length, std::size_t expected,
                  const char* what);  // of optional fields: 0 is fine too

// Writes what `content` makes, atomically; its refusals are told with the file's name.
void write_content(const std::filesystem::path& path, const std::function<std::string()>& content);

}  // namespace kinemesh::io
