// Small meshes the tests start from, and the maps they are rerun under.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "kinemesh/mesh_data.h"

namespace kinemesh::test {

// Reproducible from its seed, with one standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool one_in(int n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

// A multiple of 2^-24 beside p: coordinates of few bits, so that brute force can be exact in 64-bit integers.
Point snapped(const Point& p);

// Closed, the domain to its left; not repeating its first point.
using Loop = std::vector<Point>;
Loop rectangle(const Point& low, const Point& high);
Loop circle(const Point& centre, double radius, int n);  // counter-clockwise, snapped
Loop reversed(Loop loop);                                // the border of a hole

// Delaunay triangulation of what the loops enclose, with `inside` as further vertices and the edges of
// `lines`, closed like loops. Points at the same place become one vertex. Vertices in the order given: loops,
// lines, inside.
MeshData domain_of(const std::vector<Loop>& loops, const std::vector<Point>& inside = {},
                   const std::vector<Loop>& lines = {});

// `n` vertices in [0,1]^2, the corners first, the others random, snapped.
MeshData random_square(int n, Random& random);

// [0, 2 nx] x [0, 2 ny] in cells of width 2, so that half a cell is 1; diagonals random. Row by row from
// below.
MeshData random_grid(int nx, int ny, Random& random);

// Four triangles around vertex 4, the centre of [0,2]^2.
MeshData four_triangles();

// Two prongs that point up, [0,1] x [0,3] and [2,3] x [0,3], joined by [0,3] x [0,1]; with random vertices.
MeshData u_shape(int inside, Random& random);

// Counter-clockwise as the original.
MeshData mirrored(MeshData data);  // x -> -x
MeshData mapped(MeshData data, const Point& factor, const Point& shift);

}  // namespace kinemesh::test
