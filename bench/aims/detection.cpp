// The sweep for inverted faces, against a plain read of the arrays it reads.
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "sim/step/threads.h"
#include "untangle/walk/detect.h"

namespace kinemesh::aims {
namespace {

constexpr int repeats = 31;

// All words added up, in four sums that do not wait for each other.
template <class T>
std::uint64_t read_all(std::span<const T> values) {
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  const std::size_t n = values.size_bytes() / 8;
  std::uint64_t sums[4] = {0, 0, 0, 0};
  for (std::size_t i = 0; i + 4 <= n; i += 4) {
    std::uint64_t words[4];
    std::memcpy(words, bytes + 8 * i, sizeof words);
    for (int k = 0; k < 4; ++k) sums[k] += words[k];
  }
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

void detection(int n) {
  const ThreadLimit one(1);
  const Move move = jitter_of(n, 0.01);
  const Mesh& mesh = move.mesh;
  require_valid(mesh);
  std::vector<double> sweeps, reads;
  volatile std::uint64_t sum = 0;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch sweeping;
    if (!detect(mesh).empty()) throw std::logic_error("a valid mesh has tangles");
    sweeps.push_back(sweeping.milliseconds());
    const Stopwatch reading;
    sum = sum + read_all(mesh.positions()) + read_all(mesh.triangles());
    reads.push_back(reading.milliseconds());
  }
  const double sweep = median(sweeps), read = median(reads);
  const auto detail = fmt::format("{} faces; sweep {:.3g} ms; read {:.3g} ms", mesh.n_faces(), sweep, read);
  report({"detection / streaming read", Aim::Kind::AtMost, 2.5, sweep / read, detail});
  report({"detection, ns per triangle", Aim::Kind::AtMost, 2.5, 1e6 * sweep / mesh.n_faces(), detail});
}

}  // namespace kinemesh::aims
