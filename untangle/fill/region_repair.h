// From sets of faces to patches, with the safety net for borders that degenerate positions have made touch
// something.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <optional>
#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"
#include "untangle/fill/region_mesher.h"
#include "untangle/fill/retention.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// A region on its way to the splice.
struct RegionPatch {
  Patch patch;          // empty where the region was absorbed by another
  RegionRecord record;  // of the region as it is replaced; without faces then
};

// The regions of a global walk, re-meshed one by one. Changes no mesh.
class RegionRepair {
 public:
  FaceSets& regions() { return regions_; }
  const FaceSets& regions() const { return regions_; }

  // To be called before the first region is re-meshed.
  void start();

  // Re-meshes all regions that have been added since the last call, in all threads, those whose border is not
  // simple apart: they wait for remesh_touching. Returns why there is no mesh, for the first region that has
  // none.
  [[nodiscard]] std::optional<Defect> remesh_new(const Mesh& mesh, const RepairOptions& options);

  // The same in two parts: which regions they are, and the work, which no longer looks at regions(), so that
  // more can be added meanwhile.
  void take_new(const Mesh& mesh);
  [[nodiscard]] std::optional<Defect> remesh_taken(const Mesh& mesh, const RepairOptions& options);

  // To be called once all regions are there.
  [[nodiscard]] std::optional<Defect> remesh_touching(const Mesh& mesh, const RepairOptions& options);

  // Re-meshes one region. While its border is not simple, it is enlarged by the faces across its border and
  // the regions they belong to, in the end by all faces: a retry, which is counted. Pre: all regions are
  // there.
  [[nodiscard]] std::optional<Defect> remesh(const Mesh& mesh, const RepairOptions& options, int region);

  // Of a region that has been re-meshed.
  RegionPatch& patch(int region) { return patches_[region]; }

 private:
  // What a thread works with.
  struct Worker {
    Hole rest;
    RegionMesher mesher;
    Finisher finisher;
    Retention retention;
  };
  struct Attempt {
    bool is_simple = true;
    std::optional<Defect> defect;
  };

  void prepare_new();
  Attempt attempt(const Mesh& mesh, const RepairOptions& options, int region, const Hole& hole);
  bool remesh_rest(const Mesh& mesh, const RepairOptions& options, int region, const Hole& hole);
  void enlarge(const Mesh& mesh, int region);
  void take(Face face, int region);

  FaceSets regions_;
  tbb::enumerable_thread_specific<Worker> workers_;
  std::vector<RegionPatch> patches_;  // of the first n_prepared_ regions; memory of earlier repairs behind
  int n_prepared_ = 0;
  int first_taken_ = 0;
  std::vector<Hole> holes_;        // of the regions taken from there on; memory of earlier ones behind
  std::vector<Attempt> attempts_;  // of the same
  std::vector<int> touching_;      // regions whose border was not simple, ascending
};

}  // namespace kinemesh
