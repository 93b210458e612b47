#include "sim/series.h"

#include <algorithm>

#include "sim/run_directory.h"

namespace kinemesh {

MeshSeries::MeshSeries(const std::filesystem::path& directory, const Mesh& initial)
    : directory_(directory),
      initial_(initial.user_positions()),
      replaced_(initial.n_faces(), 0),
      region_(initial.n_faces(), none) {}

void MeshSeries::note_step(const StepRecord& record, std::span<const int> flipped_faces) {
  for (const int face : flipped_faces) replaced_[face] = 1;
  std::fill(region_.begin(), region_.end(), none);
  const auto& regions = record.repair.regions;
  for (size_t i = 0; i < regions.size(); ++i) {
    for (const int face : regions[i].faces) {
      region_[face] = static_cast<int>(i);
      if (!std::binary_search(regions[i].kept.begin(), regions[i].kept.end(), face)) replaced_[face] = 1;
    }
  }
}

void MeshSeries::write(const Mesh& mesh, int step, double time) {
  std::vector<Point> displacement = mesh.user_positions();
  for (size_t v = 0; v < displacement.size(); ++v) displacement[v] -= initial_[v];
  std::vector<std::uint8_t> replaced;
  std::vector<int> region;
  for (const int face : mesh.faces_in_user_order()) {
    replaced.push_back(replaced_[face]);
    region.push_back(region_[face]);
  }
  const std::string name = mesh_file_name(step);
  VtuFields fields;
  fields.time = time;
  fields.displacement = displacement;
  fields.replaced = replaced;
  fields.region = region;
  write_vtu(directory_ / name, mesh.domain(), fields);
  last_written_ = step;
  std::fill(replaced_.begin(), replaced_.end(), 0);
  entries_.push_back({time, name});
  write_pvd(index_file(), entries_);
}

}  // namespace kinemesh
