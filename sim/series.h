// The meshes of a run as a time series that ParaView opens. Internal to sim/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/io/vtu.h"
#include "core/mesh.h"
#include "sim/stepper.h"

namespace kinemesh {

// mesh_NNNNNN.vtu and mesh.pvd. Cell data: `label`, `replaced` (since the file before, by a repair or by
// flips after it), `region` (number of the step's region that put the face there, or none); point data: `displacement` since the start.
class MeshSeries {
 public:
  MeshSeries(const std::filesystem::path& directory, const Mesh& initial);

  // Call after each accepted step, written or not.
  void note_step(const StepRecord& record, std::span<const int> flipped_faces);

  // Each throws InputError naming the file. The .pvd never names a file that is not there.
  void write(const Mesh& mesh, int step, double time);

  int last_written() const { return last_written_; }  // step, or none
  std::filesystem::path index_file() const { return directory_ / "mesh.pvd"; }

 private:
  std::filesystem::path directory_;
  std::vector<Point> initial_;          // user's order
  std::vector<std::uint8_t> replaced_;  // per face of the mesh, padding included
  std::vector<int> region_;             // likewise, of the last step
  std::vector<PvdEntry> entries_;
  int last_written_ = none;
};

}  // namespace kinemesh
