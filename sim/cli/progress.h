// What `kinemesh run` says while it runs, on stderr: one line that is rewritten on a terminal, else a line
// now and then.
#pragma once

#include <chrono>
#include <string>

#include "kinemesh/run.h"
#include "sim/cli/remesh_probe.h"

namespace kinemesh::cli {

enum class Verbosity {
  Quiet,    // nothing
  Normal,   // progress and notes
  Verbose,  // every step, and details
};

class Progress : public RunObserver {
 public:
  explicit Progress(Verbosity verbosity);

  void note(const std::string& text) override;
  void detail(const std::string& text) override;
  void started(const RunPlan& plan) override;
  void stepped(const StepRecord& record, const Mesh& mesh) override;
  void finished(const RunSummary& summary) override;

  const RemeshProbe& probe() const { return probe_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due(int step) const;
  void show(const StepRecord& record, int n_faces);
  void clear_live_line();

  Verbosity verbosity_;
  bool is_live_;
  bool has_colour_;
  bool is_line_open_ = false;
  RunPlan plan_;
  RemeshProbe probe_;
  Clock::time_point start_;
  Clock::time_point last_shown_;
};

}  // namespace kinemesh::cli
