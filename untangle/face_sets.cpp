#include "untangle/face_sets.h"

#include <algorithm>

namespace kinemesh {

void FaceSets::reset(int n_faces) {
  for (const auto& faces : faces_) {
    for (const int f : faces) set_of_[f] = none;
  }
  faces_.clear();
  if (static_cast<int>(set_of_.size()) < n_faces) set_of_.resize(n_faces, none);
}

int FaceSets::open() {
  faces_.emplace_back();
  return count() - 1;
}

void FaceSets::add(int face, int set) {
  faces_[set].push_back(face);  // first: reset() finds what it has to undo even if this throws
  set_of_[face] = set;
}

void FaceSets::absorb(int into, int other) {
  const auto moved = std::move(faces_[other]);
  faces_[other].clear();
  for (const int f : moved) add(f, into);
}

void FaceSets::sort(int set) {
  std::sort(faces_[set].begin(), faces_[set].end());
}

}  // namespace kinemesh
