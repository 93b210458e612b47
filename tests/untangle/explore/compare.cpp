#include "tests/untangle/explore/compare.h"

#include <algorithm>
#include <map>
#include <ostream>

#include "kinemesh/build.h"
#include "kinemesh/local.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/validate.h"
#include "tests/untangle/explore/local_oracle.h"
#include "untangle/explore/local_exploration.h"

namespace kinemesh::test {
namespace {

// The oracle's answer for one component, with what is counted of it.
struct Expected {
  LocalRegion region;
  bool overstepped, self_overlapping, self_overlapping_here;
};

class Comparison {
 public:
  Comparison(const Mesh& mesh, Subdivision plane, const CompareOptions& options)
      : mesh_(mesh), options_(options), sheets_(mesh, std::move(plane)), oracle_(sheets_) {}

  void run(Counts& counts) {
    for (const Face face : mesh_.faces()) {
      const int component = sheets_.component(face);
      if (component == none) continue;
      const bool first = !expected_.contains(component);
      if (first) {
        expected_.emplace(component, expect(component));
        count(expected_.at(component), counts);
        if (is_small()) compare_minimum(component, counts);
      }
      if (first) compare_repair(face, expected_.at(component));
      if (first || options_.every_seed) compare_seed(face, expected_.at(component), counts);
    }
  }

 private:
  bool is_small() const {
    return sheets_.n_components() <= options_.subsets && sheets_.n_lifts() <= options_.lifts;
  }

  Expected expect(int component) const {
    Expected out{oracle_.region(component), false, false, false};
    EXPECT_TRUE(oracle_.is_locally_removable(out.region.lifts)) << "component " << component;
    EXPECT_TRUE(oracle_.is_border_bijective(out.region.lifts)) << "component " << component;
    out.overstepped = out.region.growths == 0 && oracle_.sketch(component) != out.region.faces;
    out.self_overlapping = oracle_.overlaps_itself(out.region.faces);
    out.self_overlapping_here = oracle_.overlaps_itself(out.region.faces, component);
    return out;
  }

  void compare_minimum(int component, Counts& counts) const {
    EXPECT_EQ(oracle_.minimum(component), expected_.at(component).region.lifts) << "component " << component;
    ++counts.minima;
  }

  void compare_seed(Face face, const Expected& expected, Counts& counts) const {
    const auto& region = expected.region;
    LocalExploration fast(mesh_);
    const std::string seed = "seed " + std::to_string(mesh_.user_face(face));
    EXPECT_TRUE(fast.run(face)) << seed;
    EXPECT_EQ(fast.faces(), region.faces) << seed;
    EXPECT_EQ(fast.explored(), static_cast<int>(region.faces.size())) << seed;
    EXPECT_EQ(fast.inverted(), region.inverted) << seed;
    EXPECT_EQ(fast.components(), static_cast<int>(region.components.size())) << seed;
    EXPECT_EQ(fast.gamma_first_stable(), region.gamma_first_stable) << seed;
    EXPECT_EQ(fast.gamma(), 1) << seed;
    EXPECT_EQ(fast.rounds() > 0, region.growths > 0) << seed;
    EXPECT_EQ(fast.grown() > 0, region.growths > 0) << seed;
    ++counts.seeds;
  }

  void compare_repair(Face face, const Expected& expected) const {
    Mesh mesh = mesh_;
    const std::array<Face, 1> seeds{face};
    const auto outcome = LocalUntangling().repair_seeds(mesh, seeds, {});
    ASSERT_TRUE(outcome) << outcome.defect->message();
    const auto& region = outcome.record.regions.at(0);
    EXPECT_FALSE(region.fallback) << region.seed;
    EXPECT_TRUE(std::ranges::equal(region.faces, expected.region.faces)) << region.seed;
    EXPECT_EQ(region.self_overlap, expected.self_overlapping) << region.seed;
    EXPECT_EQ(region.seed, mesh_.user_face(face));
    const auto defect = validate_connectivity(mesh);
    EXPECT_FALSE(defect) << region.seed << ": " << defect->message();
  }

  static void count(const Expected& expected, Counts& counts) {
    const auto& region = expected.region;
    ++counts.regions;
    counts.extended += region.components.size() > 1;
    counts.gamma_2 += region.gamma_first_stable >= 2;
    counts.grown_twice += region.growths > 1;
    counts.overstepped += expected.overstepped;
    counts.self_overlapping += expected.self_overlapping;
    counts.self_overlapping_here += expected.self_overlapping_here;
    counts.largest = std::max(counts.largest, static_cast<int>(region.faces.size()));
  }

  const Mesh& mesh_;
  CompareOptions options_;
  Sheets sheets_;
  LocalOracle oracle_;
  std::map<int, Expected> expected_;
};

}  // namespace

std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.tangled << " tangled meshes\n"
             << c.valid << " valid meshes\n"
             << c.degenerate << " meshes left out, not in general position\n"
             << c.seeds << " seeds explored from\n"
             << c.regions << " inverted components\n"
             << c.minima << " whose region was compared with the minimum over all subsets\n"
             << c.extended << " whose region has further components\n"
             << c.gamma_2 << " first stable with gamma >= 2\n"
             << c.grown_twice << " grown more than once\n"
             << c.overstepped << " overstepped by walking whole faces\n"
             << c.self_overlapping << " whose region overlaps itself\n"
             << c.self_overlapping_here << " whose region overlaps itself over their own shadow\n"
             << c.largest << " faces in the largest region\n";
}

void compare(const MeshData& tangle, const std::string& name, Counts& counts, const CompareOptions& options) {
  SCOPED_TRACE(name);
  const Mesh mesh = build_mesh(tangle);
  auto plane = subdivide(mesh);
  if (!is_general(mesh, plane)) {
    ++counts.degenerate;
    return;
  }
  const bool failed_before = ::testing::Test::HasFailure();
  const int seeds_before = counts.seeds;
  try {
    Comparison(mesh, std::move(plane), options).run(counts);
  } catch (const std::logic_error& error) {
    ADD_FAILURE() << error.what();
  }
  ++(counts.seeds > seeds_before ? counts.tangled : counts.valid);
  if (::testing::Test::HasFailure() && !failed_before) {
    write_mesh(::testing::TempDir() + name + ".off", tangle);
  }
}

}  // namespace kinemesh::test
