#include "sim/run/series.h"

#include <algorithm>

#include "sim/run/run_directory.h"

namespace kinemesh {

MeshSeries::MeshSeries(const std::filesystem::path& directory, const Mesh& initial)
    : directory_(directory),
      initial_(initial.user_positions()),
      state_{.replaced = std::vector<std::uint8_t>(initial.n_faces(), 0),
             .region = std::vector<int>(initial.n_faces(), none)} {}

MeshSeries::MeshSeries(const std::filesystem::path& directory, const Mesh& initial, SeriesState state)
    : directory_(directory), initial_(initial.user_positions()), state_(std::move(state)) {
  std::vector<std::string> kept;
  for (const auto& entry : state_.entries) kept.push_back(entry.file);
  write_pvd(index_file(), state_.entries);
  remove_later_meshes(directory_, kept);
}

void MeshSeries::note_step(const StepRecord& record, std::span<const Face> flipped_faces) {
  for (const Face face : flipped_faces) state_.replaced[face] = 1;
  std::fill(state_.region.begin(), state_.region.end(), none);
  const auto& regions = record.repair.regions;
  for (size_t i = 0; i < regions.size(); ++i) {
    for (const Face face : regions[i].faces) {
      state_.region[face] = static_cast<int>(i);
      if (!std::binary_search(regions[i].kept.begin(), regions[i].kept.end(), face))
        state_.replaced[face] = 1;
    }
  }
}

void MeshSeries::write(const Mesh& mesh, int step, double time) {
  std::vector<Point> displacement = mesh.user_positions();
  for (size_t v = 0; v < displacement.size(); ++v) displacement[v] -= initial_[v];
  std::vector<std::uint8_t> replaced;
  std::vector<int> region;
  for (const Face face : mesh.faces_in_user_order()) {
    replaced.push_back(state_.replaced[face]);
    region.push_back(state_.region[face]);
  }
  const std::string name = mesh_file_name(step);
  VtuFields fields;
  fields.time = time;
  fields.displacement = displacement;
  fields.replaced = replaced;
  fields.region = region;
  write_vtu(directory_ / name, mesh.domain(), fields);
  state_.entries.push_back({time, name});
  try {
    write_pvd(index_file(), state_.entries);
  } catch (...) {
    state_.entries.pop_back();
    std::filesystem::remove(directory_ / name);
    throw;
  }
  state_.last_written = step;
  std::fill(state_.replaced.begin(), state_.replaced.end(), 0);
}

}  // namespace kinemesh
