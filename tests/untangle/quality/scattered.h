// Good meshes with free vertices thrown about at random: badly tangled, with borders, interfaces and markers
// still.
#pragma once

#include <cstdint>
#include <string>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

struct Domain {
  std::string about;
  Mesh mesh;  // valid
};

// Of some hundred vertices: square, disk, annulus, channel around a cylinder; a square with a frame, a square
// of two labels, a disk with a marked line inside.
inline constexpr int n_domains = 7;
Domain domain_number(int number, std::uint64_t seed);

// Each free vertex goes to a place within `spacings` of its own in x and y, inside a face of its own label.
Mesh scattered(const Mesh& mesh, double spacings, std::uint64_t seed);

// Free vertices of each label change places at random.
Mesh exchanged(const Mesh& mesh, std::uint64_t seed);

// Of no constrained edge, not fixed, of the user.
bool is_free(const Mesh& mesh, Vertex vertex);

// The same mesh with its faces in another order, each from another corner.
MeshData shuffled(const MeshData& data, std::uint64_t seed);

int n_tangled(const Mesh& mesh);  // inverted and flat faces

// All but free vertices are at the same place, to the last bit.
std::string moved_what_stays(const Mesh& before, const Mesh& after);

// Faces and edges are what they were. (And what lies across each side is.)
bool same_connectivity(const Mesh& a, const Mesh& b);

}  // namespace kinemesh::test
