// The paper's lemmas as properties of random tangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "kinemesh/build.h"
#include "kinemesh/predicates.h"
#include "tests/untangle/explore/local_oracle.h"
#include "tests/untangle/explore/tangles.h"

namespace kinemesh::test {
namespace {

struct World {
  explicit World(const MeshData& tangle)
      : mesh(build_mesh(tangle)), sheets(mesh, subdivide(mesh)), oracle(sheets) {}

  const Mesh mesh;
  const Sheets sheets;
  const LocalOracle oracle;

  std::vector<int> all_components() const {
    std::vector<int> all(sheets.n_components());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  // phi(J), the preimage of f(J).
  Lifts conflict_set(const std::vector<int>& components) const {
    const Cells x = oracle.shadow(components);
    Lifts out(sheets.n_lifts());
    for (int i = 0; i < sheets.n_lifts(); ++i) out[i] = x[sheets.lift(i).cell];
    return out;
  }
};

// Tangled ones among the first so many.
void for_tangles(int n, const std::function<void(const World&, Random&)>& check) {
  int tangled = 0;
  for (int seed = 1; tangled < n; ++seed) {
    SCOPED_TRACE("tangle " + std::to_string(seed));
    const World world(random_tangle(seed));
    if (world.sheets.n_components() == 0) continue;
    ++tangled;
    Random random(seed);
    check(world, random);
  }
}

bool is_subset(const std::vector<bool>& a, const std::vector<bool>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] && !b[i]) return false;
  }
  return true;
}

std::vector<int> some(const std::vector<int>& all, Random& random) {
  std::vector<int> out{all[random.below(static_cast<int>(all.size()))]};
  for (const int i : all) {
    if (i != out.front() && random.below(3) == 0) out.push_back(i);
  }
  std::ranges::sort(out);
  return out;
}

// gamma_S, by asking every face.
int cover_of(const Mesh& mesh, const Point& p) {
  int sum = 0;
  for (const Face face : mesh.faces()) {
    const auto corners = mesh.corners(face);
    if (strictly_inside(p, corners)) sum += static_cast<int>(orientation(corners[0], corners[1], corners[2]));
  }
  return sum;
}

TEST(Lemma22, TheMeshCoversEveryPointOnce) {
  for_tangles(60, [](const World& world, Random& random) {
    for (int i = 0; i < 50; ++i) EXPECT_EQ(cover_of(world.mesh, random.in_square()), 1);
    const auto gamma = world.oracle.gamma(Lifts(world.sheets.n_lifts(), true));
    EXPECT_EQ(std::ranges::count(gamma, 1), world.sheets.n_cells() - 1);  // 0 outside
    EXPECT_EQ(std::ranges::count(gamma, 0), 1);
  });
}

TEST(Lemma23, ConflictSetsHaveTheShadowOfWhatTheyComeFromAndGrowWithIt) {
  for_tangles(60, [](const World& world, Random& random) {
    const auto& oracle = world.oracle;
    const auto j = some(world.all_components(), random);
    const Lifts primary = oracle.neighbourhood(oracle.lifts_of(j), oracle.shadow(j));
    EXPECT_TRUE(is_subset(primary, world.conflict_set(j)));
    Cells below(world.sheets.n_cells());
    for (int i = 0; i < world.sheets.n_lifts(); ++i) {
      if (primary[i]) below[world.sheets.lift(i).cell] = true;
    }
    EXPECT_EQ(below, oracle.shadow(j));
    for (const int i : oracle.components_in(primary)) {
      if (!is_subset(oracle.lifts_of({i}), primary)) continue;
      EXPECT_TRUE(is_subset(oracle.neighbourhood(oracle.lifts_of({i}), oracle.shadow({i})), primary));
    }
  });
}

TEST(Lemma25, GammaIsConstantOnEachComponentOfAConflictSet) {
  int components = 0, not_one = 0;
  for_tangles(100, [&](const World& world, Random& random) {
    const auto& oracle = world.oracle;
    const auto j = some(world.all_components(), random);
    Lifts left = world.conflict_set(j);
    for (int i = 0; i < world.sheets.n_lifts(); ++i) {
      if (!left[i]) continue;
      Lifts one(left.size(), false);
      one[i] = true;
      const Lifts u = oracle.neighbourhood(one, oracle.shadow(j));
      for (std::size_t k = 0; k < u.size(); ++k) left[k] = left[k] && !u[k];
      const auto gamma = oracle.constant_gamma(u);
      ASSERT_TRUE(gamma.has_value());
      const bool leaves_upright = std::ranges::none_of(
          oracle.border(u), [&](const auto& exit) { return world.sheets.sign(exit.lift) < 0; });
      EXPECT_TRUE(!leaves_upright || *gamma > 0) << *gamma;
      ++components;
      not_one += *gamma != 1;
    }
  });
  EXPECT_GT(components, 150);
  EXPECT_GT(not_one, 20);
}

TEST(Lemma31, ARegionsBorderIsMappedOneToOneOntoThatOfItsShadow) {
  for_tangles(60, [](const World& world, Random&) {
    for (const int i : world.all_components()) {
      const auto region = world.oracle.region(i);
      EXPECT_TRUE(world.oracle.is_border_bijective(region.lifts));
      EXPECT_TRUE(world.oracle.is_locally_removable(region.lifts));
    }
  });
}

TEST(Lemma43, ARegionIsTheSmallestAroundEachOfItsComponents) {
  int smaller = 0;
  for_tangles(60, [&](const World& world, Random&) {
    std::vector<LocalRegion> regions;
    for (const int i : world.all_components()) regions.push_back(world.oracle.region(i));
    for (const auto& region : regions) {
      for (const int i : region.components) {
        EXPECT_TRUE(is_subset(regions[i].lifts, region.lifts));
        smaller += regions[i].lifts != region.lifts;
      }
    }
  });
  EXPECT_GT(smaller, 0);
}

TEST(Lemma43, NoRegionIsSmallerThanTheIntersectionOfAllLocallyRemovableOnes) {
  int checked = 0;
  for_tangles(60, [&](const World& world, Random&) {
    if (world.sheets.n_components() > 8 || world.sheets.n_lifts() > 4000) return;
    for (const int i : world.all_components()) {
      EXPECT_EQ(world.oracle.minimum(i), world.oracle.region(i).lifts);
      ++checked;
    }
  });
  EXPECT_GT(checked, 50);
}

TEST(Theorem51, TheRegionsTogetherAreTheConflictSetOfAllComponents) {
  for_tangles(60, [](const World& world, Random&) {
    const Lifts all = world.conflict_set(world.all_components());
    Lifts together(all.size(), false);
    for (const int i : world.all_components()) {
      const auto region = world.oracle.region(i);
      EXPECT_TRUE(is_subset(region.lifts, all));
      for (std::size_t k = 0; k < all.size(); ++k) together[k] = together[k] || region.lifts[k];
    }
    EXPECT_EQ(together, all);
  });
}

}  // namespace
}  // namespace kinemesh::test
