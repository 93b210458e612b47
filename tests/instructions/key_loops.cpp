// The loops that a step spends its time in, once each, for counting their instructions: between two lines of
// this program callgrind counts, and writes what it has counted under the loop's name. One thread, fixed
// seeds.
#include <tbb/global_control.h>
#include <valgrind/callgrind.h>

#include <cstdio>
#include <stdexcept>

#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/motion.h"
#include "kinemesh/predicates.h"
#include "kinemesh/shapes.h"
#include "kinemesh/validate.h"
#include "motion/fields/noise.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/fill/region_repair.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh {
namespace {

constexpr int vertices = 20'000;

template <class Loop>
void count(const char* name, const Loop& loop) {
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  loop();
  CALLGRIND_TOGGLE_COLLECT;
  CALLGRIND_DUMP_STATS_AT(name);
}

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

// By itself, so that its instructions do not depend on what else is in this file.
[[gnu::noinline]] void count_predicates(const Mesh& mesh) {
  const auto x = mesh.positions();
  int upright = 0, inside = 0;
  count("orientation", [&] {
    for (const auto& t : mesh.triangles())
      upright += orientation(x[t[0]], x[t[1]], x[t[2]]) == Orientation::CounterClockwise;
  });
  count("in_circle", [&] {
    for (Face f{1}; f < mesh.n_faces(); ++f) {
      const auto& t = mesh.triangles()[f];
      inside += in_circle(x[t[0]], x[t[1]], x[t[2]], x[mesh.triangles()[f - 1][0]]) == InCircle::Inside;
    }
  });
  require(upright == mesh.n_faces() && inside < mesh.n_faces(), "a valid mesh has tangles");
}

void count_local(const Mesh& mesh, const Tangles& tangles) {
  int explored = 0;
  count("local exploration", [&] {
    for (std::size_t i = 0; i < tangles.inverted.size(); i += 4) {
      LocalExploration exploration(mesh);
      explored += exploration.run(tangles.inverted[i]) ? exploration.explored() : 0;
    }
  });
  require(explored > 1000, "hardly anything was explored");
}

// As `global` does it, in a mesh that is valid again in the end.
void count_repair(Mesh& mesh) {
  Tangles tangles;
  FaceMinima minima;
  count("detect", [&] { tangles = detect(mesh, &minima); });
  require(tangles.inverted.size() > 1000, "hardly any tangles");
  count_local(mesh, tangles);
  GlobalWalk walk;
  RegionRepair repair;
  count("global walk", [&] { walk.run(mesh, tangles, repair.regions()); });
  repair.start();
  count("re-mesh", [&] {
    require(!repair.remesh_new(mesh, {}) && !repair.remesh_touching(mesh, {}), "there is no valid mesh");
  });
  count("splice", [&] {
    for (int region = 0; region < repair.regions().count(); ++region) mesh.splice(repair.patch(region).patch);
  });
  require(!validate(mesh), "the repaired mesh is not valid");
}

void count_all() {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const MeshData data = make_square(vertices);
  Mesh mesh;
  count("build", [&] { mesh = build_mesh(data, {.frame = 0.25}); });
  count_predicates(mesh);
  double angle = 0.0;
  count("measure", [&] { angle = measure(mesh).min_angle_deg; });
  require(angle > 0.0, "a valid mesh has a flat face");
  const Motion motion(mesh, {{std::make_shared<Jitter>(0.2, 1), {}}});
  std::vector<Point> moved(mesh.n_vertices());
  count("move", [&] { motion.advance(mesh.positions(), 0.0, 1.0, 0, moved); });
  mesh.swap_positions(moved);
  count_repair(mesh);
}

}  // namespace
}  // namespace kinemesh

int main() try { kinemesh::count_all(); } catch (const std::exception& error) {
  std::fprintf(stderr, "key_loops: %s\n", error.what());
  return 1;
}
