#include "untangle/walk/face_sets.h"

#include <algorithm>

namespace kinemesh {

void FaceSets::reset(int n_faces) {
  for (int set = 0; set < count_; ++set) {
    for (const Face f : faces_[set]) set_of_[f] = none;
    faces_[set].clear();
  }
  count_ = 0;
  if (static_cast<int>(set_of_.size()) < n_faces) set_of_.resize(n_faces, none);
}

int FaceSets::open() {
  if (count_ == static_cast<int>(faces_.size())) faces_.emplace_back();
  return count_++;
}

void FaceSets::add(Face face, int set) {
  faces_[set].push_back(face);  // first: reset() finds what it has to undo even if this throws
  set_of_[face] = set;
}

void FaceSets::absorb(int into, int other) {
  auto& all = faces_[into];
  all.insert(all.end(), faces_[other].begin(), faces_[other].end());  // may throw, the rest does not
  for (const Face f : faces_[other]) set_of_[f] = into;
  faces_[other].clear();
}

void FaceSets::sort(int set) {
  std::sort(faces_[set].begin(), faces_[set].end());
}

}  // namespace kinemesh
