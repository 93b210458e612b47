#include "kinemesh/strategy.h"

#include <algorithm>

#include "kinemesh/error.h"
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

std::vector<StrategyInfo>& registry() {
  static std::vector<StrategyInfo> all{
      info<GlobalUntangling>("global",
                             "replaces what the inverted faces cover, all at once; always ends valid"),
      info<LocalUntangling>(
          "local", "replaces the minimum region around one inverted face after the other; always ends valid"),
      info<FullRemesh>("remesh", "triangulates all vertices anew at every step (CGAL); always ends valid"),
      info<KineticUntangling>(
          "kinetic",
          "flips an edge whenever a face collapses on its way through the step; always ends valid"),
      info<AutomaticRepair>("auto",
                            "global, or remesh where most of the mesh would be replaced; always ends valid"),
      info<EdgeFlips>("flips",
                      "flips edges while that makes the inverted area smaller; may get stuck and says so"),
      info<VertexOptimization>(
          "optimize", "moves vertices to where the smallest area around is largest; may fail and says so"),
  };
  return all;
}

const StrategyInfo* find(std::string_view name) {
  const auto& all = registry();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const StrategyInfo& s) { return s.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::span<const StrategyInfo> strategies() {
  return registry();
}

void register_strategy(StrategyInfo strategy) {
  if (find(strategy.name)) throw InputError("there is already a strategy named '" + strategy.name + "'");
  registry().push_back(std::move(strategy));
}

std::unique_ptr<Strategy> make_strategy(std::string_view name) {
  if (const auto* strategy = find(name)) return strategy->make();
  std::string known;
  for (const auto& s : strategies()) known += (known.empty() ? "" : ", ") + s.name;
  throw InputError("no strategy is named '" + std::string(name) + "'; known are: " + known);
}

}  // namespace kinemesh
