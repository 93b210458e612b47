// Runs a scenario: steps, logs, files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kinemesh/scenario.h"
#include "kinemesh/stepper.h"

#pragma GCC visibility push(default)
namespace kinemesh {

struct RunOptions {
  std::filesystem::path directory;  // empty: the scenario's name in the current folder
  bool force = false;               // a run that is already there makes way
  bool dump_on_failure = false;     // failed_step.bin of a step without valid mesh, for replay
  bool resume = false;              // goes on with the run that is there from its last checkpoint
  bool dry_run = false;             // check everything, step nothing, write nothing
  int threads = 0;                  // 0: all cores
  std::vector<std::string> argv;    // for run.json
  bool stop_on_signals = true;      // SIGINT and SIGTERM end the run after the step
};

// Known before the first step.
struct RunPlan {
  std::filesystem::path directory;
  std::string strategy;
  int steps = 0;
  int steps_done = 0;        // before, by the run that is resumed
  bool is_adaptive = false;  // `steps` are as many as it takes if none is halved or doubled
  double start_time = 0.0;   // of the steps to come
  double end_time = 0.0;
  int threads = 1;
  int vertices = 0, faces = 0;  // of the domain
  int padding_faces = 0;
  std::vector<std::string> markers;
  double min_angle_deg = 0.0;
};

// Milliseconds, summed over the steps.
struct PhaseTimes {
  double move = 0.0, interior = 0.0, detect = 0.0, explore = 0.0, triangulate = 0.0, splice = 0.0,
         quality = 0.0;
  double total = 0.0;  // of the steps
  double write = 0.0;  // logs and meshes, beside the steps
};

// What a run ended early for.
enum class StopCause {
  Other,   // a step without valid mesh, the scenario, a signal, a file that cannot be written
  Memory,  // it has run out
  Bug,     // a mistake of kinemesh: a std::logic_error
};

struct RunSummary {
  RunPlan plan;
  int steps = 0;           // accepted
  long long rejected = 0;  // steps that were undone and halved, or ended the run
  double time = 0.0;       // reached
  int steps_tangled = 0;
  long long inverted = 0;  // inverted and flat faces, summed over the accepted steps like the following
  long long regions = 0;
  long long region_faces = 0;
  int region_faces_max = 0;      // the largest region
  long long replaced = 0;        // faces rewritten
  long long quality_flips = 0;   // of edges, by the quality pass
  long long quality_moves = 0;   // of vertices; one may move several times in a step
  double min_angle_deg = 180.0;  // of the domain's faces after a step, the smallest of all
  double share_mean = 0.0;       // of the faces, padding included, that a step rewrote: over all steps
  double share_max = 0.0;
  int escaped_max = 0;  // vertices in any one step
  long long retries = 0;
  PhaseTimes ms;
  std::optional<std::string> stopped;        // why it ended early; nothing: all steps ended valid
  StopCause stop_cause = StopCause::Other;   // of `stopped`
  bool can_resume = false;                   // `stopped` is no property of the scenario
  bool was_finished = false;                 // the run to resume had come to its end: nothing was done
  std::vector<std::filesystem::path> files;  // to open: the series, the last mesh, the logs
};

// Told of what happens, in the thread that called run.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void note(const std::string& /*text*/) {}    // something the user should know
  virtual void detail(const std::string& /*text*/) {}  // something for who wants to know more
  virtual void started(const RunPlan& /*plan*/) {}
  virtual void stepped(const StepRecord& /*record*/, const Mesh& /*mesh*/) {}  // rejected steps, too
  virtual void finished(const RunSummary& /*summary*/) {}
};

// The reason to stop at a step that was not accepted.
std::string why_stopped(const StepOutcome& outcome);

// Writes scenario.toml, run.json, steps.csv, regions.csv, mesh_NNNNNN.vtu, mesh.pvd and the last mesh as
// final.EXT in the input's own format into options.directory. The files but the two CSVs, which grow a line
// at a time, are whole or not there. Results do not depend on the number of threads, timings apart.
//
// Every output.checkpoint steps, and where a run is stopped, it writes checkpoint.bin, and the one before
// stays as checkpoint_prev.bin. With `resume` a run goes on from there, after whatever ended it at whatever
// moment: in the end all files are bit for bit those of an uninterrupted run, but for the columns of
// steps.csv that end in _ms, run.json and the checkpoints themselves. Without a checkpoint it starts anew.
//
// Throws InputError before the first step, with nothing written, for whatever is wrong with scenario, mesh or
// directory; a tangled mesh and a moving convex hull without frame among them; with `resume`, a checkpoint
// that is damaged or not of this scenario. What goes wrong later, a step without valid mesh, a full disk, a
// signal, ends the run: `stopped` says why, and the last valid mesh is written. Where a file cannot be
// written, the logs and the series go back to the step before, and the last checkpoint stays.
RunSummary run(const Scenario& scenario, const RunOptions& options, RunObserver& observer);

}  // namespace kinemesh
#pragma GCC visibility pop
