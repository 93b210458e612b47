// The mesher for small regions against the one for all.
#include "untangle/fill/small_region_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kinemesh/predicates.h"
#include "tests/untangle/random_tangles.h"
#include "untangle/fill/region_mesher.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh {
namespace {

using test::Random;

// From the smallest corner on, ascending.
std::vector<MeshTriangle> sorted(std::vector<MeshTriangle> triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Every side has one neighbour that agrees, or one side of the border that runs along it.
bool is_linked(const Mesh& mesh, const NewFaces& faces) {
  std::set<Side> border;
  for (int t = 0; t < faces.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const MeshEdge ends{faces.triangles[t][k], faces.triangles[t][(k + 1) % 3]};
      const int across = faces.neighbours[t][k];
      if (across < 0) {
        const Side side(~across);
        if (MeshEdge{mesh.from(side), mesh.to(side)} != ends || !border.insert(side).second) return false;
        continue;
      }
      const auto& back = faces.neighbours[across];
      const auto j = std::find(back.begin(), back.end(), t) - back.begin();
      if (j == 3 || MeshEdge{faces.triangles[across][(j + 1) % 3], faces.triangles[across][j]} != ends)
        return false;
    }
  }
  return true;
}

// No corner across a side strictly inside a face's circle.
bool is_delaunay(const Mesh& mesh, const NewFaces& faces) {
  const auto at = [&](Vertex v) { return mesh.position(v); };
  for (int t = 0; t < faces.size(); ++t) {
    const auto [a, b, c] = faces.triangles[t];
    if (orientation(at(a), at(b), at(c)) != Orientation::CounterClockwise) return false;
    for (const int across : faces.neighbours[t]) {
      if (across < 0) continue;
      for (const Vertex d : faces.triangles[across])
        if (in_circle(at(a), at(b), at(c), at(d)) == InCircle::Inside) return false;
    }
  }
  return true;
}

struct Tally {
  int meshed = 0, with_inner_vertices = 0, equal = 0, refused = 0, refused_by_both = 0;
};

void compare(const Mesh& mesh, const FaceSets& sets, int set, Tally& tally) {
  SmallRegionMesher small;
  RegionMesher general;
  Hole hole;
  hole.dig(mesh, sets, set);
  const bool meshed = small.run(mesh, hole);
  const auto result = general.run_generally(mesh, hole);
  if (!meshed) {
    ++tally.refused;
    tally.refused_by_both += result != RegionMesher::Result::Done;
    return;
  }
  ASSERT_EQ(result, RegionMesher::Result::Done);
  const auto& faces = small.new_faces();
  ASSERT_EQ(faces.size(), static_cast<int>(sets.faces(set).size()));
  EXPECT_TRUE(is_linked(mesh, faces));
  EXPECT_TRUE(is_delaunay(mesh, faces));
  EXPECT_TRUE(is_delaunay(mesh, general.new_faces()));
  ++tally.meshed;
  int n_border = 0;
  for (const auto& n : faces.neighbours)
    n_border += static_cast<int>(std::count_if(n.begin(), n.end(), [](int across) { return across < 0; }));
  tally.with_inner_vertices += n_border < faces.size() + 2;
  tally.equal += sorted(faces.triangles) == sorted(general.new_faces().triangles);
}

void compare_regions(const Mesh& mesh, Tally& tally) {
  FaceSets regions;
  GlobalWalk().run(mesh, detect(mesh), regions);
  for (int region = 0; region < regions.count(); ++region) compare(mesh, regions, region, tally);
}

// Sets nobody would re-mesh: faces in the order they are met from a random one on, some left out.
void compare_blobs(const Mesh& mesh, Random& random, Tally& tally) {
  for (int i = 0; i < 10; ++i) {
    FaceSets sets;
    sets.reset(mesh.n_faces());
    const int set = sets.open();
    const auto size = static_cast<std::size_t>(1 + random.below(SmallRegionMesher::max_faces));
    std::vector<Face> met{Face(random.below(mesh.n_faces()))};
    std::set<Face> seen(met.begin(), met.end());
    for (std::size_t next = 0; next < met.size() && sets.faces(set).size() < size; ++next) {
      if (next > 0 && random.one_in(6)) continue;
      sets.add(met[next], set);
      for (const Side side : Mesh::sides(met[next])) {
        const Face across = mesh.face_across(side);
        if (across != none && seen.insert(across).second) met.push_back(across);
      }
    }
    sets.sort(set);
    compare(mesh, sets, set, tally);
  }
}

TEST(SmallRegionMesher, FindsWhatTheGeneralOneFinds) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 8000; ++seed) {
    SCOPED_TRACE(seed);
    compare_regions(test::random_tangle(seed).mesh, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.meshed, 2000);
  EXPECT_GT(tally.with_inner_vertices, 100);
  EXPECT_EQ(tally.equal, tally.meshed);  // nothing cocircular
}

TEST(SmallRegionMesher, FindsADelaunayTriangulationAmongDegeneratePositions) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 2500; ++seed) {
    SCOPED_TRACE(seed);
    compare_regions(test::lattice_tangle(seed).mesh, tally);
    compare_regions(test::polyomino_tangle(seed).mesh, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.meshed, 500);
  EXPECT_LT(tally.equal, tally.meshed);  // squares have two diagonals
}

TEST(SmallRegionMesher, MeshesNothingThatTheGeneralOneRefuses) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    compare_blobs(test::random_tangle(seed).mesh, random, tally);
    compare_blobs(test::lattice_tangle(seed).mesh, random, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.meshed, 500);
  EXPECT_GT(tally.refused_by_both, 500);
  EXPECT_GT(tally.refused, tally.refused_by_both);  // holes and pinches are left to the general one
}

}  // namespace
}  // namespace kinemesh
