// Sweeps over the free vertices of a valid mesh, each of which moves where that makes its faces better.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/smoothing.h"
#include "untangle/places/optimal_point.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {

// The moves of `smooth`, which has their guarantees, for meshes without tangles. Takes the memory it needs
// when it is made: run by the Laplacian method does not allocate, and so cannot fail.
class VertexSweeps {
 public:
  // held: per vertex, stays although it could move; empty: none does.
  explicit VertexSweeps(const Mesh& mesh, std::vector<char> held = {})
      : held_(std::move(held)), restless_(mesh.n_vertices()), is_moved_(mesh.n_vertices()) {
    moved_.reserve(mesh.n_vertices());
  }

  struct Counts {
    int sweeps = 0, moves = 0;
    int moved = 0;  // vertices moved once or more
  };

  // Of a move: how far it has to go, and what the tangent of the smallest angle around the vertex has to
  // exceed.
  struct Demand {
    double least_distance, tangent;
  };

  // Pre: the mesh is valid and has the number of vertices of the one this was made for. stays: see
  // QualityInputs.
  Counts run(Mesh& mesh, const SmoothingOptions& options, std::span<const char> stays = {});

  // By the last run, each once, in no order.
  std::span<const MovedVertex> moved_vertices() const { return moved_; }

 private:
  bool may_move(const Mesh& mesh, Vertex vertex) const;
  bool visit(Mesh& mesh, Vertex vertex, const SmoothingOptions& options);
  bool move_towards_mean(Mesh& mesh, Vertex vertex, const Demand& demand);
  bool move_to_optimum(Mesh& mesh, Vertex vertex, const Demand& demand);

  std::vector<char> held_;
  std::span<const char> stays_;  // in this run
  std::vector<char> restless_;   // per vertex: free, and something around it has changed since it was visited
  std::vector<char> is_moved_;   // per vertex
  std::vector<MovedVertex> moved_;
  std::vector<LinkEdge> link_;  // around the vertex at hand
};

}  // namespace kinemesh
