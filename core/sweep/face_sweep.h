// Looking at all faces of a mesh, stretch by stretch, with the widest registers the machine has.
#pragma once

#include <algorithm>
#include <span>

#include "core/sweep/face_sweep_kernel.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Stretch s is of 64 faces from 64 s on, the last one of what is left.
inline int n_stretches(int n_faces) {
  return (n_faces + stretch_faces - 1) / stretch_faces;
}

// Padding included. Bits beyond the last face are 0. To the same bits on every machine.
Sight look_at_stretch(const Mesh& mesh, int stretch);

// The same without measuring: what is doubtful.
std::uint64_t doubtful_in_stretch(const Mesh& mesh, int stretch);

// Asks for the corners of a face that comes a little after this one. The first is mostly near
// that of the face before, since faces are in the order of their lowest vertex.
inline void fetch_ahead(std::span<const MeshTriangle> triangles, std::span<const Point> positions,
                        Face face) {
  constexpr std::size_t ahead = 64;
  const auto& t = triangles[std::min(face + ahead, triangles.size() - 1)];
  __builtin_prefetch(&positions[t[1]]);
  __builtin_prefetch(&positions[t[2]]);
}

}  // namespace kinemesh
