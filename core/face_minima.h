// The smallest area and angle of the domain's faces, kept stretch by stretch: what has been measured on the
// way, by a sweep for inverted faces say, need not be measured again but where faces have been rewritten since.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace kinemesh {

// Of some faces, as twice_area and tangent_of_smallest_angle have them (core/measure.h).
struct Minima {
  double twice_area = std::numeric_limits<double>::infinity();
  double tangent = std::numeric_limits<double>::infinity();
};

class FaceMinima {
 public:
  // Nothing is known of a mesh of so many faces.
  void reset(int n_faces);

  // What a sweep has seen of a stretch (core/face_sweep.h), padding included. Several at the same time, of
  // different stretches.
  void set(int stretch, const Minima& seen, const Mesh& mesh);

  // These faces have been rewritten, or their corners moved.
  void outdate(std::span<const int> faces);

  // Measures what is not known, in all threads; the result does not depend on their number, nor on what was
  // known. Takes no memory, and does with one thread where TBB has none left.
  Minima update(const Mesh& mesh);

 private:
  std::vector<Minima> minima_;  // per stretch
  std::vector<char> is_known_;  // likewise; not bool, whose neighbours share a byte
  std::vector<int> unknown_;    // scratch
};

}  // namespace kinemesh
