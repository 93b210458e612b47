// The phases of a repair by themselves: the walk of `global`, one exploration of `local` after the other,
// re-meshing, splicing. An item is a face of a region.
#include <benchmark/benchmark.h>

#include <memory>

#include "inputs.h"
#include "kinemesh/validate.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/fill/region_repair.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh::bench {
namespace {

constexpr int vertices = 100'000;

Mesh tangled(benchmark::State& state) {
  Mesh mesh = square_mesh(vertices);
  auto moved = jittered(vertices, 0.001 * static_cast<double>(state.range(0)));
  mesh.swap_positions(moved);
  return mesh;
}

std::int64_t faces_in(const FaceSets& regions) {
  std::int64_t faces = 0;
  for (int region = 0; region < regions.count(); ++region)
    faces += static_cast<std::int64_t>(regions.faces(region).size());
  return faces;
}

void global_walk(benchmark::State& state) {
  const Mesh mesh = tangled(state);
  const auto tangles = detect(mesh);
  GlobalWalk walk;
  FaceSets regions;
  for (auto _ : state) walk.run(mesh, tangles, regions);
  state.SetItemsProcessed(state.iterations() * faces_in(regions));
}

void local_exploration(benchmark::State& state) {
  const Mesh mesh = tangled(state);
  const auto inverted = detect(mesh).inverted;
  std::int64_t explored = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < inverted.size(); i += 1 + inverted.size() / 100) {
      LocalExploration exploration(mesh);
      if (exploration.run(inverted[i])) explored += exploration.explored();
    }
  }
  state.SetItemsProcessed(explored);
}

// The regions of a mesh, and how they are re-meshed.
struct Work {
  Mesh mesh;
  RegionRepair repair;

  bool remesh() {
    repair.start();
    return !repair.remesh_new(mesh, {}) && !repair.remesh_touching(mesh, {});
  }
};

std::unique_ptr<Work> work_of(benchmark::State& state) {
  auto work = std::make_unique<Work>();
  work->mesh = tangled(state);
  GlobalWalk().run(work->mesh, detect(work->mesh), work->repair.regions());
  return work;
}

void remesh_regions(benchmark::State& state) {
  const auto work = work_of(state);
  for (auto _ : state)
    if (!work->remesh()) return state.SkipWithError("there is no valid mesh");
  state.SetItemsProcessed(state.iterations() * faces_in(work->repair.regions()));
}

void splice_regions(benchmark::State& state) {
  const auto work = work_of(state);
  if (!work->remesh()) return state.SkipWithError("there is no valid mesh");
  Mesh mesh;
  for (auto _ : state) {
    state.PauseTiming();
    mesh = work->mesh;
    state.ResumeTiming();
    for (int region = 0; region < work->repair.regions().count(); ++region)
      mesh.splice(work->repair.patch(region).patch);
  }
  if (const auto defect = validate(mesh)) return state.SkipWithError(defect->message().c_str());
  state.SetItemsProcessed(state.iterations() * faces_in(work->repair.regions()));
}

void amplitudes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("jitter")->Arg(50)->Arg(200)->Unit(
      benchmark::kMillisecond);  // thousandths of the spacing
}

BENCHMARK(global_walk)->Apply(amplitudes);
BENCHMARK(local_exploration)->Apply(amplitudes);
BENCHMARK(remesh_regions)->Apply(amplitudes);
BENCHMARK(splice_regions)->Apply(amplitudes);

}  // namespace
}  // namespace kinemesh::bench
