// Seeded tangles, from light to hopeless, with the constrained edges always embedded: a valid mesh exists
// unless vertices coincide or lie on constrained edges. Coordinates are multiples of 2^-24
// (tests/untangle/oracle.h).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "kinemesh/build.h"
#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {

struct Tangle {
  std::string about;
  Mesh mesh;                  // built, then moved
  std::vector<Point> before;  // where its vertices were
};

// In general position but for freaks: squares, U-shapes, holes that turn, islands nested in holes, bow-ties,
// islands that change places, an interface between labels, frames.
Tangle random_tangle(std::uint64_t seed);

// A lattice whose vertices move by multiples of half a cell: jumps, permutations, swaps, collapsing rows,
// a frame, an interface.
Tangle lattice_tangle(std::uint64_t seed);

// Cells of a lattice, some of them missing, some with labels, in a frame: holes, islands and bow-ties at
// random. Any vertex may move by half a cell, on borders and interfaces too, so that often no valid mesh
// exists.
Tangle polyomino_tangle(std::uint64_t seed);
void jump_anywhere(Mesh& mesh, Random& random);

// Moves the interior vertices of a mesh of lattice_tangle once more.
void jump_on_lattice(Mesh& mesh, Random& random);

// New positions for the vertices on no constrained edge, the frame apart; snapped.
void move_free(Mesh& mesh, const std::function<Point(const Point&)>& map);
void move_constrained(Mesh& mesh, const std::function<Point(const Point&)>& map);

// Frame corners lie at irrational places; takes them to multiples of 2^-24 nearby.
void snap_frame(Mesh& mesh);

}  // namespace kinemesh::test
