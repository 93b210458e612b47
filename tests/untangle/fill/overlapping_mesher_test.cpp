// The stages of the construction of Lemma 3.3, one by one.
#include "untangle/fill/overlapping_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "kinemesh/build.h"
#include "kinemesh/local.h"
#include "kinemesh/predicates.h"
#include "kinemesh/validate.h"
#include "tests/untangle/explore/tangles.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/fill/part_gluing.h"
#include "untangle/fill/plane_parts.h"
#include "untangle/fill/shadow_border.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

using Number = ExactKernel::FT;

struct Region {
  Mesh mesh;
  FaceSets sets;
  std::vector<Cell> cells;

  RemeshableSet set() const { return {mesh, sets, 0, cells}; }
};

Region explore(const Mesh& mesh, Face seed) {
  Region region{mesh, {}, {}};
  LocalExploration exploration(mesh);
  EXPECT_TRUE(exploration.run(seed));
  region.cells = exploration.cells();
  region.sets.reset(mesh.n_faces());
  region.sets.open();
  for (const Face face : exploration.faces()) region.sets.add(face, 0);
  return region;
}

// Between an inverted face and an upright one.
std::set<Edge> crease_edges(const MeshData& data) {
  std::map<Edge, std::set<Orientation>> turns;
  for (const auto& [a, b, c] : data.triangles) {
    const auto turn = orientation(data.points[a], data.points[b], data.points[c]);
    for (const auto& [v, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      turns[{std::min(v, w), std::max(v, w)}].insert(turn);
  }
  std::set<Edge> creases;
  for (const auto& [edge, both] : turns)
    if (both == std::set{Orientation::Clockwise, Orientation::CounterClockwise}) creases.insert(edge);
  return creases;
}

//  d-----------c
//  |  .      . |     p has passed q: bqp and dpq are inverted, X is the quadrilateral q b p d. The edge ap
//  |    q - p  |     crosses its side qb, the edge cq its side pd.
//  |  .      . |
//  a-----------b
Region region_of_vertex_behind_another() {
  enum { a, b, c, d, p, q };
  MeshData data;
  data.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {3.5, 2}, {3, 2}};
  data.triangles = {{a, b, p}, {b, q, p}, {b, c, q}, {c, d, q}, {d, p, q}, {d, a, p}};
  const Mesh mesh = build_mesh(data);
  return explore(mesh, detect(mesh).inverted.front());
}

Number twice_area(const std::vector<ExactPoint>& points, const Triangle& t) {
  return CGAL::determinant(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

Number twice_area(const std::vector<ExactPoint>& points, const PlanePart& part) {
  Number sum = 0;
  for (const auto& face : part) sum += twice_area(points, face.corners);
  return sum;
}

// Upright ones less inverted ones.
Number twice_area(const Region& region, const ShadowBorder& border) {
  const auto set = region.set();
  Number sum = 0;
  for (const Face face : set.faces()) sum += twice_area(border.points, set.corners(face));
  return sum;
}

Number twice_area_within(const ShadowBorder& border) {
  Number sum = 0;
  for (const SubSegment& sub : border.subs)
    sum += CGAL::determinant(border.points[sub.from] - CGAL::ORIGIN, border.points[sub.to] - CGAL::ORIGIN);
  return sum;
}

// As many sub-segments end at a vertex as start there.
bool is_closed(const ShadowBorder& border) {
  std::vector<int> balance(border.points.size(), 0);
  for (const auto& sub : border.subs) {
    ++balance[sub.from];
    --balance[sub.to];
  }
  return std::ranges::all_of(balance, [](int n) { return n == 0; });
}

void expect_all_upright(const std::vector<ExactPoint>& points, const PlanePart& part) {
  for (const auto& face : part) EXPECT_GT(twice_area(points, face.corners), 0);
}

TEST(ShadowBorder, IsCutWhereFacesCrossIt) {
  const auto region = region_of_vertex_behind_another();
  const auto set = region.set();
  const auto border = trace_shadow_border(set);
  ASSERT_TRUE(border);
  EXPECT_EQ(border->subs.size(), 6u);
  EXPECT_EQ(border->points.size(), 6u + 2u);
  EXPECT_EQ(border->subs_of.size(), 4u);  // all upright faces
  for (const auto& [face, subs] : border->subs_of) {
    EXPECT_FALSE(set.is_inverted(face));
    for (const int s : subs) EXPECT_EQ(border->subs[s].face, face);
  }
  EXPECT_TRUE(is_closed(*border));
  EXPECT_EQ(twice_area_within(*border), 2);
}

TEST(ShadowBorder, IsNotTiledWhereASheetIsMissing) {
  auto region = region_of_vertex_behind_another();
  const auto is_upright = [&](const Cell& cell) { return !region.set().is_inverted(cell.face); };
  region.cells.erase(std::ranges::find_if(region.cells, is_upright));
  EXPECT_FALSE(trace_shadow_border(region.set()));
}

TEST(ShadowBorder, IsNothingWhereVerticesOfJCoincide) {
  auto region = region_of_vertex_behind_another();
  const auto at = region.mesh.positions();
  at[region.mesh.vertex_of_user(UserVertex(3))] = at[region.mesh.vertex_of_user(UserVertex(1))];
  EXPECT_FALSE(trace_shadow_border(region.set()));
}

TEST(PlaneParts, AreThoseOfTheFacesCrossedAndX) {
  const auto region = region_of_vertex_behind_another();
  const auto border = trace_shadow_border(region.set());
  ASSERT_TRUE(border);
  const auto parts = triangulate_parts(region.set(), *border);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 5u);
  EXPECT_EQ(twice_area(border->points, parts->back()), 2);
  for (const auto& part : *parts) expect_all_upright(border->points, part);
}

TEST(PartGluing, IsNothingWhereAPartIsMissing) {
  const auto region = region_of_vertex_behind_another();
  const auto border = trace_shadow_border(region.set());
  ASSERT_TRUE(border);
  auto parts = triangulate_parts(region.set(), *border);
  ASSERT_TRUE(parts);
  EXPECT_TRUE(glue_parts(region.set(), *border, *parts));
  parts->pop_back();
  EXPECT_FALSE(glue_parts(region.set(), *border, *parts));
}

// Across every side is one thing, and a face there has the side's ends.
void expect_linked(const PlanePart& part) {
  for (const auto& face : part) {
    for (int k = 0; k < 3; ++k) {
      const auto& side = face.sides[k];
      EXPECT_EQ((side.face != none) + (side.sub != none) + (side.mesh_side != none), 1);
      if (side.face == none) continue;
      const auto& beyond = part[side.face].corners;
      EXPECT_TRUE(std::ranges::count(beyond, face.corners[k]) == 1 &&
                  std::ranges::count(beyond, face.corners[(k + 1) % 3]) == 1);
    }
  }
}

void expect_stages(const Region& region) {
  const auto set = region.set();
  const auto border = trace_shadow_border(set);
  ASSERT_TRUE(border);
  EXPECT_TRUE(is_closed(*border));

  const auto parts = triangulate_parts(set, *border);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->size(), border->subs_of.size() + 1);
  Number sum = 0;
  for (const auto& part : *parts) {
    expect_linked(part);
    expect_all_upright(border->points, part);
    sum += twice_area(border->points, part);
  }
  EXPECT_EQ(sum, twice_area(region, *border));
  EXPECT_EQ(twice_area(border->points, parts->back()), twice_area_within(*border));

  const auto faces = glue_parts(set, *border, *parts);
  ASSERT_TRUE(faces);
  Number glued = 0;
  for (const auto& [a, b, c] : faces->triangles)
    glued += twice_area(border->points, {set.number(a), set.number(b), set.number(c)});
  EXPECT_EQ(glued, twice_area(region, *border));
}

// Whether the region overlaps itself does not matter here.
TEST(OverlappingMesher, WorksStageByStageOnRandomTangles) {
  int regions = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = build_mesh(random_tangle(seed));
    std::set<std::vector<Face>> seen;
    for (const Face face : detect(mesh).inverted) {
      const auto region = explore(mesh, face);
      if (!seen.insert(region.sets.faces(0)).second) continue;
      expect_stages(region);
      ++regions;
    }
  }
  EXPECT_GT(regions, 100);
}

