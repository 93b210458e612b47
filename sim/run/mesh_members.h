// Meshes in files of sections: the members of their parts, in the order of the file. Internal to sim/.
#pragma once

#include "core/mesh/mesh_state.h"
#include "sim/run/sections.h"

namespace kinemesh {

template <class Archive, class S>
requires binary::Is<S, Marker>
void members(Archive& archive, S& marker) {
  archive(marker.name, marker.edges);
}

template <class Archive, class S>
requires binary::Is<S, ListedConstraint>
void members(Archive& archive, S& constraint) {
  archive(constraint.from, constraint.to, constraint.left, constraint.right, constraint.marker);
}

template <class Archive, class S>
requires binary::Is<S, MeshOrder>
void members(Archive& archive, S& order) {
  archive(order.vertices, order.faces, order.constraints, order.turned);
}

template <class Archive, class S>
requires binary::Is<S, MeshState>
void members(Archive& archive, S& state) {
  archive(state.positions, state.triangles, state.labels, state.constraint_sides, state.doubled);
}

// The sections of what all states of a mesh have in common.
template <class Sections, class S>
requires binary::Is<S, MeshBase>
void base_sections(Sections& sections, S& base) {
  sections({"mesh", 1}, base.frame, base.fixed, base.home, base.constraints, base.markers, base.label_names);
  sections({"order", 1}, base.order);
}

}  // namespace kinemesh
