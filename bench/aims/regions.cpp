// Explore, re-mesh and splice, against CGAL's triangulations of the same regions and nothing else.
#include <fmt/format.h>

#include <stdexcept>

#include "aims.h"
#include "sim/step/threads.h"
#include "untangle/fill/region_mesher.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh::aims {
namespace {

constexpr int repeats = 5;

// Vertices spatially sorted and edges, inserted into an empty triangulation region by region.
double cgal_alone(const Mesh& mesh, const FaceSets& regions) {
  RegionMesher mesher;
  Hole hole;
  for (int region = 0; region < regions.count(); ++region) {
    hole.dig(mesh, regions, region);
    if (mesher.run_generally(mesh, hole) != RegionMesher::Result::Done)
      throw std::logic_error("a region that CGAL does not mesh");
  }
  return mesher.triangulator_ms();
}

double ours(Strategy& strategy, Mesh mesh) {
  const auto outcome = strategy.repair(mesh, {});
  require_valid(outcome);
  require_valid(mesh);
  return outcome.record.explore_ms + outcome.record.triangulate_ms + outcome.record.splice_ms;
}

void measure(const std::string& what, const Move& move) {
  const Mesh mesh = moved(move);
  FaceSets regions;
  GlobalWalk().run(mesh, detect(mesh), regions);
  const auto global = make_strategy("global");
  std::vector<double> repairs, triangulations;
  for (int i = 0; i < repeats; ++i) {
    triangulations.push_back(cgal_alone(mesh, regions));
    repairs.push_back(ours(*global, mesh));
  }
  const double repair = median(repairs), cgal = median(triangulations);
  report({"explore + re-mesh + splice / CGAL's CDT of the regions: " + what, Aim::Kind::AtMost, 1.3,
          repair / cgal,
          fmt::format("{} regions; {:.4g} ms; CGAL {:.4g} ms", regions.count(), repair, cgal)});
}

}  // namespace

void regions_against_cgal(int n) {
  const ThreadLimit one(1);
  measure("rotor", rotor_of(n));
  measure("jitter 0.05", jitter_of(n, 0.05));
  measure("jitter 0.2", jitter_of(n, 0.2));
}

}  // namespace kinemesh::aims
