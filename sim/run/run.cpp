#include "kinemesh/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <new>
#include <stdexcept>

#include "core/base/stopwatch.h"
#include "core/io/atomic_file.h"
#include "core/io/file_error.h"
#include "core/io/folder_lock.h"
#include "core/mesh/mesh_state.h"
#include "kinemesh/measure.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/setup.h"
#include "sim/run/checkpoint.h"
#include "sim/run/csv_log.h"
#include "sim/run/failed_step.h"
#include "sim/run/patches.h"
#include "sim/run/run_directory.h"
#include "sim/run/run_report.h"
#include "sim/run/series.h"
#include "sim/run/stop_signal.h"
#include "sim/step/threads.h"
#include "untangle/walk/stuck.h"

namespace kinemesh {
namespace {

std::filesystem::path directory_of(const Scenario& scenario, const RunOptions& options) {
  return options.directory.empty() ? std::filesystem::path(scenario.name()) : options.directory;
}

RunPlan plan_of(const Scenario& scenario, const RunOptions& options, const Mesh& mesh, int threads) {
  RunPlan plan;
  plan.directory = directory_of(scenario, options);
  plan.strategy = scenario.repair.strategy;
  plan.steps = scenario.time.steps;
  plan.end_time = scenario.time.end;
  plan.is_adaptive = scenario.time.adaptive.has_value();
  plan.threads = threads;
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

// A run that goes on, and where in its files.
struct Resumption {
  Restart from;
  std::uint64_t patches_length = 0;  // bytes
};

// Nothing where the run has no checkpoint yet. Throws InputError for a run that cannot be gone on with.
std::optional<Resumption> resumption_of(const Scenario& scenario, const std::filesystem::path& directory) {
  auto restart = last_checkpoint(directory, to_toml(scenario));
  if (!restart) return std::nullopt;
  require_logs(directory, restart->checkpoint.logs);
  const int step = restart->checkpoint.step;
  return Resumption{std::move(*restart), scenario.output.patches ? patches_length_up_to(directory, step) : 0};
}

// What a failure that ends a run is called.
std::string reason_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "out of memory";
  return (dynamic_cast<const std::logic_error*>(&error) ? "internal error: " : "") +
         std::string(error.what());
}

StopCause cause_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return StopCause::Memory;
  return dynamic_cast<const std::logic_error*>(&error) ? StopCause::Bug : StopCause::Other;
}

// Of a step that nothing but another scenario helps.
constexpr const char* must_change = "; it would stop there again: change the scenario, and run it anew";

// The steps of one run, and all it writes. Construction opens the files. Pre: check_run_directory.
class Runner {
 public:
  Runner(const Scenario& scenario, const RunOptions& options, RunObserver& observer, SetUp set_up,
         RunPlan plan)
      : scenario_(scenario),
        options_(options),
        observer_(observer),
        directory_(plan.directory),
        motion_(std::move(set_up.motion)),
        stepper_(set_up.mesh, options_of(scenario, motion_)),
        steps_(scenario.time),
        json_(started(scenario, options, plan)),
        log_(directory_),
        series_(directory_, set_up.mesh) {
    checkpoint_.base = base_of(set_up.mesh);
    checkpoint_.initial = state_of(set_up.mesh, checkpoint_.base.order);
    if (scenario.output.patches) patches_.emplace(directory_, set_up.mesh);
    begin(std::move(plan));
    write_mesh_of_step();
  }

  // Goes on from a checkpoint. set_up: of its initial mesh.
  Runner(const Scenario& scenario, const RunOptions& options, RunObserver& observer, SetUp set_up,
         RunPlan plan, Resumption resumed)
      : scenario_(scenario),
        options_(options),
        observer_(observer),
        directory_(plan.directory),
        motion_(std::move(set_up.motion)),
        stepper_(std::move(resumed.from.mesh), options_of(scenario, motion_), resumed.from.checkpoint.time,
                 resumed.from.checkpoint.step),
        steps_(scenario.time, resumed.from.checkpoint.adaptive),
        json_(directory_, scenario, options, files_of_run(directory_)),
        log_(directory_, resumed.from.checkpoint.logs),
        series_(directory_, set_up.mesh, resumed.from.checkpoint.series),
        summary_(resumed.from.checkpoint.totals),
        checkpoint_(std::move(resumed.from.checkpoint)),
        last_checkpoint_(checkpoint_.step) {
    if (scenario.output.patches) patches_.emplace(directory_, resumed.patches_length);
    stepper_.set_following_state(checkpoint_.following);
    begin(std::move(plan));
    json_.write(summary_, RunState::Running);
  }

