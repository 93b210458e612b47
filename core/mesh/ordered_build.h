// Building a mesh whose vertices are kept in an order that is not the curve's.
#pragma once

#include <span>

#include "kinemesh/build.h"

namespace kinemesh {

// As build_mesh, with the vertices in this order: each of the user's numbers once, and n_vertices + i for
// corner i of the frame, if there is one. Throws InputError for another one.
Mesh build_mesh(const MeshData& data, const BuildOptions& options, std::span<const int> order);

}  // namespace kinemesh
