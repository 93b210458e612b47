// Strategies side by side: each makes the same moved mesh valid again, step after step.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/scenario.h"
#include "kinemesh/setup.h"
#include "kinemesh/stepper.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// What one strategy did at one step, and the mesh it left, which has been validated outside what is timed.
struct Round {
  const std::string& strategy;
  const StepRecord& record;
  const Mesh& mesh;
  // Allocated by stepper and strategy, mesh included, and not given back after the step; exact on one thread.
  std::size_t held_bytes;
};

// A mesh as it was moved, before it is repaired: of the first strategy.
using TangledMeshViewer = std::function<void(int step, const Mesh& tangled)>;

// Runs the scenario once for all strategies, in the place of its own. At each step the motion takes the
// common positions of the step before, whatever the strategies have made of the mesh, and each strategy is
// given the result; its own mesh differs from the others' by its connectivity, and in its positions if it
// moves vertices. One that finds no valid mesh where another does goes on with a copy of the other's mesh;
// its round is not accepted. Steps are timed in turn. Calls `view`, if there is one, before each step, `tell`
// for each round, and returns why it ended early, if it did: no strategy had a valid mesh. Throws InputError
// for unknown strategies, std::logic_error for a mesh that a strategy claims to be valid and is not. made: of
// the scenario, by set_up (kinemesh/setup.h).
std::optional<std::string> compare_strategies(const Scenario& scenario, SetUp made,
                                              std::span<const std::string> strategies,
                                              const std::function<void(const Round&)>& tell,
                                              const TangledMeshViewer& view = {});

// The values a key of the scenario takes one after the other: "motion.0.amplitude=0.01,0.1".
struct Sweep {
  std::string key;
  std::vector<std::string> values;  // as in --set; commas within brackets and quotes do not part them
};

// Throws InputError for a text that is none.
Sweep parse_sweep(const std::string& text);

}  // namespace kinemesh
#pragma GCC visibility pop