  RunSummary run() {
    guarded([&] {
      while (!steps_.is_done() && !summary_.stopped) do_step();
    });
    if (!is_file_broken_) {
      if (summary_.stopped) guarded([&] { write_checkpoint_of_step(); });
      guarded([&] { write_last(); });
    }
    list_files();
    guarded([&] { json_.write(summary_, summary_.stopped ? RunState::Stopped : RunState::Done); });
    return std::move(summary_);
  }

 private:
  // Of a run in a folder that was empty, or another run's: that makes way. From here on the folder holds no
  // run that is done, and each file that is there at any moment is listed.
  static RunJson started(const Scenario& scenario, const RunOptions& options, const RunPlan& plan) {
    const auto& directory = plan.directory;
    auto files = files_of_run(directory);
    files.insert({"scenario.toml", "steps.csv", "regions.csv", "mesh.pvd"});
    if (scenario.output.patches) files.insert("patches.bin");
    RunJson json(directory, scenario, options, std::move(files));
    RunSummary nothing_yet;
    nothing_yet.plan = plan;
    json.write(nothing_yet, RunState::Running);
    clear_run_directory(directory, scenario);
    if (options.force) remove_report(directory);
    if (!std::filesystem::exists(directory / "scenario.toml"))
      write_file_atomically(directory / "scenario.toml", to_toml(scenario));
    return json;
  }

  static StepperOptions options_of(const Scenario& scenario, const Motion& motion) {
    StepperOptions options = stepper_options(scenario.repair, motion);
    const auto& adaptive = scenario.time.adaptive;
    if (adaptive && adaptive->max_region_share) options.max_region_share = *adaptive->max_region_share;
    return options;
  }

  void begin(RunPlan plan) {
    summary_.rejected = steps_.state().rejected;
    checkpoint_.program = KINEMESH_VERSION;
    checkpoint_.scenario = to_toml(scenario_);
    checkpoint_.logs = log_.lengths();
    summary_.plan = std::move(plan);
    if (patches_) stepper_.observe([this](const StepChanges& changes) { patches_->note(changes); });
  }

  // What fails once the run is under way ends it; the first reason counts.
  template <class F>
  void guarded(const F& f) {
    try {
      f();
    } catch (const std::exception& error) {
      if (!summary_.stopped) stop(reason_of(error), true, cause_of(error));
    }
  }

  void stop(const std::string& why, bool can_resume, StopCause cause = StopCause::Other) {
    summary_.stopped = why;
    summary_.stop_cause = cause;
    summary_.can_resume = can_resume;
  }

  void do_step() {
    const double end_time = steps_.next_end();
    const StepOutcome outcome = step_to(end_time);
    if (outcome) {
      steps_.accept();
      write_step(outcome.record);
    } else {
      reject(outcome, end_time);
    }
    observer_.stepped(outcome.record, stepper_.mesh());
    if (const char* signal = StopOnSignals::received(); signal && !steps_.is_done() && !summary_.stopped)
      stop(std::string("stopped by ") + signal + " after step " + std::to_string(stepper_.steps_done()),
           true);
  }

  // Its row stays in the log only behind that of the next accepted step: on resuming, the step is tried
  // again.
  void reject(const StepOutcome& outcome, double end_time) {
    const bool has_half = steps_.reject();
    summary_.rejected = steps_.state().rejected;
    if (!has_half) {
      const std::string why = why_stopped(outcome) + what_may_help(outcome);
      stop(why + why_not_halved(outcome.record.dt), false);
      dump(end_time, why, outcome.defect ? outcome.defect->detail : "");
    }
    log_.write(outcome.record);
  }

