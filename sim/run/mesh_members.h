// Meshes in binary files: the members of their parts, in the order of the file. Internal to sim/.
#pragma once

#include "core/mesh/mesh_state.h"
#include "sim/run/binary.h"

namespace kinemesh {

template <class Archive, class S>
requires binary::Is<S, Marker>
void members(Archive& archive, S& marker) {
  archive(marker.name, marker.edges);
}

template <class Archive, class S>
requires binary::Is<S, MeshData>
void members(Archive& archive, S& data) {
  archive(data.points, data.triangles, data.labels, data.markers, data.label_names);
}

template <class Archive, class S>
requires binary::Is<S, MeshOrigin>
void members(Archive& archive, S& origin) {
  archive(origin.data, origin.frame, origin.fixed, origin.user_vertices, origin.user_faces);
}

template <class Archive, class S>
requires binary::Is<S, MeshState>
void members(Archive& archive, S& state) {
  archive(state.positions, state.triangles, state.across, state.labels, state.constraint_sides);
}

}  // namespace kinemesh
