// All that a run needs to go on as if it had never been interrupted, and the two files that hold it.
//
// Noise has no state of its own: it is a function of vertex, step and seed. Neither have strategies and
// quality passes, whose memory between steps is scratch.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/mesh/mesh_state.h"
#include "kinemesh/run.h"
#include "motion/following.h"
#include "sim/run/adaptive_steps.h"
#include "sim/run/csv_log.h"
#include "sim/run/series.h"

namespace kinemesh {

struct Checkpoint {
  std::string program;   // its version; only to be told
  std::string scenario;  // to_toml
  MeshBase base;
  MeshState initial;  // positions for displacements, weights and border conditions with it
  MeshState mesh;
  double time = 0.0;
  int step = 0;
  AdaptiveState adaptive;    // after that step
  FollowingState following;  // the interior's, likewise
  RunSummary totals;         // without plan, reason to stop and files
  SeriesState series;
  LogLengths logs;
};

// As a file's content; see docs/formats.md.
std::string format_checkpoint(const Checkpoint& checkpoint);

// Throws InputError, without a file's name, for whatever is no whole checkpoint with these sections in these
// versions.
Checkpoint parse_checkpoint(std::string_view content);

// Makes checkpoint.bin of it and checkpoint_prev.bin of what checkpoint.bin was. Each of them is a whole
// checkpoint at any moment, or is not there; one of them always is. Throws InputError naming the file.
void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint);

// A checkpoint with the mesh as it was when the run began and as it had become: put together from the
// checkpoint alone.
struct Restart {
  Checkpoint checkpoint;
  Mesh initial, mesh;
};

// The last one: checkpoint.bin, or checkpoint_prev.bin if there is only that; nothing if there is neither.
// Throws InputError naming the file if it is damaged, no checkpoint, of another version or of another
// scenario (a text as to_toml makes it), and says whether checkpoint_prev.bin can take its place.
std::optional<Restart> last_checkpoint(const std::filesystem::path& directory, const std::string& scenario);

}  // namespace kinemesh
