// One repair of a mesh that jitter has tangled: replacing the regions against rebuilding everything.
#include <benchmark/benchmark.h>

#include <string>

#include "core/base/stopwatch.h"
#include "inputs.h"
#include "kinemesh/strategy.h"
#include "kinemesh/validate.h"

namespace kinemesh::bench {
namespace {

void report(benchmark::State& state, const RepairRecord& record, const Mesh& mesh) {
  state.counters["inverted"] = record.inverted;
  state.counters["replaced_%"] = 100.0 * record.replaced / mesh.n_faces();
  state.counters["detect_ms"] = record.detect_ms;
  state.counters["explore_ms"] = record.explore_ms;
  state.counters["triangulate_ms"] = record.triangulate_ms;
  state.counters["splice_ms"] = record.splice_ms;
}

// Arguments: vertices, amplitude of the jitter in thousandths of the spacing. The copy of the mesh, which
// each repair needs anew, is not timed; the strategy's scratch memory is warm but for the first time.
void repair(benchmark::State& state, const std::string& name) {
  const int vertices = static_cast<int>(state.range(0));
  const auto positions = jittered(vertices, 0.001 * static_cast<double>(state.range(1)));
  const auto strategy = make_strategy(name);
  for (auto _ : state) {
    Mesh mesh = square_mesh(vertices);
    auto moved = positions;
    mesh.swap_positions(moved);
    const Stopwatch stopwatch;
    const RepairOutcome outcome = strategy->repair(mesh, {});
    state.SetIterationTime(1e-3 * stopwatch.milliseconds());
    if (!outcome) return state.SkipWithError(outcome.defect->message().c_str());
    if (const auto defect = validate(mesh)) return state.SkipWithError(defect->message().c_str());
    report(state, outcome.record, mesh);
  }
}

void sizes_and_amplitudes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"vertices", "jitter"})->UseManualTime()->Unit(benchmark::kMillisecond);
  for (const int vertices : {100'000, 1'000'000})
    for (const int thousandths : {10, 50, 200}) benchmark->Args({vertices, thousandths});
}

BENCHMARK_CAPTURE(repair, global, "global")->Apply(sizes_and_amplitudes);
BENCHMARK_CAPTURE(repair, local, "local")->Apply(sizes_and_amplitudes);
BENCHMARK_CAPTURE(repair, remesh, "remesh")->Apply(sizes_and_amplitudes);

}  // namespace
}  // namespace kinemesh::bench
