// A mesh taken apart into plain arrays and put together again, bit for bit: what files that must lose nothing
// hold.
#pragma once

#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// How a mesh came to be: what build_mesh was given, and how it numbered vertices and faces.
struct MeshOrigin {
  MeshData data;
  double frame = 0.0;              // as in BuildOptions
  std::vector<int> fixed;          // as in BuildOptions
  std::vector<int> user_vertices;  // per vertex of the mesh: user_vertex()
  std::vector<int> user_faces;     // per face of the mesh: user_face()
};

// What has become of it since: all that moving, repairs and flips change.
struct MeshState {
  std::vector<Point> positions;       // per vertex
  std::vector<Triangle> triangles;    // per face: its corners
  std::vector<Triangle> across;       // per face: the sides opposite its sides
  std::vector<int> labels;            // per face
  std::vector<int> constraint_sides;  // per constraint: a side on its edge
};

// Pre: the mesh is as build_mesh made it.
MeshOrigin origin_of(const Mesh& mesh);
MeshState state_of(const Mesh& mesh);

// Builds the mesh again. Throws InputError where it cannot be built or comes out numbered in another way, as
// another version of the libraries might do.
Mesh rebuild(const MeshOrigin& origin);

// mesh: as rebuilt. Post: as it was when the state was taken. Throws InputError where the state is not one of
// this mesh, or makes no consistent connectivity; the mesh is then good for nothing.
void restore(Mesh& mesh, const MeshState& state);

}  // namespace kinemesh
