// The meshes of a run as a time series that ParaView opens. Internal to sim/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/stepper.h"
#include "kinemesh/vtu.h"

namespace kinemesh {

// What a series remembers between steps.
struct SeriesState {
  std::vector<std::uint8_t> replaced = {};  // per face of the mesh, padding included: since the last file
  std::vector<int> region = {};             // likewise, of the last step
  std::vector<PvdEntry> entries = {};
  int last_written = none;  // step
};

// mesh_NNNNNN.vtu and mesh.pvd. Cell data: `label`, `replaced` (since the file before, by a repair or by
// flips after it), `region` (number of the step's region that put the face there, or none);
// point data: `displacement` since the start.
class MeshSeries {
 public:
  MeshSeries(const std::filesystem::path& directory, const Mesh& initial);

  // Goes on with a series, of a mesh with as many faces: drops meshes that are not in the state's entries.
  MeshSeries(const std::filesystem::path& directory, const Mesh& initial, SeriesState state);

  // Call after each accepted step, written or not.
  void note_step(const StepRecord& record, std::span<const Face> flipped_faces);

  // The files stay as they were if it throws InputError, which names the file. The .pvd never names a file
  // that is not there.
  void write(const Mesh& mesh, int step, double time);

  int last_written() const { return state_.last_written; }  // step, or none
  const SeriesState& state() const { return state_; }
  std::filesystem::path index_file() const { return directory_ / "mesh.pvd"; }

 private:
  std::filesystem::path directory_;
  std::vector<Point> initial_;  // user's order
  SeriesState state_;
};

}  // namespace kinemesh
