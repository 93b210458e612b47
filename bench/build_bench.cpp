// From arrays to a mesh, with and without padding to fill in, and the sweep over it.
#include <benchmark/benchmark.h>

#include "inputs.h"
#include "kinemesh/build.h"
#include "kinemesh/shapes.h"
#include "kinemesh/validate.h"
#include "untangle/walk/detect.h"

namespace kinemesh::bench {
namespace {

void build(benchmark::State& state) {
  const MeshData& data = square(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const Mesh mesh = build_mesh(data);
    state.PauseTiming();
    if (const auto defect = validate(mesh)) state.SkipWithError(defect->message().c_str());
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * data.n_faces());
}

// A hole, and a frame around it all.
void build_padded(benchmark::State& state) {
  static const MeshData data = make_annulus(100'000);
  for (auto _ : state) {
    const Mesh mesh = build_mesh(data, {.frame = 0.25});
    state.PauseTiming();
    if (const auto defect = validate(mesh)) state.SkipWithError(defect->message().c_str());
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * data.n_faces());
}

void sweep(benchmark::State& state) {
  const Mesh& mesh = square_mesh(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    if (!detect(mesh).empty()) state.SkipWithError("a valid mesh has tangles");
  }
  state.SetItemsProcessed(state.iterations() * mesh.n_faces());
}

BENCHMARK(build)->Arg(100'000)->Arg(500'000)->Unit(benchmark::kMillisecond);
BENCHMARK(build_padded)->Unit(benchmark::kMillisecond);
BENCHMARK(sweep)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinemesh::bench
