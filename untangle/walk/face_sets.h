// Disjoint sets of faces, numbered from 0: the regions while they are being found.
#pragma once

#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

class FaceSets {
 public:
  // Empties all sets; the next faces are below n_faces. O(what was in the sets), after the first time.
  void reset(int n_faces);

  int count() const { return count_; }
  int open();  // a new empty set; returns its number

  int set_of(Face face) const { return set_of_[face]; }  // or none
  const std::vector<Face>& faces(int set) const { return faces_[set]; }

  void add(Face face, int set);      // pre: face is in no set
  void absorb(int into, int other);  // moves all faces of `other`, which stays as an empty set
  void sort(int set);                // its faces, ascending

 private:
  std::vector<int> set_of_;               // per face
  std::vector<std::vector<Face>> faces_;  // of the first count_ sets; memory of earlier ones behind them
  int count_ = 0;
};

}  // namespace kinemesh
