// Untangling by moving vertices: connectivity stays, and without a guarantee.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "kinemesh/strategy.h"
#include "untangle/places/max_min_area.h"

namespace kinemesh {

// Local optimization [Freitag & Plassmann 2000]: a free vertex (no frame, not fixed, on no constrained edge)
// goes to where the smallest signed area of the faces around it is largest (untangle/places/max_min_area.h),
// or most of the way there where that leaves one inverted or flat, if all of them are then larger than the
// smallest was, by exact signs. Sweeps go over the free vertices of inverted and flat faces, in the order of
// their numbers; after each that does not leave fewer of these faces than ever, over one ring of neighbours
// more.
//
// May fail: after max_rings such sweeps in a row. Then all vertices are where they were, bit for bit, and the
// defect names an inverted or flat face, where it was in the end, and how many were left. Valid whenever it
// succeeds: if all faces are upright within a convex border, none overlap. No face is rewritten: a record
// without regions. Cost: the sweep that finds the tangles, and a small linear programme for each visit of a
// vertex.
class VertexOptimization : public Strategy {
 public:
  static constexpr int max_rings = 20;

  std::string_view name() const override { return "optimize"; }
  bool moves_vertices() const override { return true; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

  // Of the last repair.
  int sweeps() const { return sweeps_; }
  int moved() const { return static_cast<int>(moved_.size()); }  // vertices that stand elsewhere

 private:
  class Run;

  int sweeps_ = 0;
  std::vector<std::pair<int, Point>> moved_;  // vertices, and where they came from
  std::vector<char> is_moved_;                // per vertex
  std::vector<LinkEdge> link_;                // around the vertex at hand
  MaxMinArea max_min_area_;
};

}  // namespace kinemesh