  std::string what_may_help(const StepOutcome& outcome) const {
    if (!outcome.defect || outcome.defect->kind != DefectKind::Escaped) return "";
    std::vector<std::string> ways{scenario_.time.adaptive ? "a smaller min_dt"
                                                          : "shorter steps ([time] dt, adaptive)"};
    if (scenario_.interior.options.follow == Follow::None)
      ways.push_back("an interior that follows ([interior] follow)");
    if (scenario_.repair.quality != "angles") ways.push_back("[repair] quality = \"angles\"");
    return fmt::format("; {} may help", fmt::join(ways, " or "));
  }

  std::string why_not_halved(double dt) const {
    const auto& adaptive = scenario_.time.adaptive;
    if (!adaptive) return "";
    return fmt::format("; its length {} cannot be halved, min_dt is {}", dt, adaptive->min_dt);
  }

  // Memory that ran out is no property of the step; what an InputError says is one of the scenario.
  StepOutcome step_to(double end_time) {
    try {
      return stepper_.step_to(motion_, end_time);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      dump(end_time, error.what(), "");
      if (dynamic_cast<const InputError*>(&error)) stop(error.what() + std::string(must_change), false);
      throw;
    }
  }

  // Where this fails, too, the reason to stop is still the first.
  void dump(double end_time, const std::string& message, const std::string& detail) {
    if (!options_.dump_on_failure) return;
    try {
      FailedStep step = failed_step(stepper_, motion_, end_time);
      step.program = KINEMESH_VERSION;
      step.source = scenario_.file.string();
      step.message = message;
      step.detail = detail;
      step.options = options_of(scenario_, motion_);
      json_.claim({"failed_step.bin"});
      write_file_atomically(directory_ / "failed_step.bin", format_failed_step(step));
      observer_.note("the step is in " + (directory_ / "failed_step.bin").string() + ", for kinemesh replay");
    } catch (const std::exception& error) {
      observer_.note(std::string("the step could not be written: ") + error.what());
    }
  }

  // Log, mesh and checkpoint of an accepted step. Where the first two cannot be written, files are as before.
  void write_step(const StepRecord& record) {
    const Stopwatch writing;
    series_.note_step(record, stepper_.flipped_faces());
    is_file_broken_ = true;
    try {
      log_.write(record);
      if (patches_) patches_->write();
      if (is_multiple(record.step, scenario_.output.every)) write_mesh_of_step();
    } catch (...) {
      log_.shorten(checkpoint_.logs);
      if (patches_) patches_->take_back();
      throw;
    }
    is_file_broken_ = false;
    checkpoint_.logs = log_.lengths();
    checkpoint_.adaptive = steps_.state();
    add_step(summary_, record, stepper_.mesh().n_faces());
    if (is_multiple(record.step, scenario_.output.checkpoint)) write_checkpoint_of_step();
    summary_.ms.write += writing.milliseconds();
  }

  // Or the last step. Every 0 steps is never.
  bool is_multiple(int step, int of) const { return of > 0 ? step % of == 0 || steps_.is_done() : false; }

  // The lengths are those at the end of the last accepted step: a rejected one comes again.
  void write_checkpoint_of_step() {
    if (last_checkpoint_ == stepper_.steps_done()) return;
    checkpoint_.mesh = state_of(stepper_.mesh(), checkpoint_.base.order);
    checkpoint_.time = stepper_.time();
    checkpoint_.step = stepper_.steps_done();
    checkpoint_.totals = summary_;
    checkpoint_.series = series_.state();
    checkpoint_.following = stepper_.following_state();
    log_.flush();
    if (patches_) patches_->flush();
    json_.claim({"checkpoint.bin", "checkpoint_prev.bin", "checkpoint_next.bin"});
    write_checkpoint(directory_, checkpoint_);
    last_checkpoint_ = checkpoint_.step;
  }

  void write_mesh_of_step() {
    json_.claim({mesh_file_name(stepper_.steps_done())});
    series_.write(stepper_.mesh(), stepper_.steps_done(), stepper_.time());
  }

  void write_last() {
    const Stopwatch writing;
    if (series_.last_written() != stepper_.steps_done()) write_mesh_of_step();
    const std::string name = last_mesh_name(scenario_);
    json_.claim({name});
    write_file_atomically(directory_ / name, format_mesh(stepper_.mesh().domain(), *format_of(name)));
    summary_.ms.write += writing.milliseconds();
  }

