// What every input to a reader must satisfy: it is refused by InputError, or it is a mesh that keeps the
// contract and comes back from the format's own writer unchanged. Shared by the fuzz targets and the tests
// over the corpus.
#pragma once

#include <string>
#include <string_view>

#include "kinemesh/mesh_io.h"

namespace kinemesh {

// An empty string, or what is wrong.
std::string check_reader(std::string_view text, Format format);

}  // namespace kinemesh
