#include "sim/run/checkpoint.h"

#include <cmath>

#include "core/io/atomic_file.h"
#include "core/io/file_error.h"
#include "kinemesh/validate.h"
#include "sim/run/mesh_members.h"

namespace kinemesh {

namespace fs = std::filesystem;
using binary::Is;

// Members in the order of the file; docs/formats.md lists them.

template <class Archive, class S>
requires Is<S, PhaseTimes>
void members(Archive& archive, S& ms) {
  archive(ms.move, ms.interior, ms.detect, ms.explore, ms.triangulate, ms.splice, ms.quality, ms.total,
          ms.write);
}

template <class Archive, class S>
requires Is<S, RunSummary>
void members(Archive& archive, S& totals) {
  archive(totals.steps, totals.time, totals.steps_tangled, totals.inverted, totals.regions,
          totals.region_faces, totals.region_faces_max, totals.replaced, totals.share_mean, totals.share_max,
          totals.escaped_max, totals.retries, totals.quality_flips, totals.quality_moves,
          totals.min_angle_deg, totals.ms);
}

template <class Archive, class S>
requires Is<S, PvdEntry>
void members(Archive& archive, S& entry) {
  archive(entry.time, entry.file);
}

template <class Archive, class S>
requires Is<S, SeriesState>
void members(Archive& archive, S& series) {
  archive(series.replaced, series.region, series.entries, series.last_written);
}

template <class Archive, class S>
requires Is<S, LogLengths>
void members(Archive& archive, S& logs) {
  archive(logs.steps, logs.regions);
}

template <class Archive, class S>
requires Is<S, AdaptiveState>
void members(Archive& archive, S& adaptive) {
  archive(adaptive.position, adaptive.length, adaptive.in_a_row, adaptive.rejected);
}

template <class Archive, class S>
requires Is<S, FollowingState>
void members(Archive& archive, S& following) {
  archive(following.increments, following.dt);
}

template <class Archive, class S>
requires Is<S, Checkpoint>
void members(Archive& archive, S& checkpoint) {
  archive(checkpoint.program, checkpoint.scenario, checkpoint.origin, checkpoint.mesh, checkpoint.time,
          checkpoint.step, checkpoint.adaptive, checkpoint.following, checkpoint.totals, checkpoint.series,
          checkpoint.logs);
}

namespace {

constexpr binary::Kind kind{"KMCHKPT\n", 5, "checkpoint of kinemesh"};

constexpr const char* current_name = "checkpoint.bin";
constexpr const char* previous_name = "checkpoint_prev.bin";
constexpr const char* next_name = "checkpoint_next.bin";

// A run would go on from other numbers for ever.
void check_progress(const Checkpoint& checkpoint) {
  const auto& [position, length, in_a_row, rejected] = checkpoint.adaptive;
  const bool is_good = checkpoint.step >= 0 && std::isfinite(checkpoint.time) && std::isfinite(position) &&
                       position >= 0.0 && std::isfinite(length) && length > 0.0 && in_a_row >= 0;
  if (!is_good) throw InputError("a step or a time that no run has");
}

Restart restart_from(Checkpoint checkpoint, const std::string& scenario) {
  if (const auto differs = scenario_difference(checkpoint.scenario, scenario))
    throw InputError("is of another scenario: " + *differs);
  check_progress(checkpoint);
  Mesh initial = rebuild(checkpoint.origin), mesh = initial;
  restore(mesh, checkpoint.mesh);
  if (const auto defect = validate(mesh)) throw InputError(defect->message());
  const auto n_faces = static_cast<std::size_t>(mesh.n_faces());
  if (checkpoint.series.replaced.size() != n_faces || checkpoint.series.region.size() != n_faces)
    throw InputError("the series of a mesh of another size");
  const auto& increments = checkpoint.following.increments;
  if (!increments.empty() && increments.size() != static_cast<std::size_t>(mesh.n_vertices()))
    throw InputError("the interior of a mesh of another size");
  return {std::move(checkpoint), std::move(initial), std::move(mesh)};
}

Restart read_checkpoint(const fs::path& file, const std::string& scenario) {
  const std::string content = read_file(file);
  try {
    return restart_from(parse_checkpoint(content), scenario);
  } catch (const InputError& error) {
    throw InputError(file.string(), 0, error.what());
  }
}

// Whether the one before can help.
std::string offer(const fs::path& directory, const std::string& scenario) {
  const fs::path previous = directory / previous_name;
  try {
    const int step = read_checkpoint(previous, scenario).checkpoint.step;
    return std::string("; ") + previous_name + " is whole, of step " + std::to_string(step) +
           ": rename it to " + current_name + " to go on from there";
  } catch (const InputError&) {
    return std::string("; no whole ") + previous_name + " beside it, --force starts anew";
  }
}

void rename_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) io::fail(to, "cannot be put in place", error.value());
}

}  // namespace

std::string format_checkpoint(const Checkpoint& checkpoint) {
  return binary::seal(kind, binary::bytes_of(checkpoint));
}

Checkpoint parse_checkpoint(std::string_view content) {
  return binary::parsed<Checkpoint>(binary::unseal(kind, content));
}

void write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint) {
  write_file_atomically(directory / next_name, format_checkpoint(checkpoint));
  if (fs::exists(directory / current_name)) rename_file(directory / current_name, directory / previous_name);
  rename_file(directory / next_name, directory / current_name);
  flush_directory(directory);
}

std::optional<Restart> last_checkpoint(const fs::path& directory, const std::string& scenario) {
  const fs::path current = directory / current_name, previous = directory / previous_name;
  if (!fs::exists(current))
    return fs::exists(previous) ? std::optional(read_checkpoint(previous, scenario)) : std::nullopt;
  try {
    return read_checkpoint(current, scenario);
  } catch (const InputError& error) {
    throw InputError(error.what() + offer(directory, scenario));
  }
}

}  // namespace kinemesh
