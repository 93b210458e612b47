// The interior's part of a step: it follows what the border does.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/motion.h"
#include "motion/interior/interior.h"

namespace kinemesh {

// What one step leaves for the next: its increments, as the solver's start vector, and how long it was.
struct FollowingState {
  std::vector<Point> increments;  // per vertex of the mesh; empty before the first step
  double dt = 0.0;
};

// Solves for the interior (motion/interior/interior.h) and puts sliding vertices on their lines. A step that
// is not accepted leaves nothing behind.
class Following {
 public:
  Following(const Mesh& mesh, const InteriorOptions& options, FollowingState state = {});

  // x1: where the motion has the vertices go, border and bodies finally, the interior without what follows;
  // that is added. Where vertices of a sliding border would overtake one another, those between two that are
  // held are spread as they were before. Pre: motion.roles() are there; the mesh is at the start of the step.
  // x1 is of no use where the solution has not converged.
  [[nodiscard]] InteriorSolution follow(const Mesh& mesh, const Motion& motion, const TimeStep& step,
                                        std::span<Point> x1);

  // The same for a border that somebody else moves: x1 of all Known vertices is given.
  [[nodiscard]] InteriorSolution follow(const Mesh& mesh, std::span<const Role> roles, double dt,
                                        std::span<Point> x1);

  void accept();  // the last step counts
  const FollowingState& state() const { return state_; }

 private:
  InteriorSolution solve(const Mesh& mesh, std::span<const Role> roles, std::span<const Point> ways,
                         double dt, std::span<const Point> x1);

  Interior interior_;
  FollowingState state_, next_;
  std::vector<Point> ways_;
  std::unordered_map<int, Point> tangents_;
};

}  // namespace kinemesh
