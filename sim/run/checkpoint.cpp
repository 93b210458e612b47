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

namespace {

constexpr binary::FileKind kind{"KMCHKPT\n", "checkpoint of kinemesh", "that version can go on from it"};

// What goes by the mesh's numbers, in the user's order, as the file has it.
SeriesState sorted(SeriesState series, const MeshOrder& order) {
  series.replaced = in_user_order(series.replaced, order.faces);
  series.region = in_user_order(series.region, order.faces);
  return series;
}

FollowingState sorted(FollowingState following, const MeshOrder& order) {
  if (!following.increments.empty())
    following.increments = in_user_order(following.increments, order.vertices);
  return following;
}

// And back.
SeriesState placed(SeriesState series, const MeshOrder& order) {
  if (series.replaced.size() != order.faces.size() || series.region.size() != order.faces.size())
    throw InputError("the series of a mesh of another size");
  series.replaced = in_mesh_order(series.replaced, order.faces);
  series.region = in_mesh_order(series.region, order.faces);
  return series;
}

FollowingState placed(FollowingState following, const MeshOrder& order) {
  if (following.increments.empty()) return following;
  if (following.increments.size() != order.vertices.size())
    throw InputError("the interior of a mesh of another size");
  following.increments = in_mesh_order(following.increments, order.vertices);
  return following;
}

// In the order of the file.
template <class Sections, class C, class Series, class Following>
void list_sections(Sections& sections, C& checkpoint, Series& series, Following& following) {
  sections({"program", 1}, checkpoint.program);
  sections({"scenario", 1}, checkpoint.scenario);
  base_sections(sections, checkpoint.base);
  sections({"initial", 1}, checkpoint.initial);
  sections({"state", 1}, checkpoint.mesh);
  sections({"time", 1}, checkpoint.time, checkpoint.step, checkpoint.adaptive);
  sections({"interior", 1}, following);
  sections({"totals", 1}, checkpoint.totals);
  sections({"series", 1}, series);
  sections({"logs", 1}, checkpoint.logs);
}

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
  Mesh initial = restore(checkpoint.base, checkpoint.initial);
  Mesh mesh = restore(checkpoint.base, checkpoint.mesh);
  for (const Mesh* one : {&initial, &mesh})
    if (const auto defect = validate(*one)) throw InputError(defect->message());
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
  const MeshOrder& order = checkpoint.base.order;
  const SeriesState series = sorted(checkpoint.series, order);
  const FollowingState following = sorted(checkpoint.following, order);
  binary::SectionWriter writer;
  list_sections(writer, checkpoint, series, following);
  return std::move(writer).file(kind);
}

Checkpoint parse_checkpoint(std::string_view content) {
  binary::SectionReader reader(kind, content);
  Checkpoint checkpoint;
  list_sections(reader, checkpoint, checkpoint.series, checkpoint.following);
  reader.expect_end();
  const MeshOrder& order = checkpoint.base.order;
  require_permutation(order.vertices);
  require_permutation(order.faces);
  checkpoint.series = placed(std::move(checkpoint.series), order);
  checkpoint.following = placed(std::move(checkpoint.following), order);
  return checkpoint;
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
