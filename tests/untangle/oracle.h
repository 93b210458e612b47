// What detection and the global walk must find, by comparing every face with every other in exact integers.
// Shares no code with kinemesh/predicates.h and untangle/. Pre everywhere: coordinates are multiples of 2^-24
// (tests/core/mesh/sample_meshes.h, snapped), at most 32 in size; throws std::invalid_argument otherwise.
#pragma once

#include <utility>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::oracle {

std::vector<Face> inverted(const Mesh& mesh);  // ascending
std::vector<Face> flat(const Mesh& mesh);      // ascending

// Classes of inverted faces under "shares an edge", each ascending, by first face.
std::vector<std::vector<Face>> inverted_components(const Mesh& mesh);

// R* = phi(I)* [Agarwal 2008, §5]: the faces whose shadow overlaps that of an inverted face, in the connected
// pieces of phi(I): two faces are in one piece if phi(I) meets the edge between them. Each ascending, by
// first face. Exact also where positions are degenerate, but then more faces than these may have to go.
std::vector<std::vector<Face>> conflict_pieces(const Mesh& mesh);

// Two vertices of faces at the same place, or (none, none).
std::pair<Vertex, Vertex> coincident_vertices(const Mesh& mesh);

// True if two constrained edges touch anywhere but at a common end, or a vertex of a face lies on one it is
// no end of.
bool constraints_touch(const Mesh& mesh);

}  // namespace kinemesh::oracle
