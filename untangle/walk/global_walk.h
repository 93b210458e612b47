// Which faces a global repair has to replace: the preimage phi(I) of everything an inverted face covers.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/face_sets.h"
#include "untangle/walk/shadow_index.h"

namespace kinemesh {

// Walks whole faces from the tangled ones, F, across an edge e if
//   (i)   it is an edge of a face of F, or
//   (ii)  f(e) meets the interior of an inverted face's shadow, or
//   (iii) f(e) touches the shadow of an edge of a face of F anywhere but at the image of a common end point.
// In general position the faces reached are exactly R* = phi(I)* [Agarwal 2008, §5]: where every inverted
// face is a seed, the whole preimage of their shadow is wanted, so neither signs nor growing are needed
// (Theorem 5.1). In degenerate positions rule (iii) adds the faces without which a region's border would
// touch a shadow.
class GlobalWalk {
 public:
  // Each connected piece of the walk becomes a set of `regions`, in the order of their first tangled face,
  // the faces of each ascending. Reads the data of no face that is not in a region. Deterministic. Keeps
  // scratch memory for the next.
  void run(const Mesh& mesh, const Tangles& tangles, FaceSets& regions);

  // The same in parts, so that regions can be re-meshed while their faces are at hand: each `advance` adds
  // whole regions until they hold at least n_faces more, and is false once there are none left. Mesh and
  // regions stay where they are in between.
  void start(const Mesh& mesh, const Tangles& tangles, FaceSets& regions);
  bool advance(int n_faces);

  // Makes the walk that has been started end in the middle of a region once the regions hold more faces than
  // this: is_too_far is true then, and the regions are of no use.
  void give_up_beyond(int n_faces) { most_faces_ = n_faces; }
  bool is_too_far() const { return n_visited_ > most_faces_; }

 private:
  void walk_from(Face seed);
  void visit(Face face);
  void leave(Face face);
  bool is_conflicting(Side side) const;
  void fetch_around(std::span<const Face> seeds) const;

  const Mesh* mesh_ = nullptr;
  FaceSets* regions_ = nullptr;
  int region_ = none;             // the one that is being walked
  std::vector<Face> tangled_;     // F, ascending
  std::size_t next_seed_ = 0;     // in tangled_
  std::vector<bool> is_tangled_;  // per face; all false between walks but for those in tangled_
  ShadowIndex shadows_;           // of F
  std::vector<int> near_;         // in shadows_, near the face that is being left
  std::vector<Face> pending_;
  int n_visited_ = 0;
  int most_faces_ = std::numeric_limits<int>::max();
};

}  // namespace kinemesh
