// Meshes to test, benchmark and start runs with: every one valid but the umbilic, with all border edges in
// markers.
//
// The same arguments give the same mesh: bit for bit with one C library (sines) and one CGAL (order of the
// faces). Border edges run with the domain on their left. All throw InputError for too few vertices
// (ShapeInfo::min_vertices), and for more than a mesh can have (kinemesh/mesh_data.h).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// [0,1]^2 as nx by ny rectangles, each cut from lower left to upper right: (nx+1)(ny+1) vertices, row by row
// from below. Markers: bottom, right, top, left.
MeshData make_grid(int nx, int ny);

// Random vertices, exactly as many as asked for. With h = sqrt(area / vertices), border vertices are about h
// apart and no other lies closer to the border than h/2. The constrained Delaunay triangulation; border
// vertices come first, the others along a Hilbert curve. About 2 us per vertex.
//   square: [0,1]^2; markers bottom, right, top, left
//   disk: a regular polygon in the unit circle; marker border
//   annulus: between regular polygons in the circles of radius 1 and 1/2; markers outer, inner
MeshData make_square(int vertices, std::uint64_t seed = 1);
MeshData make_disk(int vertices, std::uint64_t seed = 1);
MeshData make_annulus(int vertices, std::uint64_t seed = 1);

// Graded by Delaunay refinement, about as many vertices as asked for (within 5 % from a thousand on). Border
// vertices lie on the curves themselves. About 20 us per vertex.
//   channel: [0,4]x[0,1] without a cylinder's section; markers inlet, outlet, bottom, top, cylinder
//   airfoil: NACA 0012 from (0,0) to (1,0) in the far field |p - (1/2,0)| <= 15; markers airfoil, farfield
MeshData make_channel(int vertices);
MeshData make_airfoil(int vertices);

inline constexpr Point cylinder_centre{1.0, 0.5};  // of make_channel
inline constexpr double cylinder_radius = 0.125;

// Half the thickness of a NACA 0012 section of chord 1 at x in [0,1], with the last coefficient that closes
// the trailing edge [Jacobs 1933; Abbott & von Doenhoff 1959, eq. 6.2].
double naca0012_half_thickness(double x);

// The tangle of [Agarwal 2008, Lemma 2.6]: an inverted component whose primary conflict set covers its shadow
// k + 1 times. Rings of faces, from outside in: the plane (identity on the border, a circle; marker border);
// then, unfolded from its middle outwards and in again to a point, the image of the unit disk under the
// elliptic umbilic
//   z -> z^k + k e^(k-1) conj(z),   inverted for |z| < e,
// with angles reversed. Turned and jittered (seeded) into general position. About `vertices` vertices. Pre: 2
// <= k <= 32.
MeshData make_umbilic(int k, int vertices, std::uint64_t seed = 1);

struct ShapeOptions {
  int vertices = 10000;
  std::uint64_t seed = 1;  // square, disk, annulus, umbilic
  int k = 2;               // umbilic
};

// By name, for scenarios.
struct ShapeInfo {
  std::string name;
  std::string description;
  std::vector<std::string> markers;
  int min_vertices;  // umbilic: for k = 2; in proportion to k
  std::function<MeshData(const ShapeOptions&)> make;
};

std::vector<ShapeInfo> shapes();

// Throws InputError for a name that is not in shapes(), too.
MeshData make_shape(std::string_view name, const ShapeOptions& options = {});

}  // namespace kinemesh
#pragma GCC visibility pop
