// What becomes of values that belong to faces when a step replaces faces. Values of vertices need nothing: a
// repair neither adds nor removes nor moves a vertex, so that they stay where they are.
//
//   stepper.observe([&](const StepChanges& changes) {
//     const CellUpdate mass_update = remap_amounts(changes, mass);  // all of them first,
//     mass_update.apply(mass);                                      // then what cannot fail
//   });
//
// One value per face in the user's numbering; faces that keep their corners keep their value, bit for bit.
// Each patch and each label in it is treated on its own. To be called by an observer of the stepper
// (kinemesh/step_changes.h); computing an update changes nothing, so that a step can still be vetoed.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "kinemesh/step_changes.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// The values of the faces that a step has rewritten.
struct CellUpdate {
  std::vector<UserFace> faces;  // ascending within a patch
  std::vector<double> values;

  void apply(std::span<double> cells) const noexcept;
};

// Conservative remap of amounts: what a face holds all together, such as a mass. By label, the sum over the
// new faces is that over the old ones, exact to rounding.
//
// Formula: an old face T is carried along with its vertices, inverted or not, and its amount Q_T spread
// evenly over its image f(T). A new face N of the same label receives
//     Q_N = sum over T of Q_T |f(T) cut with N| / |f(T)|,
// and what falls beside the label's new faces, or lies on an f(T) without area, is given to all of them in
// proportion to their areas. First order, as the cell-intersection remap it is [Dukowicz 1984]; linear in Q.
//
// What an inverted face holds is what the solver says it does, and one formula serves both ways of saying it:
// - Lagrangian, mass goes with its face: Q_T >= 0 whatever its orientation, and then Q_N >= 0, to rounding.
// - Eulerian (ALE), amounts follow the areas that the edges sweep [Thomas 1979]: the amount of an inverted
//   face is negative like its signed area. Then a constant stays one: the signed areas over a point of the
//   region add up to 1 [Agarwal 2008, §2], so that Q_T = c area(f(T)) gives Q_N = c area(N).
// Pre: one amount per face of the domain. Throws InputError otherwise, and where a label has faces before and
// none after, which only escaped vertices bring about. Cost: O(m log m + overlaps) for patches of m faces.
CellUpdate remap_amounts(const StepChanges& changes, std::span<const double> amounts);

// The same for averages u, as Q = u times the signed area at the new positions: constants stay constant, and
// the integral over each label, inverted faces counting negative, is kept. To rounding, relative to the areas
// of the patch: a sliver's average carries its neighbours' errors.
CellUpdate remap_averages(const StepChanges& changes, std::span<const double> averages);

// The value of that old face of the label whose centre, where it has been carried to, is nearest to the new
// one's; the one with the smaller number of two. Values are old values: no new extremes, no conservation.
CellUpdate copy_nearest(const StepChanges& changes, std::span<const double> values);

// The user's own way: called for each patch with its values before, one per patch.faces, writes those after.
// It may throw to veto the step.
using PatchTransfer = std::function<void(const StepChanges& changes, const ChangedPatch& patch,
                                         std::span<const double> before, std::span<double> after)>;
CellUpdate transfer_by(const PatchTransfer& transfer, const StepChanges& changes,
                       std::span<const double> values);

// Area of what two triangles have in common, whichever way they turn. Rounded: by clipping one by the sides
// of the other [Sutherland 1974].
double overlap_area(const std::array<Point, 3>& a, const std::array<Point, 3>& b);

}  // namespace kinemesh
#pragma GCC visibility pop
