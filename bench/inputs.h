// What the benchmarks work on; made once per size, so that only the first benchmark of a size waits for it.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/mesh_data.h"

namespace kinemesh::bench {

const MeshData& square(int vertices);   // the shape, random and seeded
const Mesh& square_mesh(int vertices);  // the same, built

// Positions of square_mesh after one step of jitter; amplitude in spacings.
std::vector<Point> jittered(int vertices, double amplitude);

}  // namespace kinemesh::bench
