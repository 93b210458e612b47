// Untangling by edge flips alone: cheap and local, and without a guarantee.
#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "kinemesh/strategy.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// Whether flipping the edge makes the inverted area smaller (the sum of the areas of all inverted faces), or
// leaves it as it is and makes flat faces fewer. Exact. edge: one of its sides. Pre: mesh.is_flippable(edge).
bool flip_untangles(const Mesh& mesh, Side edge);

// Flips edges of inverted and flat faces as long as some flip makes the inverted area smaller, or, that area
// being the same, the faces fewer that are not upright. Greedy: what makes it smallest comes first; this
// order is rounded, what may be flipped is exact. Constrained edges stay and no two edges get the same ends,
// so that labels and borders are what they were. It ends: no triangulation comes twice, and there are
// finitely many.
//
// May get stuck: then the mesh is as it was, and the defect names a face that flips cannot turn, with its
// corners there, and how many there are. Valid whenever it succeeds: if all faces are upright within a convex
// border, none overlap. Regions of the record are the faces that connected flips have rewritten; `explored`
// counts these and not those beside them. Cost: the sweep that finds the tangles, and for each flip that of a
// heap and of going around a vertex.
class EdgeFlips : public Strategy {
 public:
  std::string_view name() const override { return "flips"; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

 private:
  class Run;
  std::vector<Face> rewritten_faces();
  std::vector<RegionRecord> describe_regions(const Mesh& mesh) const;

  // The largest gain comes first, of equal ones the side with the smaller number.
  struct Candidate {
    double gain;
    Side side;  // of the lower face when it was pushed
    bool operator<(const Candidate& other) const {
      return std::tuple(gain, other.side) < std::tuple(other.gain, side);
    }
  };

  FaceSets rewritten_;  // sets of faces that flips connect
  std::vector<Candidate> queue_;
};

}  // namespace kinemesh
