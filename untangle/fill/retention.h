// The upright faces of a region that need not be replaced.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

// R* is the least that a locally removable region takes along, not the least that has to be replaced: an
// upright face may stay if no other vertex of the region lies in its closed shadow and it overlaps no other
// face that stays. Then what is left still has a simple border, since R* covers each of its points once,
// with signs. Of faces that overlap those in the larger upright component stay. [Agarwal 2008, §6]
class Retention {
 public:
  // Chooses among faces, ascending, with a simple border. False if none can stay.
  bool run(const Mesh& mesh, const std::vector<Face>& faces);

  const FaceSets& rest() const { return rest_; }           // set 0: what has to be replaced, ascending
  const std::vector<Face>& kept() const { return kept_; }  // the others, ascending

 private:
  FaceSets rest_;
  std::vector<Face> kept_;
};

}  // namespace kinemesh
