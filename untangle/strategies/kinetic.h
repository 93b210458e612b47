// Kinetic untangling: follow the vertices through the step, and flip an edge whenever a face collapses.
#pragma once

#include <span>

#include "kinemesh/strategy.h"
#include "untangle/fill/region_repair.h"
#include "untangle/strategies/kinetic_flips.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/face_sets.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh {

// Vertices move from Move::before to where they are, on straight lines; the mesh is one all the way
// [Agarwal 2008, §1]. Unlike the other strategies' result, this one's depends on the way: a face that has
// turned over and back again may have cost a flip. Where no flip can follow, because a vertex has met a
// constrained edge, the hull or several others on its way, the connectivity reached is taken to the end, and
// what is tangled there is replaced as `global` does: so a mesh is found whenever there is one, and only
// then.
//
// Regions are the connected pieces of what flips and these replacements have rewritten; `fallback` marks
// those with a replacement. Counts of tangles are of the connectivity before at the positions after, so that
// a region may have none. `retain` has no meaning. Cost: O(n) to find the faces that collapse, O(log n) for
// each event and flip. Memory: about 500 bytes for each of these, and 5 for each face.
class KineticUntangling : public Strategy {
 public:
  std::string_view name() const override { return "kinetic"; }

  // Throws InputError if move.before() does not hold a position for each vertex.
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

  const KineticCounts& counts() const { return counts_; }  // of the last repair

 private:
  [[nodiscard]] std::optional<Defect> replace_tangles(Undo& undo, const Tangles& tangles, bool allow_escaped);
  void find_regions(const Mesh& mesh, std::span<const Face> rewritten);
  void describe_regions(const Mesh& mesh, RepairRecord& record);

  GlobalWalk walk_;
  RegionRepair replaced_;
  FaceSets regions_;
  std::vector<char> is_rewritten_;  // per face
  KineticCounts counts_;
};

}  // namespace kinemesh
