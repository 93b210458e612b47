// Whether two names are one file.
#pragma once

#include <filesystem>

namespace kinemesh {

// Through links of both kinds; also of files that are not there yet, by the folder they would be in.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace kinemesh
