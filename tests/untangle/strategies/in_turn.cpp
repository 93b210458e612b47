#include "tests/untangle/strategies/in_turn.h"

#include <array>

#include "kinemesh/local.h"
#include "kinemesh/validate.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/properties.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

std::vector<Face> seeds_of(const Mesh& mesh) {
  const auto tangles = detect(mesh);
  auto seeds = tangles.inverted;
  seeds.insert(seeds.end(), tangles.flat.begin(), tangles.flat.end());
  return seeds;
}

std::string region_broken(const Mesh& before, const Mesh& after, const RepairRecord& record) {
  const auto& region = record.regions.front();
  if (const auto defect = validate_connectivity(after)) return "broken: " + defect->message();
  if (region.gamma != 1) return "gamma is " + std::to_string(region.gamma);
  const auto left = seeds_of(before).size() - seeds_of(after).size();
  if (static_cast<int>(left) != region.inverted + region.degenerate) return "tangles the outside";
  return outside_changed(before, after, record);
}

bool has_valid_mesh(Mesh mesh) {
  return static_cast<bool>(make_strategy("global")->repair(mesh, RepairOptions{.allow_escaped = true}));
}

}  // namespace

std::string check_in_turn(const Mesh& tangled, Random& random) {
  Mesh mesh = tangled;
  LocalUntangling local;
  for (auto seeds = seeds_of(mesh); !seeds.empty(); seeds = seeds_of(mesh)) {
    const Mesh before = mesh;
    const std::array<Face, 1> seed{seeds[random.below(static_cast<int>(seeds.size()))]};
    const auto outcome = local.repair_seeds(mesh, seed, {.allow_escaped = true, .retain = random.one_in(3)});
    if (!outcome) {
      if (!(snapshot_of(before) == snapshot_of(mesh))) return "a failure left its traces";
      return has_valid_mesh(tangled) ? "failed: " + outcome.defect->message() : "";
    }
    const auto wrong = region_broken(before, mesh, outcome.record);
    if (!wrong.empty()) return "seed " + std::to_string(seed[0]) + ": " + wrong;
  }
  if (const auto defect = validate(mesh)) return "not valid: " + defect->message();
  return has_valid_mesh(tangled) ? "" : "valid where global untangling finds no mesh";
}

}  // namespace kinemesh::test