  void list_files() {
    for (const auto& name : {std::string("mesh.pvd"), last_mesh_name(scenario_), std::string("steps.csv"),
                             std::string("regions.csv"), std::string("patches.bin")})
      if (std::filesystem::exists(directory_ / name)) summary_.files.push_back(directory_ / name);
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  RunObserver& observer_;
  std::filesystem::path directory_;
  Motion motion_;
  Stepper stepper_;
  AdaptiveSteps steps_;
  RunJson json_;
  StepLog log_;
  MeshSeries series_;
  std::optional<PatchesWriter> patches_;
  RunSummary summary_;
  Checkpoint checkpoint_;    // base, initial mesh, scenario; the logs' lengths after the last accepted step
  int last_checkpoint_ = 0;  // step
  bool is_file_broken_ = false;  // the last step is done, but not in the files
};

SetUp set_up_for(const Scenario& scenario, const std::optional<Resumption>& resumption) {
  return resumption ? set_up(scenario, resumption->from.initial) : set_up(scenario);
}

// Locked; made where it is not there, and then checked again, as another process may have been faster.
FolderLock opened(const std::filesystem::path& directory, const Scenario& scenario, bool may_be_there) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) io::fail(directory, "cannot be made", error.value());
  FolderLock lock(directory);
  check_run_directory(directory, scenario, may_be_there);
  return lock;
}

// So that it can be gone on with, or started, from there.
bool holds_scenario(const std::filesystem::path& directory, const Scenario& scenario) {
  const auto file = directory / "scenario.toml";
  return std::filesystem::exists(file) && read_file(file) == to_toml(scenario);
}

// Where files cannot be opened, there are some already: the run has begun, and stops.
RunSummary go(const Scenario& scenario, const RunOptions& options, RunObserver& observer, SetUp made,
              const RunPlan& plan, std::optional<Resumption> resumption) {
  const StopOnSignals signals(options.stop_on_signals);
  remove_leftovers(plan.directory);
  try {
    if (resumption)
      return Runner(scenario, options, observer, std::move(made), plan, std::move(*resumption)).run();
    return Runner(scenario, options, observer, std::move(made), plan).run();
  } catch (const std::exception& error) {
    RunSummary summary;
    summary.plan = plan;
    summary.stopped = reason_of(error);
    summary.stop_cause = cause_of(error);
    summary.can_resume = holds_scenario(plan.directory, scenario);
    return summary;
  }
}

}  // namespace

std::string why_stopped(const StepOutcome& outcome) {
  const std::string step = "step " + std::to_string(outcome.record.step);
  if (const auto& defect = outcome.defect)
    return step + (is_stuck(*defect) ? " stays tangled: " : " has no valid mesh: ") + defect->message() +
           (defect->kind == DefectKind::NonFinitePosition ? must_change : "");
  return fmt::format("{} at time {} has regions of {:.4g} of all faces, max_region_share is {}", step,
                     outcome.record.time, outcome.too_large->share, outcome.too_large->limit);
}

RunSummary run(const Scenario& scenario, const RunOptions& options, RunObserver& observer) {
  const ThreadLimit threads(options.threads);
  const auto directory = directory_of(scenario, options);
  const bool may_be_there = options.force || options.resume;
  FolderLock lock;
  if (!options.dry_run && std::filesystem::is_directory(directory)) lock = FolderLock(directory);
  if (options.resume) require_run_of(to_toml(scenario), directory);
  check_run_directory(directory, scenario, may_be_there);
  std::optional<Resumption> resumption;
  RunSummary summary;
  if (options.resume) {
    if ((summary.was_finished = holds_finished_run(directory))) return summary;
    resumption = resumption_of(scenario, directory);
  }
  SetUp made = set_up_for(scenario, resumption);
  RunPlan plan = plan_of(scenario, options, made.mesh, threads.count());
  if (resumption) {
    plan.steps_done = resumption->from.checkpoint.step;
    plan.start_time = resumption->from.checkpoint.time;
  }
  for (const auto& note : made.notes) observer.note(note);
  observer.started(plan);
  if (options.dry_run) {
    summary.plan = std::move(plan);
  } else {
    if (!lock.is_held()) lock = opened(directory, scenario, may_be_there);
    summary = go(scenario, options, observer, std::move(made), plan, std::move(resumption));
  }
  observer.finished(summary);
  return summary;
}

}  // namespace kinemesh
