// Local untangling: the minimum region around a seed, and nothing beyond it.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/strategy.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/fill/region_mesher.h"
#include "untangle/fill/region_repair.h"
#include "untangle/fill/retention.h"

namespace kinemesh {

// Each seed's minimum locally removable region is explored and re-meshed with upright faces; whatever is
// tangled elsewhere stays as it is [Agarwal 2008, Theorem 4.4, Lemma 3.3]. The piece of the global walk that
// holds the seed takes the region's place, valid but not the minimum, in degenerate positions, for a flat
// seed, and where the labels of a region do not fit together before tangles in its holes are gone.
class LocalUntangling : public Strategy {
 public:
  std::string_view name() const override { return "local"; }

  // All tangles in turn, by the smallest of the user's face numbers, those of padding last.
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const RepairOptions& options) override;

  // Only the regions of these faces (the mesh's numbers), in turn; a seed that has become upright with an
  // earlier region is done. Throws InputError, with nothing changed, for a seed that is upright at the start.
  // The counts of tangles in the record are those of the regions. On a defect nothing is changed.
  [[nodiscard]] RepairOutcome repair_seeds(Mesh& mesh, std::span<const int> seeds,
                                           const RepairOptions& options);

 private:
  struct Region {
    RegionRecord record;
    Patch patch;
    int doubled_edges = 0;
    std::optional<Defect> defect;
  };

  Region untangle(const Mesh& mesh, int seed, const RepairOptions& options, RepairRecord& times);
  std::optional<Region> minimum_region(const Mesh& mesh, int seed, const RepairOptions& options,
                                       RepairRecord& times);
  Region piece_of_global_walk(const Mesh& mesh, int seed, const RepairOptions& options, RepairRecord& times);
  bool remesh(const Mesh& mesh, const LocalExploration& exploration, const RepairOptions& options,
              Region& region);
  bool remesh_rest(const Mesh& mesh, const RepairOptions& options, Region& region);
  void finish_region(const Mesh& mesh, const FaceSets& sets, const Hole& hole, const RepairOptions& options,
                     NewFaces faces, Region& region);

  FaceSets sets_;  // the region at hand
  Hole hole_, rest_;
  RegionMesher mesher_;
  Finisher finisher_;
  Retention retention_;
  RegionRepair pieces_;  // of the global walk of this repair, once one was needed
  bool has_walked_ = false;
};

}  // namespace kinemesh
