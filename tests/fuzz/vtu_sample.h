// A VTU file by its parts, so that mutants keep what holds a file together, or break just that.
#pragma once

#include <string>

#include "kinemesh/mesh_data.h"
#include "tests/fuzz/mutants.h"

namespace kinemesh {

enum class VtuEncoding { Ascii, Base64, Raw, Zlib };

// A mutant of the mesh's file: of its numbers before they are encoded, of the lengths of its blocks, of its
// tags, offsets among them.
std::string mutated_vtu(const MeshData& mesh, VtuEncoding encoding, Dice& dice);

}  // namespace kinemesh
