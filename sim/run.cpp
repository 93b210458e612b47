#include "sim/run.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <exception>

#include "core/io/atomic_file.h"
#include "core/io/mesh_io.h"
#include "core/measure.h"
#include "core/stopwatch.h"
#include "sim/csv_log.h"
#include "sim/run_directory.h"
#include "sim/run_report.h"
#include "sim/series.h"
#include "sim/setup.h"
#include "sim/stop_signal.h"

namespace kinemesh {
namespace {

int thread_count(int wanted) {
  if (wanted < 0) throw InputError("threads: a number not below 0 expected");
  return wanted > 0 ? wanted : tbb::info::default_concurrency();
}

std::filesystem::path directory_of(const Scenario& scenario, const RunOptions& options) {
  return options.directory.empty() ? std::filesystem::path(scenario.name()) : options.directory;
}

RunPlan plan_of(const Scenario& scenario, const RunOptions& options, const Mesh& mesh) {
  RunPlan plan;
  plan.directory = directory_of(scenario, options);
  plan.strategy = scenario.repair.strategy;
  plan.steps = scenario.time.steps;
  plan.end_time = scenario.time.end;
  plan.threads = thread_count(options.threads);
  plan.vertices = mesh.n_user_vertices();
  plan.faces = mesh.n_user_faces();
  plan.padding_faces = mesh.n_faces() - mesh.n_user_faces();
  plan.markers = mesh.marker_names();
  plan.min_angle_deg = measure(mesh).min_angle_deg;
  return plan;
}

std::string last_mesh_name(const Scenario& scenario) {
  return "final" + (scenario.mesh.file.empty() ? ".su2" : scenario.mesh.file.extension().string());
}

// The steps of one run, and all it writes. Construction opens the files.
class Runner {
 public:
  Runner(const Scenario& scenario, const RunOptions& options, RunObserver& observer, SetUp set_up,
         RunPlan plan)
      : scenario_(scenario),
        observer_(observer),
        directory_(plan.directory),
        motion_(std::move(set_up.motion)),
        stepper_(std::move(set_up.mesh), {scenario.repair.strategy, scenario.repair.allow_escaped,
                                          scenario.repair.retain, scenario.repair.quality}),
        json_(open(directory_, scenario), scenario, options),
        log_(directory_),
        series_(directory_, stepper_.mesh()) {
    summary_.plan = std::move(plan);
    json_.write(summary_, RunState::Running);
    write_mesh_of_step();
  }

  RunSummary run() {
    guarded([&] {
      for (int n = 1; n <= scenario_.time.steps && !summary_.stopped; ++n) do_step(n);
    });
    guarded([&] { write_last(); });
    list_files();
    guarded([&] { json_.write(summary_, summary_.stopped ? RunState::Stopped : RunState::Done); });
    return std::move(summary_);
  }

 private:
  static const std::filesystem::path& open(const std::filesystem::path& directory, const Scenario& scenario) {
    clear_run_directory(directory);
    write_file_atomically(directory / "scenario.toml", to_toml(scenario));
    return directory;
  }

  // What fails once the run is under way ends it; the first reason counts.
  template <class F>
  void guarded(const F& f) {
    try {
      f();
    } catch (const std::exception& error) {
      if (!summary_.stopped) summary_.stopped = error.what();
    }
  }

  void do_step(int n) {
    const StepOutcome outcome = stepper_.step_to(motion_, scenario_.time.time_after(n));
    const Stopwatch writing;
    if (outcome) {
      add_step(summary_, outcome.record, stepper_.mesh().n_faces());
      series_.note_step(outcome.record, stepper_.flipped_faces());
    } else {
      summary_.stopped = "step " + std::to_string(n) + " has no valid mesh: " + outcome.defect->message();
    }
    log_.write(outcome.record);
    if (outcome && is_written(n)) series_.write(stepper_.mesh(), n, stepper_.time());
    summary_.ms.write += writing.milliseconds();
    observer_.stepped(outcome.record, stepper_.mesh());
    if (const char* signal = StopOnSignals::received();
        signal && n < scenario_.time.steps && !summary_.stopped)
      summary_.stopped = std::string("stopped by ") + signal + " after step " + std::to_string(n);
  }

  bool is_written(int n) const {
    const int every = scenario_.output.every;
    return n == scenario_.time.steps || (every > 0 && n % every == 0);
  }

  void write_mesh_of_step() { series_.write(stepper_.mesh(), stepper_.steps_done(), stepper_.time()); }

  void write_last() {
    const Stopwatch writing;
    if (series_.last_written() != stepper_.steps_done()) write_mesh_of_step();
    write_mesh(directory_ / last_mesh_name(scenario_), stepper_.mesh().domain());
    summary_.ms.write += writing.milliseconds();
  }

  void list_files() {
    for (const auto& name : {std::string("mesh.pvd"), last_mesh_name(scenario_), std::string("steps.csv"),
                             std::string("regions.csv")})
      if (std::filesystem::exists(directory_ / name)) summary_.files.push_back(directory_ / name);
  }

  const Scenario& scenario_;
  RunObserver& observer_;
  std::filesystem::path directory_;
  Motion motion_;
  Stepper stepper_;
  RunJson json_;
  StepLog log_;
  MeshSeries series_;
  RunSummary summary_;
};

void tell_notes(const Scenario& scenario, const SetUp& set_up, RunObserver& observer) {
  for (const auto& note : set_up.notes) observer.note(note);
  if (scenario.output.checkpoint > 0)
    observer.detail("this version writes no checkpoints, output.checkpoint has no effect");
}

}  // namespace

RunSummary run(const Scenario& scenario, const RunOptions& options, RunObserver& observer) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(thread_count(options.threads)));
  check_run_directory(directory_of(scenario, options), scenario, options.force);
  SetUp made = set_up(scenario);
  RunPlan plan = plan_of(scenario, options, made.mesh);
  tell_notes(scenario, made, observer);
  observer.started(plan);

  RunSummary summary;
  if (options.dry_run) {
    summary.plan = std::move(plan);
  } else {
    const StopOnSignals signals(options.stop_on_signals);
    summary = Runner(scenario, options, observer, std::move(made), std::move(plan)).run();
  }
  observer.finished(summary);
  return summary;
}

}  // namespace kinemesh
