// What a step did to the faces of the domain, face by face, as an observer of the stepper gets to see it.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// A face that the step has rewritten: its number now stands for other corners. Everything in the user's
// numbering. A face is part of the domain before and after, unless vertices have escaped: then its label is
// padding_label where it is not.
struct FaceChange {
  UserFace face;
  UserTriangle before{}, after{};  // corners; none: a corner of the frame
  int label_before = 0, label_after = 0;
};

// Changes that belong together: the faces before and the faces after have the same vertices, the same border
// and, where nothing escaped, the same labels, each as often. One region, or several that share faces, with
// the flips that touched them; or flips alone.
struct ChangedPatch {
  std::vector<int> regions;          // indices in StepChanges::repair.regions, ascending; empty: flips alone
  std::vector<FaceChange> faces;     // ascending
  std::vector<UserVertex> vertices;  // their corners, ascending, without the frame's
};

// A vertex that the quality pass has moved besides, after the repair, and from where.
struct QualityMove {
  UserVertex vertex;
  Point before{0.0, 0.0};
};

// A step that has been repaired but not yet taken. Faces of the domain that are in no patch have the corners,
// the order of corners and the label they had, bit for bit.
struct StepChanges {
  int step = 0;       // its number, from 1
  double time = 0.0;  // at its end
  double dt = 0.0;
  const Mesh& mesh;                               // as it will be
  std::span<const Point> positions_before;        // in the mesh's numbering
  const RepairRecord& repair;                     // counts, and all regions
  const std::vector<ChangedPatch>& patches;       // by their smallest face
  std::span<const QualityMove> moved_by_quality;  // ascending

  const Point& before(UserVertex vertex) const { return positions_before[mesh.vertex_of_user(vertex)]; }
  const Point& after(UserVertex vertex) const { return mesh.position(mesh.vertex_of_user(vertex)); }
};

// Called within a step when everything is known and nothing is final yet. One that throws vetoes the step:
// the mesh goes back, bit for bit, to what it was, and the exception goes on to the caller of the step.
// Observers called before it have then seen a step that never was, so those with a state of their own come
// last, or change it after the step. Must not call the stepper.
using StepObserver = std::function<void(const StepChanges&)>;

}  // namespace kinemesh
#pragma GCC visibility pop
