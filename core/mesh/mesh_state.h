// A mesh taken apart into plain arrays and put together again, bit for bit: what files that must lose nothing
// hold.
//
// All is listed and named by the user's numbers: vertices by theirs, the frame's corners behind them; faces
// by theirs, padding behind them as it was numbered when built; constraints by their ends. A side is 4 f + k,
// f its face by that number. So what is listed does not depend on how the mesh numbers what it has. Results
// do, in last bits and ties: sums run in the mesh's order, new faces start at their lowest corner. So the
// order is kept as well, as permutations and apart. Which corner a face starts at is no matter of order: the
// user sees it in every mesh file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Where the mesh has what the arrays list, as permutations, and the constraints that it has the other way.
struct MeshOrder {
  std::vector<int> vertices, faces, constraints;
  std::vector<int> turned;  // ascending
};

// A Constraint, its ends by the user's numbers.
struct ListedConstraint {
  int from = none, to = none, left = 0, right = 0, marker = none;
};

// What stays as it is from building on.
struct MeshBase {
  double frame = 0.0;                         // frame_margin()
  std::vector<int> fixed;                     // vertices, ascending
  std::vector<int> home;                      // per vertex: home_label()
  std::vector<ListedConstraint> constraints;  // from the lower to the higher end, ascending
  std::vector<Marker> markers;
  std::map<int, std::string> label_names;
  MeshOrder order;
};

// What moving, repairs and flips change.
struct MeshState {
  std::vector<Point> positions;       // per vertex
  std::vector<Triangle> triangles;    // per face: its corners
  std::vector<int> labels;            // per face
  std::vector<int> constraint_sides;  // per constraint: the lower side on its edge
  // The two sides of each edge whose ends are those of another edge, too; all others are told by their ends.
  // There are some while a mesh is tangled.
  std::vector<Edge> doubled;
};

MeshBase base_of(const Mesh& mesh);
MeshState state_of(const Mesh& mesh, const MeshOrder& order);  // order: as in base_of(mesh)

// The mesh that both were taken of, but for which side side_from names. Throws InputError where they are of
// no mesh: whatever they hold, the result passes validate_connectivity. Positions may be any.
Mesh restore(const MeshBase& base, const MeshState& state);

// Throws InputError where it is none.
void require_permutation(const std::vector<int>& order);

// Values of the mesh's vertices or faces in the user's order, and back. Pre: a permutation of as many.
template <class T>
std::vector<T> in_user_order(const std::vector<T>& values, const std::vector<int>& order) {
  std::vector<T> sorted(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sorted[i] = values[order[i]];
  return sorted;
}

template <class T>
std::vector<T> in_mesh_order(const std::vector<T>& values, const std::vector<int>& order) {
  std::vector<T> placed(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) placed[order[i]] = values[i];
  return placed;
}

std::vector<int> inverse(const std::vector<int>& order);

}  // namespace kinemesh