// A crease edge that is constrained lies on the border of X where no other piece covers it, and inside X
// elsewhere: there are extra vertices on it, and it has to be one edge again.
TEST(OverlappingMesher, KeepsConstrainedCreases) {
  int overlapping = 0, repaired = 0;
  std::vector<std::uint64_t> seeds{301848, 301064, 302915, 304552, 302883, 304098, 304182};
  for (std::uint64_t seed = 1; seed <= 150; ++seed) seeds.push_back(seed);
  for (const std::uint64_t seed : seeds) {
    MeshData data = random_tangle(seed);
    if (data.n_faces() > 60) continue;
    for (const Edge& crease : crease_edges(data)) {
      data.markers = {{"line", {crease}}};
      const Mesh mesh = build_mesh(data);
      for (const Face face : detect(mesh).inverted) {
        Mesh mended = mesh;
        const auto outcome =
            LocalUntangling().repair_seeds(mended, std::array{face}, {.allow_escaped = true});
        if (!outcome) continue;
        const auto defect = validate_connectivity(mended);
        ASSERT_FALSE(defect) << seed << " " << crease[0] << "-" << crease[1] << ": " << defect->message();
        overlapping += outcome.record.regions[0].self_overlap;
        ++repaired;
      }
    }
  }
  EXPECT_GT(repaired, 1000);
  EXPECT_GT(overlapping, 5);
  RecordProperty("overlapping", overlapping);
}

}  // namespace
}  // namespace kinemesh::test
