// Smoothing: vertices move so that faces get better angles, in meshes that may be tangled to begin with.
#pragma once

#include <optional>

#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"

#pragma GCC visibility push(default)
namespace kinemesh {

enum class SmoothingMethod {
  Laplacian,    // to the mean of the neighbours, or part of the way, where that makes the worst angle around
                // the vertex better: "smart" [Freitag 1997]
  Optimization  // to where the smallest angle around the vertex is largest (untangle/places/optimal_point.h)
};

struct SmoothingOptions {
  SmoothingMethod method = SmoothingMethod::Optimization;
  int max_sweeps = 20;
  double least_move = 1e-3;  // of the distance to the nearest neighbour; shorter moves are not made
  RepairOptions repair = {};
};

// Without a defect the mesh is valid. With one no vertex has moved; regions replaced before it stay so:
// connectivity is sound, and no face has become inverted or flat that was upright.
struct SmoothingOutcome {
  int untangled = 0;  // regions replaced because smoothing met an inverted or flat face
  int replaced = 0;   // faces in them
  int sweeps = 0;     // over the vertices, the last of which moved none unless max_sweeps were done
  int moves = 0;
  int moved = 0;                      // vertices moved once or more
  double min_angle_before_deg = 0.0;  // as measure has it; 0 before untangling
  double min_angle_after_deg = 0.0;
  std::optional<Defect> defect = {};  // why an inverted or flat face could not be removed

  explicit operator bool() const { return !defect; }
};

// Moves the free vertices: those of the user that are neither fixed nor on a constrained edge. Others stay,
// and with them borders, interfaces and the frame. First all vertices are visited, and while one has an
// inverted or flat face, that face's region is untangled [Agarwal 2008, §1]; then the free ones are swept
// over, in the order of their numbers, until none moves. (A vertex that moved while its surroundings lie
// folded over a border might come to lie beyond it.) Only moves that leave all faces around the vertex
// upright, exactly, and make the smallest of their angles larger are made: what is valid stays valid, and no
// mesh's smallest angle gets smaller by moving its vertices. Connectivity is changed by untangling only.
// Deterministic. Throws InputError for negative options.
[[nodiscard]] SmoothingOutcome smooth(Mesh& mesh, const SmoothingOptions& options = {});

}  // namespace kinemesh
#pragma GCC visibility pop
