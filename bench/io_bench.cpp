// Mesh files in memory: text out, and the same mesh back in.
#include <benchmark/benchmark.h>

#include <string>

#include "inputs.h"
#include "kinemesh/mesh_io.h"

namespace kinemesh::bench {
namespace {

constexpr int vertices = 100'000;

void count(benchmark::State& state, const std::string& text) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
  state.SetItemsProcessed(state.iterations() * square(vertices).n_faces());
}

void write(benchmark::State& state, Format format) {
  std::string text;
  for (auto _ : state) text = format_mesh(square(vertices), format);
  count(state, text);
}

void read(benchmark::State& state, Format format) {
  const std::string text = format_mesh(square(vertices), format);
  for (auto _ : state) {
    const MeshData mesh = parse_mesh(text, format, "in memory").mesh;
    if (mesh.points != square(vertices).points || mesh.triangles != square(vertices).triangles)
      return state.SkipWithError("another mesh came back");
  }
  count(state, text);
}

const bool is_registered = [] {
  for (const FormatInfo& info : formats()) {
    const std::string name(info.name);
    const auto add = [&](const char* what, auto* function) {
      benchmark::RegisterBenchmark((what + name).c_str(), function, info.format)
          ->Unit(benchmark::kMillisecond);
    };
    if (info.can_write) add("write/", write);
    if (info.can_read) add("read/", read);
  }
  return true;
}();

}  // namespace
}  // namespace kinemesh::bench
