// What a constrained Delaunay triangulation is, told independently of flips.
#pragma once

#include <string>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

// Nothing if the mesh has the edges that the triangulator gives its vertices and constrained edges, but for
// diagonals of cocircular vertices; else a sentence.
std::string not_delaunay(const Mesh& mesh);

// The edges that differ, cocircular ones included.
int n_foreign_edges(const Mesh& mesh);

// Unconstrained edges with a vertex inside the circle on the other side.
int n_not_locally_delaunay(const Mesh& mesh);

}  // namespace kinemesh::test
