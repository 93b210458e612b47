#include "kinemesh/strategy.h"

#include "core/base/registry.h"
#include "kinemesh/local.h"
#include "untangle/strategies/auto.h"
#include "untangle/strategies/flips.h"
#include "untangle/strategies/global.h"
#include "untangle/strategies/kinetic.h"
#include "untangle/strategies/optimize.h"
#include "untangle/strategies/remesh.h"

namespace kinemesh {
namespace {

template <class T>
StrategyInfo info(const char* name, const char* description) {
  return {name, description, [] { return std::unique_ptr<Strategy>(std::make_unique<T>()); }};
}

Registry<StrategyInfo>& registry() {
  static Registry<StrategyInfo> all(
      "strategy",
      {
          info<GlobalUntangling>("global",
                                 "replaces what the inverted faces cover, all at once; always ends valid"),
          info<LocalUntangling>(
              "local",
              "replaces the minimum region around one inverted face after the other; always ends valid"),
          info<FullRemesh>("remesh",
                           "triangulates all vertices anew at every step (CGAL); always ends valid"),
          info<KineticUntangling>(
              "kinetic",
              "flips an edge whenever a face collapses on its way through the step; always ends valid"),
          info<AutomaticRepair>(
              "auto", "global, or remesh where most of the mesh would be replaced; always ends valid"),
          info<EdgeFlips>(
              "flips", "flips edges while that makes the inverted area smaller; may get stuck and says so"),
          info<VertexOptimization>(
              "optimize",
              "moves vertices to where the smallest area around is largest; may fail and says so"),
      });
  return all;
}

}  // namespace

std::vector<StrategyInfo> strategies() {
  return registry().all();
}

void register_strategy(StrategyInfo strategy) {
  registry().add(std::move(strategy));
}

std::unique_ptr<Strategy> make_strategy(std::string_view name) {
  return registry().find(name).make();
}

}  // namespace kinemesh
